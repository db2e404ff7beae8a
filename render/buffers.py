"""What a renderer knows of each pixel beside its colour."""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Floats, Integers, Mask, UVs, Vectors

BACKGROUND = -1
"""The model, and the material, of a pixel that shows none."""


@dataclass(frozen=True, eq=False)
class Buffers:
    """What lies in the middle of each pixel of a picture, top row first.

    Surfaces that blend, such as contact shadows, are not in the buffers.

    depth: distance from the camera along its line of sight [m], shape [H, W], float32; infinite
        on the background.
    normal: unit vector of the surface in the scene's axes, shape [H, W, 3], float32; zero on the
        background.
    model: number of the model in `Scene.models`, shape [H, W], int32; -1 on the background.
    uv: texture coordinates, shape [H, W, 2], float32; zero on the background.
    material: number of the material, shape [H, W], int32; -1 on the background. The materials of
        `Scene.models` are numbered from 0 in their order; those with the same textures, tints, use
        of alpha and light have one number.
    """

    depth: Floats
    normal: Vectors
    model: Integers
    uv: UVs
    material: Integers

    @property
    def coverage(self) -> Mask:
        """Whether a pixel shows a model, shape [H, W]."""
        covered: NDArray[np.bool_] = self.model != BACKGROUND
        return covered

    def every(self, step: int) -> "Buffers":
        """The buffers in the middle of each square of `step` x `step` pixels."""
        at = np.ix_(*(middles(side, step) for side in self.model.shape))
        return Buffers(*(getattr(self, each.name)[at] for each in fields(self)))

    @classmethod
    def empty(cls, size: tuple[int, int]) -> "Buffers":
        """Those of a background of this width and height."""
        shape = size[1], size[0]
        return cls(
            np.full(shape, np.inf, np.float32),
            np.zeros((*shape, 3), np.float32),
            np.full(shape, BACKGROUND, np.int32),
            np.zeros((*shape, 2), np.float32),
            np.full(shape, BACKGROUND, np.int32),
        )


def middles(side: int, step: int) -> NDArray[np.intp]:
    """The middle of every `step` pixels of a side; the last ones may be fewer than `step`."""
    at = np.arange(-(-side // step), dtype=np.intp) * step + step // 2
    return np.minimum(at, side - 1)
