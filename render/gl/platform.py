"""Start pyrender without a display. This module works around these problems:

- PyOpenGL selects its platform at import, and only a start shows whether EGL works. So the
  libraries are tried by ctypes before OpenGL is imported. EGL is tried first; Mesa 25.1 removed
  OSMesa.
- `import pyrender` imports its window, hence pyglet, hence X11: a stub replaces it.
- pyrender assumes that an OSMesa context has no framebuffers, but it has. PyOpenGL makes a new
  object for the same OSMesa context each time, so pyrender's shader cache would miss every frame.
"""

import ctypes
import importlib.util
import os
import sys
from collections.abc import Iterator
from types import ModuleType
from typing import Any, NamedTuple

from drapery.errors import BackendError

INSTALL_PYRENDER = 'pip install "drapery-mc[gl]"'
INSTALL_GL = "apt-get install -y --no-install-recommends libegl1 libgl1"
INSTALL_OSMESA = "apt-get install -y --no-install-recommends libosmesa6"
REMEDIES = {"egl": INSTALL_GL, "osmesa": INSTALL_OSMESA}
"""What installs the libraries of each platform."""

EGL_PLATFORM_DEVICE = 0x313F
MAX_DEVICES = 64


class ProbeResult(NamedTuple):
    """Whether a platform of OpenGL works, what is missing if not, and the EGL device that works."""

    works: bool
    missing: str = ""
    device: int = 0


def probe_egl() -> ProbeResult:
    """The first of EGL's devices that starts, or the one that EGL_DEVICE_ID names.

    Graphics cards are listed before software, but a driver may be installed without a card.
    """
    if not any(map(loaded_library, ("libGL.so.1", "libOpenGL.so.0"))):
        return ProbeResult(False, "libGL.so.1 is missing")
    egl = loaded_library("libEGL.so.1")
    if egl is None:
        return ProbeResult(False, "libEGL.so.1 is missing")
    wanted = os.environ.get("EGL_DEVICE_ID", "")
    for number, display in enumerate(_displays(egl)):
        starts = display and egl.eglInitialize(ctypes.c_void_p(display), None, None)
        if starts and wanted in ("", str(number)):
            return ProbeResult(True, device=number)
    return ProbeResult(False, f"no EGL device {wanted} starts".replace("  ", " "))


def probe_osmesa() -> ProbeResult:
    """Whether Mesa's off-screen library is installed."""
    for name in ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"):
        library = loaded_library(name)
        if library is not None and hasattr(library, "OSMesaCreateContextAttribs"):
            return ProbeResult(True)
    return ProbeResult(False, "libOSMesa.so.8 is missing")


def pyrender_installed() -> bool:
    return importlib.util.find_spec("pyrender") is not None


def choose_platform() -> str:
    """`egl` or `osmesa`. Raises BackendError with the line that installs what is missing."""
    wanted = os.environ.get("PYOPENGL_PLATFORM")
    if wanted in REMEDIES:
        found = probe_egl() if wanted == "egl" else probe_osmesa()
        if not found.works:
            raise BackendError(
                f"there is no OpenGL for pyrender on {wanted}, which PYOPENGL_PLATFORM names"
                f" ({found.missing}; without that variable another may work): {REMEDIES[wanted]}"
            )
        return wanted
    egl = probe_egl()
    if egl.works:
        return "egl"
    if probe_osmesa().works:
        return "osmesa"
    raise BackendError(f"there is no OpenGL for pyrender ({egl.missing}): {INSTALL_GL}")


def load_pyrender() -> tuple[ModuleType, Any]:
    """pyrender and a platform whose context is current. Raises BackendError with the remedy."""
    if not pyrender_installed():
        raise BackendError(f"pyrender is not installed: {INSTALL_PYRENDER}")
    name = choose_platform()
    os.environ["PYOPENGL_PLATFORM"] = name
    window = ModuleType("pyrender.viewer")
    window.Viewer = None  # type: ignore[attr-defined]
    sys.modules.setdefault("pyrender.viewer", window)
    try:
        import pyrender
    except Exception as error:
        raise BackendError(
            f"pyrender cannot be imported ({_first_line(error)}): {INSTALL_PYRENDER}"
        ) from error
    try:
        platform = _egl_platform() if name == "egl" else _osmesa_platform()
        platform.init_context()
        platform.make_current()
    except Exception as error:
        raise BackendError(
            f"OpenGL does not start on {name} ({_first_line(error)}): {REMEDIES[name]}"
        ) from error
    return pyrender, platform


def release(platform: Any) -> None:
    """Release the context, which is current in one thread at a time."""
    if hasattr(platform, "_egl_display"):
        from OpenGL.EGL import EGL_NO_CONTEXT, EGL_NO_SURFACE, eglMakeCurrent

        eglMakeCurrent(platform._egl_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT)
    else:
        from OpenGL.osmesa import OSMesaMakeCurrent

        OSMesaMakeCurrent(None, None, 0, 0, 0)


def _egl_platform() -> Any:
    from pyrender.platforms import egl

    return egl.EGLPlatform(1, 1, egl.get_device_by_index(probe_egl().device))


def _osmesa_platform() -> Any:
    import OpenGL.contextdata
    from OpenGL import platform
    from pyrender.platforms.osmesa import OSMesaPlatform

    def address_of_context(context: Any = None) -> Any:
        current = platform.GetCurrentContext() if context is None else context
        return ctypes.cast(current, ctypes.c_void_p).value if current else None

    OpenGL.contextdata.getContext = address_of_context
    return OSMesaPlatform(1, 1)


def loaded_library(name: str) -> ctypes.CDLL | None:
    """A library of the system; None if it is not installed."""
    try:
        return ctypes.CDLL(name)
    except OSError:  # it is not installed
        return None


def _displays(egl: ctypes.CDLL) -> Iterator[int | None]:
    """The displays of EGL's devices, or the default one where devices cannot be listed."""
    egl.eglGetProcAddress.restype = egl.eglGetDisplay.restype = ctypes.c_void_p
    query, get = (
        egl.eglGetProcAddress(name) for name in (b"eglQueryDevicesEXT", b"eglGetPlatformDisplayEXT")
    )
    if not (query and get):
        yield egl.eglGetDisplay(None)
        return
    pointer = ctypes.c_void_p
    devices, count = (pointer * MAX_DEVICES)(), ctypes.c_int()
    list_devices = ctypes.CFUNCTYPE(ctypes.c_uint, ctypes.c_int, pointer, pointer)(query)
    display_of = ctypes.CFUNCTYPE(pointer, ctypes.c_uint, pointer, pointer)(get)
    list_devices(MAX_DEVICES, ctypes.addressof(devices), ctypes.addressof(count))
    for device in devices[: count.value]:
        yield display_of(EGL_PLATFORM_DEVICE, device, None)


def _first_line(error: Exception) -> str:
    return (str(error).splitlines() or [""])[0] or type(error).__name__
