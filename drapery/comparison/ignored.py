"""Which pixels do not count in a comparison."""

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Mask, Pixels
from drapery.comparison.limits import Box
from drapery.errors import OptionError

_PAINTED = 128
"""From this alpha and this colour on a pixel of a mask is painted."""


def painted(mask: Pixels) -> Mask:
    """Which pixels a mask picture leaves out of a comparison, shape [H, W].

    Those that are opaque and not dark: white on black, or any bright colour on nothing.
    """
    bright: NDArray[np.bool_] = mask[..., :3].max(axis=-1) >= _PAINTED
    return bright & (mask[..., 3] >= _PAINTED)


def ignored_pixels(
    size: tuple[int, int], boxes: tuple[Box, ...], mask: Mask | None = None
) -> Mask | None:
    """Which pixels do not count, shape [H, W]; None if all count.

    size: height and width [px].
    boxes: left, top, width and height of each area [px].
    mask: see `painted`, shape [H, W].

    Raises OptionError for a mask of another size, or a box outside the picture, which would do
    nothing.
    """
    height, width = size
    if mask is not None and mask.shape != (height, width):
        raise OptionError(
            f"the mask is {mask.shape[1]}x{mask.shape[0]} and the picture {width}x{height};"
            " use a mask of the picture's size"
        )
    if not boxes:
        return mask
    ignored = np.zeros((height, width), bool) if mask is None else mask.copy()
    for left, top, across, down in boxes:
        if left >= width or top >= height:
            raise OptionError(
                f"ignored box {left},{top},{across},{down} lies outside the picture of"
                f" {width}x{height}; move it"
            )
        ignored[top : top + down, left : left + across] = True
    return ignored
