"""Tests which backends work on this machine, and gives a remedy for each that does not.

Every backend draws a triangle in a separate process, since a driver may crash or hang.
"""

import subprocess
import sys
from importlib.metadata import version
from typing import NamedTuple

from drapery.file_formats import FORMATS
from drapery.jit import DISABLE_JIT
from drapery.render.backends import added_backends, backend
from drapery.render.frame import Frame
from drapery.render.gl.platform import INSTALL_GL, INSTALL_PYRENDER, REMEDIES

TIMEOUT = 120
"""How long a backend may take, compiling included [s]."""
DRAW = "from drapery.render.doctor import try_backend; print(try_backend({!r}))"
DRAW_GL = DRAW.format("pyrender")
ENCODE = (
    "import av; [av.codec.Codec(name, 'w') for name in ('libx264', 'libvpx-vp9')];"
    " print(av.__version__)"
)
INSTALL_VIDEO = 'pip install "drapery-mc[video]"'
SET_CACHE = "export NUMBA_CACHE_DIR=FOLDER, with a folder that may be written"


class BackendReport(NamedTuple):
    """The result for a backend. remedy: a command that repairs it, or "" if it works."""

    name: str
    works: bool
    detail: str
    remedy: str


def backend_report() -> list[BackendReport]:
    """Try every backend and the video encoders; a crash does not affect this process."""
    added = [_added(name, package) for name, package in added_backends().items()]
    return [_soft(), _pyrender(), *added, _video()]


def try_backend(name: str) -> str:
    """Draw one triangle; returns the name of the renderer. Raises what the backend raises."""
    from drapery.mesh import make_mesh
    from drapery.render.camera import Camera
    from drapery.render.drawing import draw_models, make_model

    triangle = make_mesh([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)])
    model = make_model(triangle, colour="red", lit=False)
    camera = Camera((0, 0, 5), (0, 0, 0), height=2.0)
    frame = draw_models([model], camera=camera, size=(16, 16), samples=1, backend=name)
    check_triangle(frame)
    if name == "soft":
        return "this package's own"
    if name == "pyrender":
        from drapery.render.gl import describe

        return describe()
    return f"{backend(name).__module__}"


def check_triangle(frame: Frame) -> None:
    """Raise ValueError unless this is a red triangle on nothing, 16 x 16 pixels."""
    pixels = frame.pixels
    if pixels.shape != (16, 16, 4) or tuple(pixels[10, 8]) != (255, 0, 0, 255) or pixels[0, 0, 3]:
        raise ValueError("it draws a triangle wrongly")


def _soft() -> BackendReport:
    works, said = run_program(DRAW.format("soft"))
    detail = f"numba {version('numba')}, the default; {said}" if works else said
    remedy = f"unset {DISABLE_JIT}" if DISABLE_JIT in said else SET_CACHE
    return BackendReport("soft", works, detail, "" if works else remedy)


def _pyrender() -> BackendReport:
    works, said = run_program(DRAW_GL)
    if works:
        return BackendReport("pyrender", True, said, "")
    for remedy in (INSTALL_PYRENDER, *REMEDIES.values()):
        if said.endswith(remedy):
            return BackendReport("pyrender", False, said.removesuffix(f": {remedy}"), remedy)
    return BackendReport("pyrender", False, said, INSTALL_GL)


def _added(name: str, package: str) -> BackendReport:
    works, said = run_program(DRAW.format(name))
    detail = f"from the package {package}" if works else said
    return BackendReport(name, works, detail, "" if works else f"pip install --upgrade {package}")


def _video() -> BackendReport:
    works, said = run_program(ENCODE)
    endings = " and ".join(each.ending for each in FORMATS if each.extra == "video")
    detail = f"PyAV {said}, for {endings}" if works else said
    return BackendReport("video", works, detail, "" if works else INSTALL_VIDEO)


def run_program(program: str) -> tuple[bool, str]:
    """Whether a program succeeds in a separate process, and its last line or the reason."""
    try:
        # -P: do not import a checkout in the current folder instead of the installed package.
        child = subprocess.run(
            [sys.executable, "-P", "-c", program], capture_output=True, text=True, timeout=TIMEOUT
        )
    except subprocess.TimeoutExpired:
        return False, f"no answer within {TIMEOUT} s"
    if child.returncode < 0:
        return False, f"crashed with signal {-child.returncode}"
    lines = (child.stderr if child.returncode else child.stdout).strip().splitlines()
    last = (lines or ["no reason given"])[-1]
    return child.returncode == 0, last.removeprefix("drapery.errors.BackendError: ")
