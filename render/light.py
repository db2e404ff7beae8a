"""How bright a surface is: a factor that multiplies its colour."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Light:
    """Directional lights over an ambient floor, as the game shades block entities.

    brightness = min(1, ambient + diffuse * sum over lights of max(0, L . n))
    directions: towards each light; need not be unit vectors.
    tint: the light's colour, a factor for each of red, green and blue.
    """

    directions: tuple[Vector, ...]
    ambient: float
    diffuse: float
    tint: Vector = (1.0, 1.0, 1.0)

    def unit_directions(self) -> NDArray[np.float64]:
        """Towards each light, shape [L, 3]."""
        towards = np.array(self.directions, np.float64).reshape(-1, 3)
        return towards / np.linalg.norm(towards, axis=1, keepdims=True)

    def brightness(self, normals: Array) -> Array:
        """The factor in 0..1 for unit normals of shape [..., 3]; shape [...]."""
        total = np.full(normals.shape[:-1], self.ambient, normals.dtype)
        for unit in self.unit_directions():
            facing = sum(normals[..., axis] * normals.dtype.type(unit[axis]) for axis in range(3))
            total = total + normals.dtype.type(self.diffuse) * np.maximum(facing, 0)
        return np.minimum(total, 1)


GAME_LIGHT = Light(((0.2, 1.0, -0.7), (-0.2, 1.0, 0.7)), 0.4, 0.6)
"""The two lights of the game's world."""

UNLIT = Light((), 1.0, 0.0)
"""Full brightness everywhere: the plain colours of the texture."""
