"""The protocol that every solver follows, and checks that solvers share."""

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from drapery.cloth.checks import check_count, check_number
from drapery.cloth.cloth import Cloth
from drapery.cloth.forces import Force
from drapery.cloth.pins import PinPath
from drapery.cloth.state import State
from drapery.errors import OptionError, shown
from drapery.mesh import Array

MIN_DT, MAX_DT = 1e-9, 1e3
"""Bounds of a step [s]."""
MAX_STEPS = 10**9


class Solver(Protocol):
    """A method of time integration. A solver object holds only the settings of the method.

    Data that a method needs between steps (filters, previous positions, multipliers) are in the
    solver state: `init` makes one for a cloth and a step, each `step` takes one and returns the
    next.
    """

    def init(self, cloth: Cloth, dt: float) -> Any:
        """A solver state for steps of one cloth.

        cloth: the cloth that moves.
        dt: one step [s].

        Raises OptionError for a cloth or step that the method cannot move.
        """

    def step(
        self,
        cloth: Cloth,
        state: State,
        solver_state: Any,
        forces: Sequence[Force],
        dt: float,
        *,
        steps: int = 1,
        pins: PinPath | None = None,
    ) -> tuple[State, Any]:
        """The state of the cloths some steps later, and the next solver state.

        Several steps in one call give the same result as one step per call, and are faster.

        cloth: the cloth of which these are.
        state: positions and velocities before the steps.
        solver_state: what `init` or the call before returned.
        forces: what acts on the cloths in these steps.
        dt: one step [s].
        steps: number of steps.
        pins: a path that the pinned particles follow; None leaves them in place.

        Raises OptionError for a force or path that gives a wrong value.
        """


def check_step(dt: float, steps: int) -> None:
    """Raises OptionError unless dt is from 1e-9 s to 1000 s and there is at least one step."""
    check_number("dt", dt, MIN_DT, MAX_DT, "s")
    check_count("steps", steps, 1, MAX_STEPS)


def check_state(cloth: Cloth, state: State) -> None:
    """Raises OptionError unless the state is finite and fits the cloth."""
    if not isinstance(state, State):
        raise OptionError(f"state {shown(state)} is not a State; use rest_state(cloth)")
    expected = cloth.rest_positions.shape
    for name in ("positions", "velocities"):
        values = getattr(state, name)
        if getattr(values, "dtype", None) not in (np.float32, np.float64):
            raise OptionError(f"state {name} must be an array of float32 or float64")
        if values.ndim != 3 or values.shape[1:] != expected:
            raise OptionError(f"state {name} have shape {values.shape}; use [B, {expected[0]}, 3]")
        if not all_finite(values):
            raise OptionError(f"state {name} hold NaN or infinity; give finite numbers")


def check_moved(cloth: Cloth, solver: Solver, state: State) -> None:
    """Raises OptionError unless a solver of somebody else gave a finite state of the cloth."""
    places = getattr(state, "positions", None)
    if isinstance(places, np.ndarray) and places.dtype.kind == "f" and not all_finite(places):
        raise OptionError(
            f"positions became infinite before {state.time:.4g} s; "
            "use a smaller dt, weaker forces or another solver"
        )
    try:
        check_state(cloth, state)
    except OptionError as error:
        raise OptionError(f"solver {type(solver).__name__} gave a wrong state: {error}") from None


def all_finite(values: Array) -> bool:
    """Whether there is no NaN or infinity."""
    # A sum is finite only if all values are, and is much faster than a test of each value.
    with np.errstate(over="ignore", invalid="ignore"):
        return bool(np.isfinite(values.sum(dtype=values.dtype)) or np.isfinite(values).all())
