"""The picture that the picture steps of a style change, and what is known of its pixels."""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from drapery.arrays import Pixels, Words
from drapery.errors import OptionError
from drapery.render.buffers import Buffers
from drapery.render.flatten import lay_over
from drapery.styles.colours import as_pixels
from drapery.styles.large_pixels import typical_places

ROWS, MAX_LARGE = 85, 32
"""Large pixels from top to bottom of a picture, and their largest side [pixels]."""
VISIBLE, OPAQUE = np.uint32(1 << 24), np.uint32(255 << 24)
"""The least words of pixels that are visible at all, and wholly."""


@dataclass(frozen=True, eq=False)
class Canvas:
    """A picture between two picture steps.

    pixels: sRGB, straight alpha, shape [H, W, 4], uint8, top row first.
    make_buffers: makes `buffers` when a step reads them for the first time.
    grid: the picture is drawn this many times larger than it will be, so that edges are smooth.
    pixel: each pixel becomes a square of this side.
    corner: row and column of the first of these squares at which the picture begins [pixels].
    """

    pixels: Pixels
    make_buffers: Callable[[], Buffers]
    grid: int = 1
    pixel: int = 1
    corner: tuple[int, int] = (0, 0)

    @cached_property
    def buffers(self) -> Buffers:
        """Depth, normal, model and texture coordinates of each pixel. Raises OptionError."""
        found = self.make_buffers()
        if found.model.shape != self.pixels.shape[:2]:
            height, width = found.model.shape
            raise OptionError(
                f"a picture step changed the size of {width} x {height} pixels;"
                " keep it, or use Canvas.coarse"
            )
        return found

    def painted(self, pixels: Pixels) -> "Canvas":
        """The same canvas with other colours, [H, W, 4], uint8.

        Raises OptionError.
        """
        if pixels.ndim != 3 or pixels.shape[2] != 4 or pixels.dtype != np.uint8:
            raise OptionError(
                f"a picture step made pixels of shape {pixels.shape} and type {pixels.dtype};"
                " make [H, W, 4] of uint8"
            )
        return replace(self, pixels=pixels, make_buffers=lambda: self.buffers)

    def words(self) -> Words:
        """The pixels as a copy with one number each, shape [H, W]; see `kernels`."""
        words: Words = np.array(self.pixels, order="C").view(np.uint32)[..., 0]
        return words

    def alone(self) -> "Canvas":
        """The same with its buffers made, so that it does not keep larger canvases in memory."""
        buffers = self.buffers
        return replace(self, make_buffers=lambda: buffers)

    def coarse(self, size: int) -> "Canvas":
        """Each square of `size` x `size` pixels of the result as one, its most typical place.

        size: [pixels]; 0 uses `large_pixel`. What lies in the place goes with its colour.
        """
        size = size or large_pixel(-(-self.pixels.shape[0] // self.grid))
        at = typical_places(self.pixels, size * self.grid)

        def make_buffers() -> Buffers:
            every = (getattr(self.buffers, each.name) for each in fields(Buffers))
            return Buffers(*(values[at] for values in every))

        return Canvas(self.pixels[at], make_buffers, 1, size * self.pixel, self.corner)

    def finished(self, size: tuple[int, int]) -> Pixels:
        """The picture of this width and height: averaged over `grid`, then enlarged."""
        pixels = _averaged(self.pixels, self.grid)
        large = pixels.repeat(self.pixel, axis=0).repeat(self.pixel, axis=1)
        top, left = self.corner
        return np.ascontiguousarray(large[top : top + size[1], left : left + size[0]])


def large_pixel(height: int) -> int:
    """The side of a large pixel in a picture of this height, both [pixels]."""
    return min(MAX_LARGE, max(2, (height + ROWS // 2) // ROWS))


def laid_over(words: Words, behind: Words) -> Words:
    """A picture over another one, shape [H, W], or over one colour, [1, 1]. behind: opaque."""
    drawn = np.where(words < VISIBLE, behind, words)
    (partly,) = np.nonzero(((words >= VISIBLE) & (words < OPAQUE)).reshape(-1))
    if len(partly):
        below = np.broadcast_to(behind, words.shape)
        every = (each.reshape(-1)[partly] for each in (words, below))
        above, under = (each.view(np.uint8).reshape(-1, 4) for each in every)
        as_pixels(drawn).reshape(-1, 4)[partly] = lay_over(above, under)
    return drawn


def _averaged(pixels: Pixels, grid: int) -> Pixels:
    """Squares of grid x grid pixels as one each, weighted by their opacity."""
    if grid == 1:
        return pixels
    from drapery.styles.kernels import average

    words = np.array(pixels, order="C").view(np.uint32)[..., 0]
    result = np.empty((pixels.shape[0] // grid, pixels.shape[1] // grid), np.uint32)
    average(words, grid, result)
    return as_pixels(result)
