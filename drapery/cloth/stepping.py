"""The time loop: states of a cloth, step after step."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from drapery.cloth.checks import shown
from drapery.cloth.cloth import Cloth
from drapery.cloth.forces import Force, Gravity, lower_forces
from drapery.cloth.pins import PinPath
from drapery.cloth.solvers.base import Solver, check_state, check_step
from drapery.cloth.solvers.desbrun import SolverDesbrun
from drapery.cloth.state import State, rest_state
from drapery.errors import OptionError

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

    solver: SolverDesbrun() unless given. forces: gravity alone unless given. dt: one step [s].
    start: the rest shape unless given, `count` times. pins: a path for the pinned particles.
    collisions: what the cloth meets after every step. Cut it with `itertools.islice`.
    The call raises OptionError for wrong arguments; the iterator does where a force or a path
    gives what cannot be used, or the cloth is torn to infinity.
    """
    solver = SolverDesbrun() if solver is None else solver
    check_step(dt, every)
    check_arguments(cloth, solver, pins)
    state = rest_state(cloth, count) if start is None else start
    check_state(cloth, state)
    lower_forces(forces, cloth, len(state.positions))
    solver_state = solver.init(cloth, dt)
    if collisions is None:
        return _states(cloth, solver, forces, dt, state, solver_state, every, pins)
    # Imported here: a cloth that meets nothing starts without the colliders' kernels.
    from drapery.cloth.collisions import collision_world

    resolve = collision_world(cloth, collisions).resolve
    return _colliding(cloth, solver, forces, dt, state, solver_state, every, pins, resolve)


def check_arguments(cloth: Cloth, solver: Solver, pins: PinPath | None) -> None:
    """Raises OptionError for what is not a cloth, a solver or a path."""
    if not isinstance(cloth, Cloth):
        raise OptionError(f"cloth {shown(cloth)} is not a Cloth; use grid, disc or from_mesh")
    if not (hasattr(solver, "init") and hasattr(solver, "step")) or isinstance(solver, type):
        raise OptionError(f"solver {shown(solver)} is not a solver; use SolverXPBD() or the like")
    if pins is not None and not callable(pins):
        raise OptionError(f"pins {shown(pins)} is not a path; give a function of the time [s]")


def _states(
    cloth: Cloth,
    solver: Solver,
    forces: Sequence[Force],
    dt: float,
    state: State,
    solver_state: Any,
    every: int,
    pins: PinPath | None,
) -> Iterator[State]:
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
    resolve: Callable[[State, State], State],
) -> Iterator[State]:
    """The same, step by step, with the collision stage after each."""
    while True:
        yield state
        for _ in range(every):
            before = state
            after, solver_state = solver.step(cloth, before, solver_state, forces, dt, pins=pins)
            state = resolve(before, after)
