"""Check a wheel with compiled kernels: `python -m release.check_wheel FILE.whl`.

It is installed into a new environment, where a picture is drawn by the library and by numba. They
must be the same, the library must need no numba, also for the other pictures of `PICTURES`, and the
first picture must take under five seconds of the processor.
"""

import os
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

from release.kernels import PICTURES

LIMIT = 5.0
"""The most processor time of the first picture after an installation [s]."""
PROGRAM = """
import hashlib, sys, time
from drapery import Banner, draw
banner = Banner.parse("white creeper:lime border:black")
pixels = draw(banner, view="hero").pixels
seconds = time.process_time()
others = {others!r}
for options in others:
    draw(banner, **{{"size": (32, 32), "time": 0.1, **options}})
print(hashlib.sha256(pixels.tobytes()).hexdigest(), "numba" in sys.modules, seconds)
"""


def main(wheel: Path) -> None:
    """Raises SystemExit where the wheel is not as it should be."""
    with tempfile.TemporaryDirectory() as folder:
        own = Path(folder, "venv")
        venv.create(own, with_pip=True)
        python = own / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
        subprocess.run([python, "-m", "pip", "install", "-q", wheel.resolve()], check=True)
        first, uses_numba, seconds = drawn(python, folder, "1")
        if uses_numba == "True":
            raise SystemExit(f"{wheel} lacks kernels of this platform; build it here")
        if float(seconds) > LIMIT:
            raise SystemExit(f"the first picture took {seconds} s, over {LIMIT:g} s")
        if drawn(python, folder, "0")[0] != first:
            raise SystemExit("the compiled kernels give another picture than numba's")
        print(f"{wheel.name}: same bits; the first picture takes {float(seconds):.2f} s")


def drawn(python: Path, folder: str, ahead: str) -> list[str]:
    """The hash of a picture, whether numba was imported, and the time of the processor [s]."""
    env = os.environ | {"DRAPERY_AOT": ahead, "NUMBA_CACHE_DIR": folder}
    command = [python, "-c", PROGRAM.format(others=PICTURES if ahead == "1" else ())]
    run = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True, check=True)
    return run.stdout.split()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
