"""Starting pyrender without a display, with every obstacle on the way.

- PyOpenGL fixes its platform at import, and only a start shows whether EGL works: so the libraries
  are tried by ctypes before anything of OpenGL is imported. EGL comes first; Mesa 25.1 dropped
  OSMesa.
- `import pyrender` pulls in its window, hence pyglet, hence X11: a stub stands in for it.
- An OSMesa context has framebuffers, though pyrender says no; and PyOpenGL hands out a new object
  for the same OSMesa context each time, so pyrender's shader cache would miss on every frame.
"""

import ctypes
import ctypes.util
import importlib.util
import os
import sys
from types import ModuleType
from typing import Any, NamedTuple

from drapery.errors import BackendError

INSTALL_PYRENDER = 'pip install "drapery[gl]"'
INSTALL_GL = "apt-get install -y --no-install-recommends libegl1 libgl1"

EGL_PLATFORM_DEVICE = 0x313F


class Probe(NamedTuple):
    """Whether a way to OpenGL works, and what was found or is missing."""

    works: bool
    detail: str


def probe_egl() -> Probe:
    """Start EGL on its first device, as pyrender will. Harmless before OpenGL is imported."""
    if not any(map(_loaded, ("libGL.so.1", "libOpenGL.so.0"))):
        return Probe(False, "libGL.so.1 is missing")
    egl = _loaded("libEGL.so.1")
    if egl is None:
        return Probe(False, "libEGL.so.1 is missing")
    display = _first_display(egl)
    if not display:
        return Probe(False, "EGL offers no device")
    if not egl.eglInitialize(ctypes.c_void_p(display), None, None):
        return Probe(False, "EGL's first device does not start")
    return Probe(True, "EGL starts")


def probe_osmesa() -> Probe:
    """Whether Mesa's off-screen library is there."""
    for name in ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"):
        library = _loaded(name)
        if library is not None and hasattr(library, "OSMesaCreateContextAttribs"):
            return Probe(True, name)
    return Probe(False, "libOSMesa.so.8 is missing")


def pyrender_installed() -> bool:
    return importlib.util.find_spec("pyrender") is not None


def choose_platform() -> str:
    """`egl` or `osmesa`. Raises BackendError with the line that installs what is missing."""
    wanted = os.environ.get("PYOPENGL_PLATFORM")
    if wanted in ("egl", "osmesa"):
        return wanted
    egl = probe_egl()
    if egl.works:
        return "egl"
    if probe_osmesa().works:
        return "osmesa"
    raise BackendError(f"there is no OpenGL for pyrender ({egl.detail}): {INSTALL_GL}")


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
            f"OpenGL does not start on {name} ({_first_line(error)}): {INSTALL_GL}"
        ) from error
    return pyrender, platform


def release(platform: Any) -> None:
    """Let go of the context, which is current in one thread at a time."""
    if hasattr(platform, "_egl_display"):
        from OpenGL.EGL import EGL_NO_CONTEXT, EGL_NO_SURFACE, eglMakeCurrent

        eglMakeCurrent(platform._egl_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT)
    else:
        from OpenGL.osmesa import OSMesaMakeCurrent

        OSMesaMakeCurrent(None, None, 0, 0, 0)


def _egl_platform() -> Any:
    from pyrender.platforms import egl

    return egl.EGLPlatform(1, 1, egl.get_device_by_index(int(os.environ.get("EGL_DEVICE_ID", 0))))


def _osmesa_platform() -> Any:
    import OpenGL.contextdata
    from OpenGL import platform
    from pyrender.platforms.osmesa import OSMesaPlatform

    def address_of_context(context: Any = None) -> Any:
        current = platform.GetCurrentContext() if context is None else context
        return ctypes.cast(current, ctypes.c_void_p).value if current else None

    OpenGL.contextdata.getContext = address_of_context
    return OSMesaPlatform(1, 1)


def _loaded(name: str) -> ctypes.CDLL | None:
    try:
        return ctypes.CDLL(name)
    except OSError:
        return None


def _first_display(egl: ctypes.CDLL) -> int | None:
    """The display of EGL's first device, or the default one where devices cannot be listed."""
    egl.eglGetProcAddress.restype = ctypes.c_void_p
    query, get = (
        egl.eglGetProcAddress(name) for name in (b"eglQueryDevicesEXT", b"eglGetPlatformDisplayEXT")
    )
    if not (query and get):
        egl.eglGetDisplay.restype = ctypes.c_void_p
        return egl.eglGetDisplay(None)  # type: ignore[no-any-return]
    devices, count = (ctypes.c_void_p * 1)(), ctypes.c_int()
    list_devices = ctypes.CFUNCTYPE(
        ctypes.c_uint, ctypes.c_int, ctypes.c_void_p * 1, ctypes.POINTER(ctypes.c_int)
    )(query)
    if not list_devices(1, devices, ctypes.byref(count)) or not count.value:
        return None
    display = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p)
    found: int | None = display(get)(EGL_PLATFORM_DEVICE, devices[0], None)
    return found


def _first_line(error: Exception) -> str:
    return (str(error).splitlines() or [""])[0] or type(error).__name__
