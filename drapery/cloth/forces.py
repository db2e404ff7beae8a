"""Forces that act on every particle alike, and how any force reaches a solver.

The known forces (Gravity, Drag, Wind) are lowered to a few numbers that the kernels read; any
other object with an `acceleration` method is called once a step.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from drapery.cloth.cloth import Cloth
from drapery.cloth.pins import PosePath
from drapery.cloth.state import State
from drapery.cloth.wind import Gusts, Wind, lower_winds
from drapery.errors import OptionError
from drapery.mesh import Array

INSTANT = 1e-3
"""Half the time over which a carrier's velocity is taken [s]."""


@dataclass(frozen=True)
class Gravity:
    """A uniform acceleration [m/s²]."""

    acceleration: tuple[float, float, float] = (0.0, -9.81, 0.0)


@dataclass(frozen=True)
class Drag:
    """Linear drag in still air: acceleration -rate · v, so a falling cloth ends at g / rate.

    rate: [1/s].
    """

    rate: float = 0.1


@dataclass(frozen=True)
class PushBack:
    """A push opposite to a carrier's motion, such as capes get from their wearers: -rate · v.

    path: the carrier's pose over time; its translation's velocity v [m/s] counts. rate: [1/s].
    """

    path: PosePath
    rate: float = 1.0

    def acceleration(self, cloth: Cloth, state: State) -> Array:
        """[B, N, 3], the same for every particle. Raises OptionError."""
        ahead, behind = (self.path(state.time + offset)[1] for offset in (INSTANT, -INSTANT))
        velocity = (np.asarray(ahead) - np.asarray(behind)) / (2 * INSTANT)
        push = finite_vector("push back", tuple(-_rate(self.rate) * velocity))
        return np.broadcast_to(push, state.positions.shape)


@runtime_checkable
class ForceField(Protocol):
    """Any other force."""

    def acceleration(self, cloth: Cloth, state: State) -> Array:
        """Acceleration of each particle [m/s²], shape [B, N, 3] or [N, 3]."""


Force = Gravity | Drag | Wind | ForceField


@dataclass(frozen=True, eq=False)
class Loads:
    """Forces as the kernels read them.

    gravity: [m/s²], shape [3]. drag: [1/s]. gusts: all winds. custom: called at every step.
    """

    gravity: Array
    drag: float
    gusts: Gusts
    custom: tuple[ForceField, ...]


def lower_forces(forces: Sequence[Force], cloth: Cloth, count: int) -> Loads:
    """Check and lower the forces on `count` cloths. Raises OptionError."""
    gravity = np.zeros(3)
    drag = cloth.drag
    winds: list[Wind] = []
    custom: list[ForceField] = []
    for force in forces:
        if isinstance(force, Gravity):
            gravity += finite_vector("gravity", force.acceleration)
        elif isinstance(force, Drag):
            drag += _rate(force.rate)
        elif isinstance(force, Wind):
            winds.append(force)
        elif isinstance(force, ForceField):
            custom.append(force)
        else:
            raise OptionError(f"force {force!r} has no method acceleration(cloth, state); add one")
    return Loads(gravity, drag, lower_winds(winds, count), tuple(custom))


def custom_accelerations(loads: Loads, cloth: Cloth, state: State) -> Array:
    """The sum of the custom forces, [B, N, 3]; [1, 0, 3] if there are none. Raises OptionError."""
    if not loads.custom:
        return np.zeros((1, 0, 3), state.positions.dtype)
    total = np.zeros_like(state.positions)
    for force in loads.custom:
        try:
            total += force.acceleration(cloth, state)
        except ValueError:
            expected = state.positions.shape
            raise OptionError(f"force {force!r} must give accelerations {expected}") from None
    if not np.isfinite(total).all():
        raise OptionError("a custom force gave NaN or infinity; give finite accelerations [m/s²]")
    return total


def finite_vector(name: str, value: tuple[float, float, float]) -> Array:
    """Three finite numbers as an array. Raises OptionError."""
    vector = np.asarray(value, float)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise OptionError(f"{name} {value!r} is not a vector; give three finite numbers")
    return vector


def _rate(rate: float) -> float:
    if not (np.isfinite(rate) and rate >= 0):
        raise OptionError(f"drag rate {rate!r} is out of range; use a number from 0 up [1/s]")
    return float(rate)
