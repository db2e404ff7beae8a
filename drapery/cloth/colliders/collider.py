"""A shape with its motion and its surface."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from drapery.cloth.colliders.fields import Field
from drapery.cloth.colliders.packing import pack
from drapery.cloth.colliders.pose import Path, at_rest
from drapery.cloth.colliders.shapes import Shape
from drapery.errors import OptionError


@dataclass(frozen=True, eq=False)
class Collider:
    """A shape that cloth cannot enter.

    shape: a Sphere, Capsule, Box, Plane, Voxels or TriangleMesh, or any object that has a signed
        distance, see `SignedDistance`.
    path: the shape's pose as a function of time [s]; `at_rest` by default.
    restitution: speed after a bounce over the approach speed, 0 to 1.
    friction: Coulomb's coefficient, 0 or more.

    Raises OptionError for numbers out of range, and for a signed distance that numba cannot
    compile or that does not return one finite number.
    """

    shape: Shape
    path: Path = at_rest
    restitution: float = 0.0
    friction: float = 0.3
    packed: Field = field(init=False, repr=False)

    def __post_init__(self) -> None:
        if not 0 <= self.restitution <= 1:
            raise OptionError(
                f"restitution {self.restitution} is out of range; use a number from 0 to 1"
            )
        if not 0 <= self.friction < np.inf:
            raise OptionError(f"friction {self.friction} is out of range; use a number from 0 up")
        object.__setattr__(self, "packed", pack(self.shape))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle without the packed field: addresses of functions are valid in one process only."""
        return Collider, (self.shape, self.path, self.restitution, self.friction)
