"""Stone, cobblestone and stone bricks."""

import numpy as np

from assets.drawing.canvas import Texels
from assets.drawing.noise import Field, blurred, ranked, speckle
from assets.drawing.tile import SIZE, Palette, paint

STONE: Palette = ((104, 104, 106), (116, 116, 117), (126, 126, 127), (136, 136, 137))
COBBLE: Palette = (
    (74, 74, 77),
    (96, 96, 98),
    (114, 114, 115),
    (131, 131, 132),
    (149, 149, 149),
    (168, 168, 167),
)

STONES = ((2, 2), (8, 1), (13, 4), (5, 6), (10, 8), (0, 9), (15, 12), (4, 12), (9, 14))
"""Middles of the cobbles (x, y)."""


def _stone_tones() -> Field:
    """Horizontal smudges."""
    return ranked(blurred(speckle(SIZE, SIZE, 81), 4, 1), (3, 5, 6, 3))


def stone() -> Texels:
    return paint(_stone_tones(), STONE)


def _around(offset: Field) -> Field:
    """The shortest way around the tile, -8 to 7."""
    return (offset + SIZE // 2) % SIZE - SIZE // 2


def _from_stones() -> tuple[Field, Field]:
    """Offsets x and y of each texel from each middle, shape [stones, 16, 16]."""
    x, y = np.arange(SIZE)[None, None, :], np.arange(SIZE)[None, :, None]
    middles = np.array(STONES)[:, :, None, None]
    across, down = _around(x - middles[:, 0]), _around(y - middles[:, 1])
    shape = (len(STONES), SIZE, SIZE)
    return np.broadcast_to(across, shape), np.broadcast_to(down, shape)


def cobblestone() -> Texels:
    """Each texel belongs to the nearest stone; joints lie where two are nearly as near."""
    across, down = _from_stones()
    square = across**2 + down**2
    nearest, second = np.argsort(square, axis=0, kind="stable")[:2]
    x, y, first = (
        np.take_along_axis(field, nearest[None], 0)[0] for field in (across, down, square)
    )
    runner_up = np.take_along_axis(square, second[None], 0)[0]
    light = 3 + (x + y < -1) + (y <= -2) - (x + y > 1) - (speckle(SIZE, SIZE, 91) < 65536 // 5)
    # An exact joint of even width would need a square root of the distances; this is close enough.
    return paint(np.where(runner_up - first <= 4, 0, light), COBBLE)


def stone_bricks() -> Texels:
    """Two courses of one brick each, the lower moved by half; lit above, dark at the joints."""
    x, y = np.arange(SIZE)[None, :], np.arange(SIZE)[:, None]
    along = (x + np.where(y < SIZE // 2, 0, SIZE // 2)) % SIZE
    up = y % (SIZE // 2)
    joint = (along == SIZE - 1) | (up == SIZE // 2 - 1)
    lit = ((up == 0) | (along == 0)).astype(np.int64)
    shaded = ((up == SIZE // 2 - 2) | (along == SIZE - 2)).astype(np.int64)
    face = 2 + _stone_tones() // 2 + lit - shaded
    return paint(np.where(joint, 0, face), COBBLE)
