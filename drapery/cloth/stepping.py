"""The time loop: states of a cloth, step after step."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Self

from drapery.cloth.cloth import Cloth
from drapery.cloth.forces import Force, Gravity, lower_forces
from drapery.cloth.pins import PinPath
from drapery.cloth.solvers.base import Solver, check_moved, check_state, check_step
from drapery.cloth.solvers.driver import KernelSolver
from drapery.cloth.solvers.registry import solver as make_solver
from drapery.cloth.state import State, rest_state
from drapery.cloth.strain import NEVER, TOLD, warn_of_strain
from drapery.errors import OptionError, shown

if TYPE_CHECKING:
    from drapery.cloth.collisions import Collisions
    from drapery.cloth.contact.box_data import BoxColliders


@dataclass(frozen=True, eq=False)
class MovingCloth:
    """Cloths of one topology at one moment; `simulate` for forces that change between steps.

    cloth: the cloth of which these are.
    solver: the method that moves them.
    dt: one step [s].
    state: positions and velocities at this moment.
    solver_state: what the solver remembers between steps.
    resolve: the collision stage after each step, for shapes and solvers that `boxes` does not
        serve; None where the cloths meet nothing there.
    boxes: what the cloths meet inside the solver's steps; None where they meet nothing there.
    """

    cloth: Cloth
    solver: Solver
    dt: float
    state: State
    solver_state: Any
    resolve: Callable[[State, State], State] | None = None
    boxes: BoxColliders | None = None

    @staticmethod
    def begin(
        cloth: Cloth,
        solver: Solver | None = None,
        dt: float = 1.0 / 60.0,
        *,
        start: State | None = None,
        count: int = 1,
        collisions: Collisions | None = None,
    ) -> MovingCloth:
        """The cloths before their first step.

        cloth: the cloth that moves.
        solver: `SolverXPBD()` by default.
        dt: one step [s].
        start: by default `count` cloths in the rest shape.
        count: number of cloths of the default start.
        collisions: resolved after every step.

        Raises OptionError for wrong arguments.
        """
        solver = make_solver() if solver is None else solver
        check_step(dt, 1)
        _check_types(cloth, solver)
        state = rest_state(cloth, count) if start is None else start
        check_state(cloth, state)
        solver_state = solver.init(cloth, dt)
        met = _contact_of(cloth, solver, solver_state, collisions)
        return MovingCloth(cloth, solver, dt, state, solver_state, *met)

    def advance(self, forces: Sequence[Force], steps: int = 1, pins: PinPath | None = None) -> Self:
        """The cloths some time steps later.

        Warns where pins or colliders pull cloth apart for the first time, of the worst moment in
        these steps; `State.worst` is the worst of the whole motion.

        forces: what acts on the cloths in these steps.
        steps: number of time steps.
        pins: a path that the pinned particles follow; None leaves them in place.

        Raises OptionError where the cloths are torn to infinity.
        """
        moved = self.unmet(forces, steps, pins)
        if self.state.strain <= TOLD:
            warn_of_strain(moved.state.worst)
        return moved

    def unmet(self, forces: Sequence[Force], steps: int = 1, pins: PinPath | None = None) -> Self:
        """The cloths some time steps later, before they meet cloths of other topologies.

        The caller resolves that contact, and warns of their strain.

        forces: what acts on the cloths in these steps.
        steps: number of time steps.
        pins: a path that the pinned particles follow; None leaves them in place.

        Raises OptionError where the cloths are torn to infinity.
        """
        check_step(self.dt, steps)
        state, solver_state = self.state, self.solver_state
        # One call makes all steps, unless the collision stage follows each.
        calls, each = (1, steps) if self.resolve is None else (steps, 1)
        meets: dict[str, Any] = {} if self.boxes is None else {"boxes": self.boxes}
        for _ in range(calls):
            before = state
            state, solver_state = self.solver.step(
                self.cloth, before, solver_state, forces, self.dt, steps=each, pins=pins, **meets
            )
            if not isinstance(self.solver, KernelSolver):
                check_moved(self.cloth, self.solver, state)
            state = state if self.resolve is None else self.resolve(before, state)
        return replace(self, state=state, solver_state=solver_state)


def _contact_of(
    cloth: Cloth, solver: Solver, solver_state: Any, collisions: Collisions | None
) -> tuple[Callable[[State, State], State] | None, BoxColliders | None]:
    """The `resolve` and `boxes` of a `MovingCloth`. Raises OptionError."""
    if collisions is None:
        return None, None
    # Imported here: a cloth that meets nothing starts without the colliders' kernels.
    from drapery.cloth.collisions import met_inside, resolver

    inside = isinstance(solver, KernelSolver)
    if inside and collisions.apart is not None:
        inside = not solver_state.often  # contact of a cloth with itself is resolved once a step
    boxes = met_inside(cloth, collisions) if inside else None
    if boxes is not None:
        return None, boxes
    limit = solver_state.limit if isinstance(solver, KernelSolver) else NEVER
    return resolver(cloth, collisions, limit), None


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
    """An endless iterator of states: the start, then one state after every `every` steps.

    `itertools.islice` takes a number of states.

    cloth: the cloth that moves.
    solver: `SolverXPBD()` by default.
    forces: by default only gravity.
    dt: one step [s].
    start: by default `count` cloths in the rest shape.
    every: steps from one state to the next.
    pins: a path of the pinned particles.
    count: number of cloths of the default start.
    collisions: resolved after every step.

    Raises OptionError for wrong arguments; the iterator raises it where a force or a path returns a
    wrong value, and where positions become infinite.
    """
    check_step(dt, every)
    moving = MovingCloth.begin(cloth, solver, dt, start=start, count=count, collisions=collisions)
    if pins is not None and not callable(pins):
        raise OptionError(f"pins {shown(pins)} is not a path; give a function of the time [s]")
    lower_forces(forces, cloth, len(moving.state.positions))
    return _states(moving, forces, every, pins)


def _states(
    moving: MovingCloth, forces: Sequence[Force], every: int, pins: PinPath | None
) -> Iterator[State]:
    while True:
        yield moving.state
        moving = moving.advance(forces, every, pins)


def _check_types(cloth: Cloth, solver: Solver) -> None:
    """Raises OptionError for what is not a cloth or not a solver."""
    if not isinstance(cloth, Cloth):
        raise OptionError(f"cloth {shown(cloth)} is not a Cloth; use grid, disc or from_mesh")
    if not (hasattr(solver, "init") and hasattr(solver, "step")) or isinstance(solver, type):
        named = f"solver({solver!r})" if isinstance(solver, str) else "SolverXPBD() or the like"
        raise OptionError(f"solver {shown(solver)} is not a solver; use {named}")
