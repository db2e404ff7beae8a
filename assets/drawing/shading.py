"""Light and shadow in the textures of cloth: folds, weave, hem and the seam of a sewn-on piece.

All of it is integer arithmetic on shades of 255, so every machine draws the same texels. A dye is
multiplied by these shades; they stay above 200, so that its colour is recognisable.
"""

import numpy as np
from numpy.typing import NDArray

from assets.drawing.canvas import Grey

Axis = NDArray[np.int64]

FOLDS = ((64, 40, -12, 40), (150, 168, 8, 50), (236, 228, -4, 46), (292, 312, 14, 36))
"""Valleys of the cloth: column at the top and at the bottom in sixteenths of a texel, the row where
the valley begins, and how dark it is at its deepest."""

LEFT_REACH = 32
RIGHT_REACH = 60
"""Width of a valley's shadow on each side, in sixteenths; its left side faces the light."""

FOLD_GROWTH = 24
"""Rows that a valley takes from its beginning to its full depth."""

DARKEST = 205


def _fold(top: int, bottom: int, start: int, dark: int, width: int, height: int) -> Axis:
    """Darkness of one valley, shape [height, width]."""
    x, y = 16 * np.arange(width)[None, :] + 8, np.arange(height)[:, None]
    offset = x - top - (bottom - top) * y // height
    reach = np.where(offset < 0, LEFT_REACH, RIGHT_REACH)
    near = np.maximum(reach - abs(offset), 0)
    growth = np.clip(y - start, 0, FOLD_GROWTH)
    shade: Axis = dark * near * growth // (reach * FOLD_GROWTH)
    return shade


def folds(width: int, height: int) -> Axis:
    """Darkness of all valleys together in even steps, to have few tones, as in pixel art."""
    dark = np.zeros((height, width), np.int64)
    for fold in FOLDS:
        dark = np.maximum(dark, _fold(*fold, width, height))
    return (dark + 4) // 8 * 8


def weave(width: int, height: int) -> Axis:
    """Darkness of the threads that pass under, in a twill of four, shape [height, width]."""
    x, y = np.arange(width)[None, :], np.arange(height)[:, None]
    return np.where((x + y) % 2 == 0, 0, 4) + np.where((x + 2 * y) % 8 == 3, 4, 0)


def hem(width: int, height: int) -> Axis:
    """Darkness of the doubled bottom and sides, and of the cloth just under the bar."""
    dark = np.zeros((height, width), np.int64)
    dark[:, 0] += 10
    dark[:, -1] += 14
    dark[-2:] += 8
    dark[-1] += 8
    dark[0] += 10
    return dark


def cloth(width: int, height: int) -> Grey:
    """Shade of hanging cloth at each texel of its face, shape [height, width]."""
    dark = folds(width, height) + weave(width, height) + hem(width, height)
    bright: Grey = np.clip(255 - dark, DARKEST, 255).astype(np.uint8)
    return bright


def seam(coverage: Grey) -> Grey:
    """Shade of a sewn-on piece: its lower and right rims are darker; 255 elsewhere."""
    solid = coverage == 255
    shade = np.full(coverage.shape, 255, np.uint8)
    shade[:, :-1][solid[:, :-1] & (coverage[:, 1:] == 0)] = 243
    shade[:-1][solid[:-1] & (coverage[1:] == 0)] = 230
    return shade


def times(first: Grey, second: Grey) -> Grey:
    """Product of two shades, out of 255, rounded."""
    product = first.astype(np.int64) * second
    return ((product + 127) // 255).astype(np.uint8)
