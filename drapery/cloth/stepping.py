"""The one time loop."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from drapery.cloth.cloth import Cloth
from drapery.cloth.forces import Force, Gravity
from drapery.cloth.pins import PinPath
from drapery.cloth.solvers.base import Solver, check_state, check_step
from drapery.cloth.solvers.desbrun import SolverDesbrun
from drapery.cloth.state import State, rest_state

if TYPE_CHECKING:
    from drapery.cloth.collisions import Collisions


def simulate(
    cloth: Cloth,
    solver: Solver | None = None,
    forces: Sequence[Force] = (Gravity(),),
    dt: float = 1.0 / 60.0,
    *,
    start: State | None = None,
    every: int = 1,
    pins: PinPath | None = None,
    count: int = 1,
    collisions: Collisions | None = None,
) -> Iterator[State]:
    """States of a moving cloth without end: the start, then one after every `every` steps.

    solver: SolverDesbrun() unless given. dt: one step [s]. start: the rest shape unless given,
    `count` times. pins: a path for the pinned particles. collisions: what the cloth meets after
    every step. Cut it with `itertools.islice`. Raises OptionError.
    """
    solver = solver or SolverDesbrun()
    check_step(dt, every)
    state = start or rest_state(cloth, count)
    check_state(cloth, state)
    solver_state = solver.init(cloth, dt)
    if collisions is not None:
        yield from _colliding(
            cloth, solver, forces, dt, state, solver_state, every, pins, collisions
        )
    while True:
        yield state
        state, solver_state = solver.step(
            cloth, state, solver_state, forces, dt, steps=every, pins=pins
        )


def _colliding(
    cloth: Cloth,
    solver: Solver,
    forces: Sequence[Force],
    dt: float,
    state: State,
    solver_state: Any,
    every: int,
    pins: PinPath | None,
    collisions: Collisions,
) -> Iterator[State]:
    """The same, step by step, with the collision stage after each."""
    # Imported here: a cloth that meets nothing starts without the colliders' kernels.
    from drapery.cloth.collisions import collision_stage

    stage = collision_stage(cloth, collisions)
    while True:
        yield state
        for _ in range(every):
            before = state
            after, solver_state = solver.step(cloth, before, solver_state, forces, dt, pins=pins)
            state = stage(before, after)
