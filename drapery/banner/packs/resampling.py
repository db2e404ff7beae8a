"""Sheets of different sizes brought to one size, by nearest texels and within a limit."""

from collections.abc import Iterable
from math import lcm

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Texels

MAX_COMPOSITE = 2048
"""Largest side of a sheet that combines several smaller ones [px]."""


def common_side(sides: Iterable[int]) -> int:
    """The side [px] at which square sheets of these sides are combined.

    It is their least common multiple, so that each texel of each sheet becomes a whole number of
    texels. Where that is over MAX_COMPOSITE, it is the greatest multiple of the largest side
    within MAX_COMPOSITE, at least the largest side itself.
    """
    all_sides = set(sides)
    side, largest = lcm(*all_sides), max(all_sides)
    return side if side <= MAX_COMPOSITE else max(1, MAX_COMPOSITE // largest) * largest


def nearest_texels(side: int, new_side: int) -> NDArray[np.int64]:
    """For each texel of a new side, the old texel at its centre, shape [new_side].

    This is how the game samples a texture: without filtering, at texture coordinates.
    """
    return (2 * np.arange(new_side) + 1) * side // (2 * new_side)


def resize(texels: Texels, side: int) -> Texels:
    """A square sheet [H, H, ...] at another size, [side, side, ...]; see `nearest_texels`."""
    if len(texels) == side:
        return texels.copy()
    index = nearest_texels(len(texels), side)
    return texels[index[:, None], index]


def squared(texels: Texels) -> Texels:
    """A picture [H, W, 4] stretched to a square of `common_side`; itself where it is one."""
    height, width = texels.shape[:2]
    if height == width:
        return texels
    side = common_side((height, width))
    rows, columns = nearest_texels(height, side), nearest_texels(width, side)
    sheet = texels[rows[:, None], columns]
    sheet.setflags(write=False)
    return sheet
