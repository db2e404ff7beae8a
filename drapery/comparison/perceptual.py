"""Measures of how much two pictures are perceived to differ, in tiles of bounded memory.

Each measure of a pixel depends on a few pixels around it, and where those are equal it is
exactly as for equal pictures. So only what lies around differences is measured. Sums are of numbers
with a fixed point, so that tiles of other sizes give the same figures.
"""

from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from functools import partial
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Pixels
from drapery.comparison.colours import ciede2000
from drapery.comparison.flip import REACH, flip_errors

Area = tuple[slice, slice]
"""Rows and columns of a picture."""

MATTE = 128
"""Grey under transparent pixels [sRGB] for measures without alpha."""

_TILE = 128, 512
"""The height and width of what is measured at a time [px]: it stays in the cache."""
_THREADS = 2
"""How many tiles are measured at the same time."""
_UNIT = 1 << 32
"""The fixed point of sums: their parts are multiples of 1 / _UNIT."""
_WINDOW = 7
"""The side of the windows of SSIM [px]."""
_C1, _C2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2
"""What keeps the fractions of SSIM finite: K1 and K2 of the paper, with 8 bits."""


@dataclass(frozen=True)
class _Sums:
    """What is added up of tiles: 1 - SSIM, FLIP errors and CIEDE2000 with the fixed point, and the
    number of pixels that differ."""

    unlike: int
    error: int
    difference: int
    changed: int


def perceptual_measures(
    expected: Pixels,
    actual: Pixels,
    *,
    tile: tuple[int, int] = _TILE,
    threads: int = _THREADS,
) -> dict[str, float]:
    """SSIM, FLIP and CIEDE2000 of two pictures of one size, [H, W, 4], by their names.

    tile: height and width of what is measured at a time. threads: how many tiles are.
    """
    height, width = expected.shape[:2]
    window = _window(height, width)
    places = product(range(0, height, tile[0]), range(0, width, tile[1]))
    areas = [
        (slice(y, min(y + tile[0], height)), slice(x, min(x + tile[1], width))) for y, x in places
    ]
    with ThreadPoolExecutor(threads) as pool:
        found = list(pool.map(partial(_measured, expected, actual, window), areas))
    unlike, error, difference, changed = (
        sum(getattr(each, part.name) for each in found) for part in fields(_Sums)
    )
    windows = 3 * (height - window + 1) * (width - window + 1)
    return {
        "ssim": 1 - unlike / (windows * _UNIT) if window >= 3 else float(changed == 0),
        "flip": error / (height * width * _UNIT),
        "ciede2000": difference / (height * width * _UNIT),
    }


def _measured(expected: Pixels, actual: Pixels, window: int, area: Area) -> _Sums:
    """The sums of an area of two pictures."""
    wide, inner = _around(area, REACH, expected.shape)
    a, b = expected[wide], actual[wide]
    if np.array_equal(a, b):
        return _Sums(0, 0, 0, 0)
    old, new = over_matte(a), over_matte(b)
    unlike = 0
    near, _ = _around(inner, window // 2, old.shape)
    if 3 <= window <= min(part.stop - part.start for part in near):
        unlike = _sum(1 - each for each in _similarities(old[near], new[near], window))
    error = _sum([flip_errors(old, new)[inner]])
    changed = (old[inner] != new[inner]).any(axis=-1)
    difference = _sum(ciede2000(old[inner][changed], new[inner][changed]))
    return _Sums(unlike, error, difference, int(np.count_nonzero(changed)))


def _around(area: Area, reach: int, shape: tuple[int, ...]) -> tuple[Area, Area]:
    """An area with the pixels around it that a picture has, and where in that the area is."""
    wide, inner = [], []
    for part, size in zip(area, shape, strict=False):
        start = max(0, part.start - reach)
        wide.append(slice(start, min(size, part.stop + reach)))
        inner.append(slice(part.start - start, part.stop - start))
    return (wide[0], wide[1]), (inner[0], inner[1])


def _sum(parts: Iterable[NDArray[Any]]) -> int:
    """The sum of all numbers of arrays, with the fixed point."""
    return sum(int(np.rint(part * float(_UNIT)).sum(dtype=np.int64)) for part in parts)


def over_matte(pixels: Pixels, matte: int = MATTE) -> NDArray[np.uint8]:
    """The picture over a grey background, shape [H, W, 3]."""
    alpha = pixels[..., 3:]
    if alpha.min() == 255:
        return np.ascontiguousarray(pixels[..., :3])
    wide = alpha.astype(np.uint16)
    mixed = (pixels[..., :3] * wide + matte * (255 - wide) + 127) // 255
    return mixed.astype(np.uint8)


def _window(height: int, width: int) -> int:
    """The side of the windows of SSIM, an odd number, in a picture that may be smaller."""
    side = min(_WINDOW, height, width)
    return side if side % 2 else side - 1


def _similarities(
    old: NDArray[np.uint8], new: NDArray[np.uint8], window: int
) -> Iterator[NDArray[np.float64]]:
    """The structural similarity of all windows in two pictures, channel by channel.

    Wang, Bovik, Sheikh and Simoncelli (2004), "Image quality assessment: from error visibility to
    structural similarity", equation 13, with windows of equal weights and sample covariances.
    """
    count = window * window
    for channel in range(3):
        a, b = (each[..., channel].astype(np.int32) for each in (old, new))
        sums = [_window_sums(each, window) for each in (a, b, a * a, b * b, a * b)]
        x, y, xx, yy, xy = (each / count for each in sums)
        norm = count / (count - 1)
        covariance, variances = norm * (xy - x * y), norm * (xx - x * x) + norm * (yy - y * y)
        above = (2 * (x * y) + _C1) * (2 * covariance + _C2)
        yield above / ((x * x + y * y + _C1) * (variances + _C2))


def _window_sums(values: NDArray[np.int32], window: int) -> NDArray[np.int32]:
    """The sum of each window that lies within an array."""
    height, width = (side - window + 1 for side in values.shape)
    down = values[:height].copy()
    for step in range(1, window):
        down += values[step : step + height]
    total = down[:, :width].copy()
    for step in range(1, window):
        total += down[:, step : step + width]
    return total
