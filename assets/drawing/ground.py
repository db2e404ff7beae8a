"""Grass, dirt, sand and wool: soft blocks made of mottled tones.

Grass is green in the texture, so it needs no tint.
"""

import numpy as np

from assets.drawing.canvas import Texels
from assets.drawing.noise import Field, blurred, ranked, speckle
from assets.drawing.tile import SIZE, Palette, paint

GRASS: Palette = ((75, 118, 43), (88, 134, 50), (101, 149, 57), (114, 163, 66), (130, 178, 78))
DIRT: Palette = ((86, 60, 40), (105, 75, 51), (124, 90, 62), (142, 105, 74), (124, 114, 104))
SAND: Palette = ((206, 190, 141), (216, 202, 154), (224, 211, 166), (233, 222, 181))
WOOL: Palette = ((208, 212, 213), (221, 224, 225), (233, 236, 236), (243, 245, 245))


def _grass_tones() -> Field:
    """Short upright blades: noise stretched downwards."""
    return ranked(blurred(speckle(SIZE, SIZE, 31), 1, 2), (2, 5, 6, 5, 2))


def grass_block_top() -> Texels:
    return paint(_grass_tones(), GRASS)


def _dirt_tones() -> Field:
    """Clods of brown with a pebble here and there."""
    tones = ranked(blurred(speckle(SIZE, SIZE, 41), 2, 2), (3, 6, 6, 3))
    pebbles = speckle(SIZE, SIZE, 42) < 65536 // 50
    return np.where(pebbles, len(DIRT) - 1, tones)


def dirt() -> Texels:
    return paint(_dirt_tones(), DIRT)


def _turf_depth() -> Field:
    """How many rows the grass hangs down at each column: 3 to 5."""
    depth: Field = 3 + ranked(blurred(speckle(SIZE, 1, 56), 2, 1), (2, 4, 3))[0]
    return depth


def grass_block_side() -> Texels:
    """Dirt under a fringe of grass, with the fringe's shadow on it."""
    row, depth = np.arange(SIZE)[:, None], _turf_depth()[None, :]
    soil = np.where(row == depth, 0, _dirt_tones())
    turf = _grass_tones() - np.where(row == depth - 1, 1, 0)
    return np.where((row < depth)[..., None], paint(turf, GRASS), paint(soil, DIRT))


def sand() -> Texels:
    return paint(ranked(blurred(speckle(SIZE, SIZE, 61), 2, 1), (2, 5, 6, 3)), SAND)


def white_wool() -> Texels:
    """Tufts four texels wide in offset rows, each lit from above."""
    x, y = np.arange(SIZE)[None, :], np.arange(SIZE)[:, None]
    across = (x + np.where(y // 4 % 2 == 0, 0, 2)) % 4
    tuft = 3 - (y % 4 == 3) - ((across == 3) | (y % 4 == 2) & (across == 0))
    return paint(tuft - (speckle(SIZE, SIZE, 71) < 65536 // 3), WOOL)
