"""Compile the kernels that most tests use: `python tests/compile_kernels.py single|double|web`.

The parts have no kernel in common, so they can run at once; `.ci/run` does so before the tests.
Otherwise each worker of pytest compiles what it needs, and many kernels are compiled twice.
"""

import sys
from collections.abc import Callable, Iterator
from itertools import islice
from typing import get_args

import numpy as np

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

SHEETS = ("desbrun", "xpbd")
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


def web() -> None:
    """The module for pages, for which the workers would wait one after the other."""
    from wasm_player import built_module

    built_module()


PARTS: dict[str, Callable[[], None]] = {"single": single, "double": double, "web": web}

if __name__ == "__main__":
    PARTS[sys.argv[1]]()
