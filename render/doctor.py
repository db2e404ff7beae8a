"""Which backends work on this machine, and the one line that mends each that does not."""

import subprocess
import sys
from importlib.metadata import version
from typing import NamedTuple

from drapery.errors import BackendError
from drapery.render.backends import backend, backend_names
from drapery.render.gl.platform import INSTALL_GL, INSTALL_PYRENDER

TIMEOUT = 60  # seconds
DESCRIBE_GL = "from drapery.render.gl import describe; print(describe())"


class BackendReport(NamedTuple):
    """What is known of a backend. remedy: a command that mends it, or "" where it works."""

    name: str
    works: bool
    detail: str
    remedy: str


def backend_report() -> list[BackendReport]:
    """Try every backend, and the video library. Nothing that one does can harm this process."""
    own = {"soft": _soft, "pyrender": _pyrender}
    tried = [own[name]() if name in own else _added(name) for name in backend_names()]
    return [*tried, _video()]


def _soft() -> BackendReport:
    return BackendReport("soft", True, f"numba {version('numba')}, the default", "")


def _pyrender() -> BackendReport:
    """OpenGL is started in a process of its own: a driver may crash, or hang."""
    try:
        # -P: a checkout in the current folder is not the package as it is installed.
        child = subprocess.run(
            [sys.executable, "-P", "-c", DESCRIBE_GL],
            capture_output=True,
            text=True,
            timeout=TIMEOUT,
        )
    except subprocess.TimeoutExpired:
        return BackendReport("pyrender", False, f"OpenGL hangs for {TIMEOUT} s", INSTALL_GL)
    if child.returncode == 0:
        return BackendReport("pyrender", True, child.stdout.strip().splitlines()[-1], "")
    if child.returncode < 0:
        reason = f"OpenGL crashed with signal {-child.returncode}"
        return BackendReport("pyrender", False, reason, INSTALL_GL)
    last = (child.stderr.strip().splitlines() or ["no reason given"])[-1]
    reason = last.removeprefix("drapery.errors.BackendError: ")
    for remedy in (INSTALL_PYRENDER, INSTALL_GL):
        if reason.endswith(remedy):
            return BackendReport("pyrender", False, reason.removesuffix(f": {remedy}"), remedy)
    return BackendReport("pyrender", False, reason, INSTALL_GL)


def _added(name: str) -> BackendReport:
    try:
        backend(name)
    except BackendError as error:
        return BackendReport(name, False, str(error), "pip install --upgrade its package")
    return BackendReport(name, True, "from an installed package", "")


def _video() -> BackendReport:
    from importlib.util import find_spec

    if find_spec("av") is None:
        return BackendReport(
            "video", False, "PyAV is not installed", 'pip install "drapery[video]"'
        )
    return BackendReport("video", True, f"PyAV {version('av')}, for .mp4 and .webm", "")
