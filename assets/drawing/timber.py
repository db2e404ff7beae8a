"""Planks and logs."""

import numpy as np

from assets.drawing.canvas import Texels
from assets.drawing.noise import Field, blurred, ranked, speckle
from assets.drawing.tile import SIZE, Palette, paint
from assets.drawing.wood import grain

OAK: Palette = ((104, 80, 46), (139, 110, 66), (158, 127, 78), (172, 140, 88), (186, 154, 100))
SPRUCE: Palette = ((62, 44, 24), (90, 66, 38), (105, 78, 46), (118, 89, 54), (130, 100, 62))
BARK: Palette = ((58, 45, 27), (76, 60, 36), (95, 76, 47), (112, 91, 58))

BOARD = 4
"""Rows of a board; the last one is its lower edge."""

BUTTS = (7, 15, 3, 11)
"""The column where each board ends against the next."""


def _planks(seed: int) -> Field:
    """Horizontal boards with their grain, dark at their ends."""
    x, y = np.arange(SIZE)[None, :], np.arange(SIZE)[:, None]
    tones = 1 + grain(SIZE, SIZE, seed).T
    tones = np.where(y % BOARD == 0, tones + 1, np.minimum(tones, 3))
    edge = (y % BOARD == BOARD - 1) | (x == np.array(BUTTS)[y // BOARD])
    return np.where(edge, 0, tones)


def oak_planks() -> Texels:
    return paint(_planks(101), OAK)


def spruce_planks() -> Texels:
    return paint(_planks(102), SPRUCE)


def oak_log() -> Texels:
    """Upright ridges of bark with deep furrows."""
    return paint(ranked(blurred(speckle(SIZE, SIZE, 111), 1, 6), (4, 5, 5, 3)), BARK)


def oak_log_top() -> Texels:
    """Year rings within a rim of bark."""
    x, y = np.arange(SIZE)[None, :], np.arange(SIZE)[:, None]
    inwards = np.minimum(np.minimum(x, SIZE - 1 - x), np.minimum(y, SIZE - 1 - y))
    rings = np.where(inwards % 2 == 1, 3, 2) + (speckle(SIZE, SIZE, 121) < 65536 // 4)
    bark = ranked(speckle(SIZE, SIZE, 122), (1, 2, 1))
    return np.where((inwards == 0)[..., None], paint(bark, BARK), paint(rings, OAK))
