"""The velocity of particles that contact moved: their motion over the step, up to a limit.

Without a new velocity, a cloth that its solver pulls into a surface at every step would keep the
speed of that pull. Without the limit, what contact takes back of a long way would become speed. The
limit is the speed at which the solver left a particle, or the speed of what pushed it.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.vectors import Vector, norm, row, scale
from drapery.cloth.contact.geometry import put
from drapery.jit import entry_point, kernel
from drapery.mesh import Array


@kernel
def moved_velocity(seen: Vector, most: Any) -> Vector:
    """The velocity [m/s] of a particle that contact moved. seen: of its motion over the step [m/s].
    most: its greatest speed [m/s]."""
    length = norm(seen)
    return scale(most / length if length > most else 1.0, seen)


@entry_point
def set_velocities(v: Array, seen: Array, moved: NDArray[np.bool_], most: Array) -> None:
    """Set the velocities v of the particles that contact moved, of B cloths.

    v: [m/s], [B, N, 3]. seen: of their motion over the step [m/s], [B, N, 3]. moved: whether
    contact moved a particle, [B, N]. most: its greatest speed [m/s], [B, N].
    """
    for cloth in range(len(v)):
        for i in range(v.shape[1]):
            if moved[cloth, i]:
                put(v[cloth], i, 0, moved_velocity(row(seen[cloth], i), most[cloth, i]))


def speeds_of(v: Array) -> Array:
    """The speeds [m/s] of velocities [..., 3]."""
    speeds: Array = np.sqrt((v * v).sum(axis=-1))
    return speeds
