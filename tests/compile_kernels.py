"""Compile the kernels that most tests use: `python tests/compile_kernels.py PART`.

`pytest` does so before its workers start, each part in a process: they have no kernel in common.
Otherwise each worker compiles what it needs, and many kernels are compiled twice.
"""

import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from io import StringIO
from itertools import islice
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from tracing import untraced_environment

from drapery import Banner, draw
from drapery.cloth import (
    Box,
    Cloth,
    Collider,
    Collisions,
    Gravity,
    MovingCloth,
    Sphere,
    Wind,
    grid,
    rest_state,
    simulate,
    solver,
)
from drapery.settings import SolverName

SHEETS = ("desbrun", "provot", "verlet", "xpbd")
"""The solvers that lay out a fine grid as a sheet."""


def cloths(name: str) -> Iterator[Cloth]:
    """One cloth for each layout that a solver has kernels for."""
    yield grid(4, 5, 1.0, 1.0)
    if name in SHEETS:
        yield grid(18, 9, 1.0, 1.0)
    if name == "desbrun":
        yield grid(4, 5, 1.0, 1.0, pins="none")


def solve(dtype: type) -> None:
    """One step of every solver in one floating-point type."""
    for name in get_args(SolverName):
        for cloth in cloths(name):
            forces = [Gravity(), Wind((0.0, 0.0, 4.0))]
            states = simulate(
                cloth, solver(name), forces, 1 / 60, start=rest_state(cloth, dtype=dtype)
            )
            next(islice(states, 1, None))


def single() -> None:
    """Single precision, which pictures use, and the pictures."""
    solve(np.float32)
    draw(Banner.parse("red creeper:lime"), view="hero", shadow=True, size=(32, 32))


def double() -> None:
    """Double precision, and collisions, which always use it."""
    solve(np.float64)
    shapes = (Collider(Sphere(np.zeros(3), 0.1)), Collider(Box(np.zeros(3), np.full(3, 0.1))))
    met = Collisions(shapes, apart=0.01)
    MovingCloth.begin(grid(4, 5, 1.0, 1.0), solver("xpbd"), collisions=met).advance((Gravity(),))


def tests() -> None:
    """The bytecode of the test files, whose assertions pytest rewrites: half a minute, which each
    worker would take. Where some is stored already, few files need it."""
    folder = Path(__file__).parent
    if not sys.dont_write_bytecode and not any(folder.glob("*/__pycache__/*-pytest-*.pyc")):
        with redirect_stdout(StringIO()):  # a file that cannot be read is reported by the workers
            pytest.main(["-n", "0", "--collect-only", "-p", "no:cacheprovider", str(folder)])


PARTS: dict[str, Callable[[], None]] = {
    "single": single,
    "double": double,
    "tests": tests,
}


def compile_all() -> None:
    """Compile all parts at once; with kernels that are stored already it takes a few seconds.

    Raises CalledProcessError.
    """
    command = [sys.executable, __file__]
    running = [subprocess.Popen([*command, part], env=untraced_environment()) for part in PARTS]
    codes = [process.wait() for process in running]
    for code, process in zip(codes, running, strict=True):
        if code:
            raise subprocess.CalledProcessError(code, process.args)


if __name__ == "__main__":
    PARTS[sys.argv[1]]()
