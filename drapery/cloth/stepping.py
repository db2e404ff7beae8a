"""The one time loop."""

from collections.abc import Iterator, Sequence

from drapery.cloth.cloth import Cloth
from drapery.cloth.forces import Force, Gravity
from drapery.cloth.pins import PinPath
from drapery.cloth.solvers.base import Solver, check_state, check_step
from drapery.cloth.solvers.desbrun import SolverDesbrun
from drapery.cloth.state import State, rest_state


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
) -> Iterator[State]:
    """States of a moving cloth without end: the start, then one after every `every` steps.

    solver: SolverDesbrun() unless given. dt: one step [s]. start: the rest shape unless given,
    `count` times. pins: a path for the pinned particles. Cut it with `itertools.islice`.
    Raises OptionError.
    """
    solver = solver or SolverDesbrun()
    check_step(dt, every)
    state = start or rest_state(cloth, count)
    check_state(cloth, state)
    memory = solver.init(cloth, dt)
    while True:
        yield state
        state, memory = solver.step(cloth, state, memory, forces, dt, steps=every, pins=pins)
