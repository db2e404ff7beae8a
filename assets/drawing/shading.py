"""The shade of flat cloth: its weave and its hem. Folds are left to the cloth's shape and light.

All of it is integer arithmetic on shades of 255, so every machine draws the same texels. A dye is
multiplied by these shades; they stay above 235, so that its colour is recognisable.
"""

import numpy as np
from numpy.typing import NDArray

from assets.drawing.canvas import Grey
from assets.drawing.noise import speckle

Axis = NDArray[np.int64]

HEM = 8
"""How much darker the doubled cloth of the hem is."""


def weave(width: int, height: int) -> Axis:
    """Darkness of the threads that pass under, in a plain weave of uneven yarn, [height, width]."""
    x, y = np.arange(width)[None, :], np.arange(height)[:, None]
    under: Axis = np.where((x + y) % 2 == 0, 0, 4) + speckle(width, height, 31) * 5 // 65536
    return under


def hem(width: int, height: int) -> Axis:
    """Darkness of the hem, one texel along all four edges, shape [height, width]."""
    dark = np.full((height, width), HEM, np.int64)
    dark[1:-1, 1:-1] = 0
    return dark


def cloth(width: int, height: int) -> Grey:
    """Shade of flat cloth at each texel of its face, shape [height, width]."""
    bright: Grey = (255 - weave(width, height) - hem(width, height)).astype(np.uint8)
    return bright


def times(first: Grey, second: Grey) -> Grey:
    """Product of two shades, out of 255, rounded."""
    product = first.astype(np.int64) * second
    return ((product + 127) // 255).astype(np.uint8)
