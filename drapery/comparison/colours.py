"""The difference of colours by CIEDE2000.

Sharma, Wu and Dalal (2005), "The CIEDE2000 color-difference formula: implementation notes,
supplementary test data, and mathematical observations". The numbers in parentheses are those of its
equations.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

_BLOCK = 1 << 14
"""How many colours are compared at a time."""
_LEVELS = np.arange(256) / 255
_LINEAR = np.where(_LEVELS > 0.04045, ((_LEVELS + 0.055) / 1.055) ** 2.4, _LEVELS / 12.92)
"""The light of each value of sRGB, IEC 61966-2-1."""
_TO_XYZ = (
    (0.412453, 0.357580, 0.180423),
    (0.212671, 0.715160, 0.072169),
    (0.019334, 0.119193, 0.950227),
)
_WHITE = (0.95047, 1.0, 1.08883)
"""Daylight D65, seen at 2 degrees."""
_FAR = 25.0**7

Floats = NDArray[np.float64]


def ciede2000(a: NDArray[np.uint8], b: NDArray[np.uint8]) -> Iterator[Floats]:
    """The difference of each two colours, sRGB, shape [n, 3], in blocks."""
    for start in range(0, len(a), _BLOCK):
        block = slice(start, start + _BLOCK)
        yield lab_difference(lab_of(a[block]), lab_of(b[block]))


def lab_of(colours: NDArray[np.uint8]) -> tuple[Floats, Floats, Floats]:
    """CIE 1976 L*, a* and b* of colours, sRGB, shape [n, 3]."""
    red, green, blue = (_LINEAR[colours[:, channel]] for channel in range(3))
    x, y, z = (
        _cube_root((row[0] * red + row[1] * green + row[2] * blue) / white)
        for row, white in zip(_TO_XYZ, _WHITE, strict=True)
    )
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def _cube_root(light: Floats) -> Floats:
    """The cube root of light, and near black a straight line."""
    return np.where(light > 0.008856, np.cbrt(light), 7.787 * light + 16 / 116)


def lab_difference(
    first: tuple[Floats, Floats, Floats], other: tuple[Floats, Floats, Floats]
) -> Floats:
    """CIEDE2000 of two lists of colours, each as L*, a* and b*, shape [n]."""
    (l1, a1, b1), (l2, a2, b2) = first, other
    grey = 1.5 - 0.5 * _saturated(0.5 * (np.hypot(a1, b1) + np.hypot(a2, b2)))  # (2) to (5)
    c1, c2 = np.hypot(grey * a1, b1), np.hypot(grey * a2, b2)  # (6)
    h1, h2 = (np.arctan2(b, grey * a) % (2 * np.pi) for a, b in ((a1, b1), (a2, b2)))  # (7)
    turn = h2 - h1
    far = np.abs(turn) > np.pi
    coloured = c1 * c2 != 0
    turn = np.where(coloured, turn - np.where(far, np.copysign(2 * np.pi, turn), 0), 0)  # (10)
    hue = 2 * np.sqrt(c1 * c2) * np.sin(turn / 2)  # (11)
    both = h1 + h2
    other_way = np.where(both < 2 * np.pi, 2 * np.pi, -2 * np.pi)
    mean = np.where(coloured, 0.5 * (both + np.where(far, other_way, 0)), both)  # (14)
    weight = 1 - 0.17 * np.cos(mean - np.pi / 6) + 0.24 * np.cos(2 * mean)
    weight += 0.32 * np.cos(3 * mean + np.pi / 30) - 0.20 * np.cos(4 * mean - 0.35 * np.pi)  # (15)
    chroma = 0.5 * (c1 + c2)  # (13)
    light = (0.5 * (l1 + l2) - 50) ** 2
    lightness = (l2 - l1) / (1 + 0.015 * light / np.sqrt(20 + light))  # (18)
    chroma_part = (c2 - c1) / (1 + 0.045 * chroma)  # (19)
    hue_part = hue / (1 + 0.015 * chroma * weight)  # (20)
    blue = np.pi / 6 * np.exp(-(((np.degrees(mean) - 275) / 25) ** 2))  # (16)
    rotation = -np.sin(2 * blue) * 2 * _saturated(chroma)  # (17), (21)
    squared = lightness**2 + chroma_part**2 + hue_part**2 + rotation * chroma_part * hue_part
    return np.sqrt(np.maximum(squared, 0))  # (22)


def _saturated(chroma: Floats) -> Floats:
    """0 for grey, near 1 for strong colours."""
    square = chroma * chroma
    seventh = square * square * square * chroma
    return np.sqrt(seventh / (seventh + _FAR))
