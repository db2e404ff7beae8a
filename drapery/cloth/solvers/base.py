"""What every solver is."""

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from drapery.cloth.cloth import Cloth
from drapery.cloth.forces import Force
from drapery.cloth.pins import PinPath
from drapery.cloth.state import State
from drapery.errors import OptionError
from drapery.mesh import Array


class Solver(Protocol):
    """A method of stepping cloths: its options only.

    What it remembers between steps (filters, previous positions, multipliers) is its memory: made
    by `init` for one cloth and step, handed to each `step` and returned by it.
    """

    def init(self, cloth: Cloth, dt: float) -> Any:
        """A memory for steps of dt [s] of this cloth. Raises OptionError."""

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
        """The state `steps` steps of dt [s] later; several steps in one call are the same, faster.

        pins: a path that the pinned particles follow; None leaves them where they are.
        Raises OptionError.
        """


def check_step(dt: float, steps: int) -> None:
    """Raises OptionError unless dt is a positive number and there is at least one step."""
    if not (np.isfinite(dt) and dt > 0):
        raise OptionError(f"dt {dt!r} is out of range; use a number of seconds over 0")
    if steps < 1:
        raise OptionError(f"steps {steps} is too few; use at least 1")


def check_state(cloth: Cloth, state: State) -> None:
    """Raises OptionError unless the state is finite and fits the cloth."""
    expected = cloth.rest_positions.shape
    for name in ("positions", "velocities"):
        values = getattr(state, name)
        if values.ndim != 3 or values.shape[1:] != expected:
            raise OptionError(f"state {name} have shape {values.shape}; use [B, {expected[0]}, 3]")
        if not all_finite(values):
            raise OptionError(f"state {name} hold NaN or infinity; give finite numbers")


def all_finite(values: Array) -> bool:
    """Whether there is no NaN or infinity."""
    # A sum is finite only if all are, and far quicker than asking each.
    with np.errstate(over="ignore", invalid="ignore"):
        return bool(np.isfinite(values.sum(dtype=values.dtype)) or np.isfinite(values).all())
