"""Lights: factors that multiply the colours of surfaces."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Floats, Vectors
from drapery.render.vectors import dots

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Light:
    """Directional lights over an ambient floor, as the game shades block entities.

    brightness = min(1, ambient + diffuse * sum over lights of max(0, L . n))

    directions: towards each light; need not be unit vectors.
    ambient: brightness where no light falls, 0 to 1.
    diffuse: brightness that one light adds to a surface that faces it.
    tint: the light's colour, a factor for each of red, green and blue.
    shadows: whether the first direction casts shadows, and less of the other light reaches folds
        and corners. Both backends draw them, on and by lit materials; pyrender only where no
        material has LabPBR maps.
    """

    directions: tuple[Vector, ...]
    ambient: float
    diffuse: float
    tint: Vector = (1.0, 1.0, 1.0)
    shadows: bool = False

    def unit_directions(self) -> Vectors:
        """Towards each light, shape [L, 3]."""
        towards = np.array(self.directions, np.float64).reshape(-1, 3)
        unit: NDArray[np.float64] = towards / np.sqrt(dots(towards, towards))[:, None]
        return unit

    def brightness(self, normals: Vectors) -> Floats:
        """The factor in 0..1 for unit normals of shape [..., 3]; shape [...]."""
        total = np.full(normals.shape[:-1], self.ambient, normals.dtype)
        for unit in self.unit_directions():
            facing = sum(normals[..., axis] * normals.dtype.type(unit[axis]) for axis in range(3))
            total = total + normals.dtype.type(self.diffuse) * np.maximum(facing, 0)
        return np.minimum(total, 1)


GAME_LIGHT = Light(((0.2, 1.0, -0.7), (-0.2, 1.0, 0.7)), 0.4, 0.6)
"""The two lights of the game's world."""

STUDIO_LIGHT = Light(((-0.55, 0.85, 0.75), (0.8, 0.35, 0.6)), 0.34, 0.42, shadows=True)
"""One light from the upper left, which casts shadows, and a second one from the right.

Only what faces the middle between the two is fully bright, so folds show on white cloth too."""

GLIMMER = 0.04
"""The least factor, used where no light falls."""

UNLIT = Light((), 1.0, 0.0)
"""Full brightness everywhere: the plain colours of the texture."""


def lit_at(light: Light, block: int, sky: int, daylight: float = 1.0) -> Light:
    """The light at a place of the game's world with these light levels.

    The brightness of a level is l / (4 - 3 l) with l = level / 15; torches are warm, a night sky is
    blue. The sum of the two colours is limited to 1 and has a small lower bound.

    light: the light where the levels are 15 by day.
    block: the game's light level of torches, 0..15.
    sky: the game's light level of the sky, 0..15.
    daylight: 1 at noon, 0 at night.
    """
    torch, above = (level / 15 / (4 - 3 * level / 15) for level in (block, sky))
    warm = (torch, torch * (0.64 + 0.36 * torch), torch * (0.4 + 0.6 * torch * torch))
    night = 0.25 + 0.75 * daylight
    pale = (
        above * night * (0.5 + 0.5 * daylight),
        above * night * (0.6 + 0.4 * daylight),
        above * night,
    )
    red, green, blue = (
        factor * min(1.0, max(GLIMMER, a + b))
        for factor, a, b in zip(light.tint, warm, pale, strict=True)
    )
    return replace(light, tint=(red, green, blue))
