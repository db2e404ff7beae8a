"""A surface in small: heights, tones and shine on a raster, and texels that a renderer reads."""

from dataclasses import dataclass

import numpy as np

from drapery.arrays import Texels
from drapery.mesh import Array


@dataclass(frozen=True, eq=False)
class Surface:
    """Of each texel of a raster, shape [H, W].

    height: [texels of the raster]. tone: how much lighter it is than the dye, -1 to 1.
    shine: the share of the gloss that it has, 0 to 1.
    """

    height: Array
    tone: Array
    shine: Array

    def texels(self, *, wraps: bool = True) -> Texels:
        """Slopes to the right and down, tone and shine of each texel; see `SurfaceDetail`.

        wraps: whether the raster repeats to the right; else its first and last columns go on. Down
            it always repeats.
        """
        framed = np.pad(self.height, ((0, 0), (1, 1)), mode="wrap" if wraps else "edge")
        right = (framed[:, :-2] - framed[:, 2:]) / 2
        down = (np.roll(self.height, 1, 0) - np.roll(self.height, -1, 0)) / 2
        signed = [128 + 128 * part for part in (right, down, self.tone)]
        numbers = np.stack([*signed, 255 * self.shine], axis=-1)
        texels: Texels = np.clip(np.rint(numbers), 0, 255).astype(np.uint8)
        return texels


def smoothstep(part: Array) -> Array:
    """Of 0..1 with level ends."""
    part = np.clip(part, 0, 1)
    smooth: Array = part * part * (3 - 2 * part)
    return smooth


def noise(shape: tuple[int, ...], seed: int) -> Array:
    """Even noise 0..1."""
    return np.random.default_rng(seed).random(shape)
