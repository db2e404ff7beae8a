"""How far colours are apart: as people see them, or as a camera does.

People: OKLab (Ottosson, "A perceptual color space", 2020). Cameras: 8-bit levels.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float32]
Whole = NDArray[np.int32]

UNIT = 10_000
"""Distances are whole numbers in this fraction of OKLab's range from black to white, so that sums
of them are the same in any order."""

_STEP = 4
"""Colours are looked up in a table with every fourth value of each channel."""

_FARTHEST = 180
"""The greatest distance of colours in levels."""

_TO_CONES = (
    (0.4122214708, 0.5363325363, 0.0514459929),
    (0.2119034982, 0.6806995451, 0.1073969566),
    (0.0883024619, 0.2817188376, 0.6299787005),
)
_TO_LAB = (
    (0.2104542553, 0.7936177850, -0.0040720468),
    (1.9779984951, -2.4285922050, 0.4505937099),
    (0.0259040371, 0.7827717662, -0.8086757660),
)


def oklab(rgb: ArrayLike) -> Floats:
    """The OKLab of 8-bit sRGB colours [..., 3], also of values between whole ones."""
    # In double precision, so that the last bits of a machine's powers are rounded off.
    share = np.asarray(rgb, np.float64) / 255
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    lab = _mixed(np.cbrt(_mixed(linear, _TO_CONES)), _TO_LAB)
    return lab.astype(np.float32)


def quick_oklab(rgb: Floats) -> Floats:
    """The OKLab of the nearest colours of a table, [..., 3], for values from 0 to 255."""
    scaled = rgb * np.float32(1 / _STEP)
    scaled += np.float32(0.5)
    near = scaled.astype(np.int32)
    side = 256 // _STEP + 1
    place = near[..., 0] * side
    place += near[..., 1]
    place *= side
    place += near[..., 2]
    return _table().take(place, axis=0)


def distances(lab: Floats, other: Floats) -> Whole:
    """Between colours in OKLab [..., 3], in UNIT."""
    away = lab - other
    away *= away
    length = away[..., 0] + away[..., 1]
    length += away[..., 2]
    np.sqrt(length, out=length)
    length *= np.float32(UNIT)
    return np.asarray(np.rint(length, out=length), np.int32)


def level_distances(rgb: Floats, other: Floats) -> Whole:
    """Between 8-bit colours [..., 3]: the sums over channels, at most _FARTHEST, in 1 / 16."""
    away = rgb - other
    np.abs(away, out=away)
    length = away[..., 0] + away[..., 1]
    length += away[..., 2]
    np.minimum(length, np.float32(_FARTHEST), out=length)
    length *= np.float32(16)
    return np.asarray(np.rint(length, out=length), np.int32)


def _levels(rgb: NDArray[np.generic]) -> Floats:
    return np.asarray(rgb, np.float32)


@dataclass(frozen=True)
class Metric:
    """How far colours are apart.

    coordinates: from 8-bit colours [..., 3], exactly. quick_coordinates: nearly, from values
    between whole ones. distances: between coordinates [..., 3], whole numbers.
    """

    coordinates: Callable[[NDArray[np.generic]], Floats]
    quick_coordinates: Callable[[Floats], Floats]
    distances: Callable[[Floats, Floats], Whole]


PERCEIVED = Metric(oklab, quick_oklab, distances)
"""For pictures that people look at."""

MEASURED = Metric(_levels, _levels, level_distances)
"""For photos. Texels that are far off count as much as any wrong one."""


@cache
def _table() -> Floats:
    levels = np.minimum(np.arange(0, 257, _STEP), 255)
    grid = np.stack(np.meshgrid(levels, levels, levels, indexing="ij"), axis=-1)
    return oklab(grid.reshape(-1, 3))


def _mixed(
    values: NDArray[np.float64], rows: tuple[tuple[float, float, float], ...]
) -> NDArray[np.float64]:
    """Three weighted sums of the last axis, added in a fixed order."""
    x, y, z = values[..., 0], values[..., 1], values[..., 2]
    return np.stack([x * row[0] + y * row[1] + z * row[2] for row in rows], axis=-1)
