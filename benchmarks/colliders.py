"""The cost of a user-defined shape: `python -m benchmarks.colliders`.

It times only the collision step, on one thread. Every row has the same motion of the same cloth,
and is next to the row that it is compared with. Times are the minimum of a few runs; on a busy
machine only their ratios are meaningful.
"""

import argparse
import math
import time
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks.quick import add_quick
from drapery.cloth import Gravity, State, grid, rest_state, simulate
from drapery.cloth.colliders import Capsule, Collider, Shape, Sphere
from drapery.cloth.collisions import Collisions, collision_world
from drapery.mesh import Array

SIDE, ORDER, STEPS, RUNS = 24, 2, 45, 7
QUICK = 3, 1
"""The steps and runs of the quick mode."""
DT = 1 / 60


class UserSphere:
    """A sphere about the origin, defined by a signed distance function."""

    def __init__(self, radius: float) -> None:
        self.parameters = (radius,)
        self.bounds = (-radius,) * 3, (radius,) * 3

    @staticmethod
    def signed_distance(point: Any, parameters: Array) -> float:
        x, y, z = point
        return math.sqrt(x * x + y * y + z * z) - float(parameters[0])


class UserTorus:
    """A torus about the y axis, defined by a signed distance function."""

    def __init__(self, radius: float, tube: float) -> None:
        reach = radius + tube
        self.parameters = radius, tube
        self.bounds = (-reach, -tube, -reach), (reach, tube, reach)

    @staticmethod
    def signed_distance(point: Any, parameters: Array) -> float:
        x, y, z = point
        return math.hypot(math.hypot(x, z) - parameters[0], y) - float(parameters[1])


SHAPES: dict[str, Shape] = {
    "Sphere": Sphere(np.zeros(3), 0.4),
    "a user's sphere": UserSphere(0.4),
    "Capsule": Capsule(np.array([-0.3, 0.0, 0.0]), np.array([0.3, 0.0, 0.0]), 0.12),
    "a user's torus": UserTorus(0.3, 0.12),
}


def motion(shape: Shape, steps: int) -> tuple[list[State], list[State]]:
    """States before and after the steps of a cloth that falls on a shape and comes to rest."""
    cloth = grid(SIDE, SIDE, 1.2, 1.2, pins="none")
    start = rest_state(cloth, dtype=np.float64)
    places = start.positions[..., [0, 2, 1]] * (1, 1, -1)
    places = places - places.mean(axis=1, keepdims=True) + (0, 0.45, 0)
    met = Collisions([Collider(shape, friction=0.6)], threads=1)
    states = simulate(
        cloth, forces=[Gravity()], dt=DT, start=State(places, start.velocities), collisions=met
    )
    before = [next(states) for _ in range(steps)]
    pull = np.array([0.0, -9.81 * DT, 0.0])
    after = [
        State(s.positions + (s.velocities + pull) * DT, s.velocities + pull, s.time + DT)
        for s in before
    ]
    return before, after


def step_ms(shape: Shape, steps: int, runs: int) -> float:
    """Time of a collision step [ms]."""
    cloth = grid(SIDE, SIDE, 1.2, 1.2, pins="none")
    met = Collisions([Collider(shape, friction=0.6)], order=ORDER, threads=1)
    world, (before, after) = collision_world(cloth, met), motion(shape, steps)
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        for a, b in zip(before, after, strict=True):
            world.resolve(a, b)
        times.append((time.perf_counter() - start) / steps)
    return min(times) * 1e3


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    add_quick(parser)
    steps, runs = QUICK if parser.parse_args().quick else (STEPS, RUNS)
    table = Table("shape", "a step [ms]", "to the built-in shape above")
    built_in = 1.0
    for name, shape in SHAPES.items():
        taken = step_ms(shape, steps, runs)
        user = hasattr(shape, "signed_distance")
        table.add_row(name, f"{taken:.3f}", f"{taken / built_in:.2f}" if user else "")
        built_in = built_in if user else taken
    Console().print(table)


if __name__ == "__main__":
    main()
