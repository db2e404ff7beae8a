"""Gravity and drag, the protocol of user-defined forces, and their form for the kernels.

Gravity, Drag and Wind become arrays that kernels read. Any other object with an `acceleration`
method is called once a step.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from drapery.arrays import Vectors
from drapery.cloth.checks import check_number, vector3
from drapery.cloth.cloth import Cloth
from drapery.cloth.fabric import MAX_DRAG
from drapery.cloth.ripples import with_waves
from drapery.cloth.state import State
from drapery.cloth.wind import Gusts, Wind, lower_winds
from drapery.errors import OptionError, shown
from drapery.mesh import Array

MAX_GRAVITY = 1e6
"""The largest component of a uniform acceleration [m/s²]."""


@dataclass(frozen=True)
class Gravity:
    """A uniform acceleration of every particle.

    acceleration: [m/s²], each component from -1e6 to 1e6. `simulate` checks it (OptionError).
    """

    acceleration: tuple[float, float, float] = (0.0, -9.81, 0.0)


@dataclass(frozen=True)
class Drag:
    """Linear drag in still air: acceleration -rate · v, so the speed of a fall tends to g / rate.

    rate: [1/s], 0 to 1e6; it adds to the drag of the cloth's `Fabric`. `simulate` checks it
    (OptionError).
    """

    rate: float = 0.1


@runtime_checkable
class ForceField(Protocol):
    """A user-defined force: any object with this method, which is called once a step."""

    def acceleration(self, cloth: Cloth, state: State) -> Vectors:
        """Acceleration of each particle [m/s²], shape [B, N, 3] or [N, 3], all finite.

        cloth: the cloth on which the force acts.
        state: B such cloths at one time.
        """


Force = Gravity | Drag | Wind | ForceField
"""What acts on the particles of a cloth; a ForceField is any object of your own with the
method `acceleration`."""


@dataclass(frozen=True, eq=False)
class Loads:
    """Forces as the kernels read them.

    gravity: [m/s²], shape [3]. drag: [1/s]. gusts: all winds. custom: user-defined forces.
    """

    gravity: Array
    drag: float
    gusts: Gusts
    custom: tuple[ForceField, ...]


def lower_forces(forces: Sequence[Force], cloth: Cloth, count: int) -> Loads:
    """Check the forces on `count` cloths and convert them for the kernels. Raises OptionError."""
    gravity = np.zeros(3)
    drag = cloth.drag
    winds: list[Wind] = []
    custom: list[ForceField] = []
    if not isinstance(forces, list | tuple):
        raise OptionError(f"forces {shown(forces)} are not a list; use [Gravity()] or the like")
    for force in forces:
        if isinstance(force, Gravity):
            gravity += vector3("gravity", force.acceleration, MAX_GRAVITY, "m/s²")
        elif isinstance(force, Drag):
            drag += check_number("drag rate", force.rate, 0, MAX_DRAG, "1/s")
        elif isinstance(force, Wind):
            winds.append(force)
        elif isinstance(force, ForceField):
            custom.append(force)
        else:
            raise OptionError(
                f"force {shown(force)} has no method acceleration(cloth, state); add one"
            )
    gusts = with_waves(lower_winds(winds, count), winds, cloth)
    return Loads(gravity, drag, gusts, tuple(custom))


def custom_accelerations(loads: Loads, cloth: Cloth, state: State) -> Array:
    """The sum of the custom forces, [B, N, 3]; [1, 0, 3] if there are none. Raises OptionError."""
    if not loads.custom:
        return np.zeros((1, 0, 3), state.positions.dtype)
    total = np.zeros_like(state.positions)
    for force in loads.custom:
        given = force.acceleration(cloth, state)
        try:
            total += np.asarray(given, total.dtype)
        except (TypeError, ValueError):
            raise OptionError(
                f"force {shown(force)} gave {shown(given)}; "
                f"give accelerations [m/s²] of shape {state.positions.shape}"
            ) from None
    if not np.isfinite(total).all():
        raise OptionError("a custom force gave NaN or infinity; give finite accelerations [m/s²]")
    return total
