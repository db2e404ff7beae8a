"""Print the SHA-256 of pictures and models: `python -m benchmarks.same_bits`.

Run it on two machines, Pythons or sets of dependencies: every line must be the same. With names,
as in `python -m benchmarks.same_bits face small`, only those are made. The bytes of
mp4 and webp files come from encoders that change with their version, so for animations the pixels
are hashed, and the bytes only of PNG files and models, which this package writes itself.
"""

import argparse
import hashlib
import os
import platform
import sys
import tempfile
from collections.abc import Callable, Iterator
from functools import partial
from importlib.metadata import version
from itertools import islice
from pathlib import Path

import llvmlite.binding
import numpy as np

from benchmarks.quick import add_quick
from drapery import Animation, Banner, animate, draw, draw_face, save_model, simulate
from drapery.cloth import Gravity, Wind, grid, rest_state, solver as find_solver

SOLVERS = ("desbrun", "xpbd", "pbd", "verlet", "implicit", "provot")
VIEWS = ("front", "back", "iso", "gui", "hero")
DESIGN = Banner.parse("white creeper:lime border:black")


def outputs() -> Iterator[tuple[str, Callable[[], bytes]]]:
    """The name of each output, and what makes its bytes."""
    yield "face", lambda: draw_face(DESIGN).pixels.tobytes()
    yield "small", lambda: draw(DESIGN, size=(48, 64), grid=(5, 9), time=0.2).pixels.tobytes()
    for solver in SOLVERS:
        yield f"solver {solver}", partial(pixels, solver=solver, grid=(11, 21))
    for solver in ("desbrun", "xpbd"):
        yield f"sheet {solver}", partial(pixels, solver=solver, grid=(33, 65))
    for solver in ("desbrun", "xpbd"):
        yield f"crowd {solver}", partial(crowd, solver)
    for view in VIEWS:
        yield f"view {view}", partial(pixels, view=view, samples=4, shadow=True)
    yield "animation", lambda: b"".join(frame.pixels.tobytes() for frame in loop())
    yield ".png", lambda: saved("still.png", draw(DESIGN).save)
    yield ".gif", lambda: saved("loop.gif", loop().save)
    for ending in (".glb", ".obj", ".ply"):
        yield ending, partial(saved, f"model{ending}", partial(save_model, DESIGN))


def pixels(**options: object) -> bytes:
    """The pixels of a picture."""
    return draw(DESIGN, **options).pixels.tobytes()


def loop() -> Animation:
    """A short loop."""
    return animate(DESIGN, seconds=1, fps=10, size=(96, 128), wind=8)


def crowd(name: str) -> bytes:
    """The positions of cloths that are simulated at once."""
    wind = Wind((2.0, 0.0, 5.0), seed=4, phases=np.linspace(0, 9, 70))
    start = rest_state(cloth := grid(5, 9, 0.8, 1.6), 70)
    states = simulate(cloth, find_solver(name), [Gravity(), wind], start=start, every=20)
    return next(islice(states, 1, None)).positions.tobytes()


def saved(name: str, save: Callable[[Path], object]) -> bytes:
    """The bytes of a file that `save` writes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, name)
        save(path)
        return path.read_bytes()


def main() -> None:
    """Print the line of each output, or of those that the command line names."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="of outputs; by default all")
    add_quick(parser)
    given = parser.parse_args()
    wanted = ["face", "small", ".png"] if given.quick else given.names
    packages = ", ".join(f"{name} {version(name)}" for name in ("numpy", "numba", "pillow"))
    target = os.environ.get("NUMBA_CPU_NAME") or llvmlite.binding.get_host_cpu_name()
    about = f"{platform.machine()} ({target}), Python {platform.python_version()}, {packages}"
    print(about, file=sys.stderr)
    for name, make in outputs():
        if name in wanted or not wanted:
            print(f"{hashlib.sha256(make()).hexdigest()}  {name}", flush=True)


if __name__ == "__main__":
    main()
