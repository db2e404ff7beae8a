"""Pixels of smoothed edges, and how much two colours are perceived to differ.

A pixel is taken for one of a smoothed edge if among its eight neighbours there are darker and
brighter ones, at most two of its own brightness, and if the darkest or the brightest neighbour lies
in an area of one colour in both pictures: V. Vysniauskas (2009), "Anti-aliased pixel and intensity
slope detector". The verdicts are those of the npm package pixelmatch, version 7.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Pixels

Places = NDArray[np.intp]
"""Places of pixels in a picture whose rows are joined, shape [n]."""

_LARGEST = 35215.0
"""The largest squared difference of two colours."""
_BRIGHTNESS = np.array([0.29889531, 0.58662247, 0.11448223])
_I = np.array([0.59597799, -0.27417610, -0.32180189])
_Q = np.array([0.21147017, -0.52261711, 0.31114694])
_WEIGHTS = (0.5053, 0.299, 0.1957)

_ACROSS = np.array([-1, -1, -1, 0, 0, 1, 1, 1])
_DOWN = np.array([-1, 0, 1, -1, 1, -1, 0, 1])
"""The eight neighbours, column by column: of equal ones the first counts."""


def perceived_difference(a: Pixels, b: Pixels, places: Places) -> NDArray[np.float64]:
    """How much pixels are perceived to differ, 0..1, shape [n].

    a, b: the colours of n pixels, shape [n, 4]. places: where they are, which decides the pattern
    that is seen through them.
    """
    change = _seen_change(a, b, places)
    parts = (_dot(change, row) for row in (_BRIGHTNESS, _I, _Q))
    squared = sum(weight * part * part for weight, part in zip(_WEIGHTS, parts, strict=True))
    return np.sqrt(squared / _LARGEST)


def is_smoothed(a: Pixels, b: Pixels, places: Places) -> NDArray[np.bool_]:
    """Whether each of some pixels lies on a smoothed edge of one of two pictures, shape [n].

    a, b: pictures of one size, shape [H, W, 4].
    """
    found = _smoothed_in(a, b, places)
    rest = np.flatnonzero(~found)
    found[rest] = _smoothed_in(b, a, places[rest])
    return found


def _smoothed_in(a: Pixels, b: Pixels, places: Places) -> NDArray[np.bool_]:
    height, width = a.shape[:2]
    near, inside = _neighbours(places, height, width)
    colours = a.reshape(-1, 4)
    rows = np.arange(len(places))
    at = np.broadcast_to(places[:, None], near.shape)
    steps = _seen_change(colours[at], colours[near], at)
    change = np.where(inside, _dot(steps, _BRIGHTNESS), 0.0)
    equal = np.count_nonzero(inside & (change == 0), axis=1) + ~inside.all(axis=1)
    darkest, brightest = change.argmin(axis=1), change.argmax(axis=1)
    found = (equal <= 2) & (change[rows, darkest] < 0) & (change[rows, brightest] > 0)
    kept = np.flatnonzero(found)
    for end in (darkest, brightest):
        place = near[kept, end[kept]]
        flat = _in_one_colour(a, place) & _in_one_colour(b, place)
        if end is darkest:
            one = flat
    found[kept] = one | flat
    smoothed: NDArray[np.bool_] = found
    return smoothed


def _in_one_colour(picture: Pixels, places: Places) -> NDArray[np.bool_]:
    """Whether three neighbours of a pixel have its colour; the edge counts as one."""
    height, width = picture.shape[:2]
    near, inside = _neighbours(places, height, width)
    whole = picture.reshape(-1, 4)
    same = inside & (whole[near] == whole[places][:, None]).all(axis=-1)
    equal: NDArray[np.bool_] = np.count_nonzero(same, axis=1) + ~inside.all(axis=1) > 2
    return equal


def _neighbours(places: Places, height: int, width: int) -> tuple[Places, NDArray[np.bool_]]:
    """The places of the eight neighbours of each pixel, [n, 8], and which are in the picture."""
    y, x = np.divmod(places, width)
    down, across = y[:, None] + _DOWN, x[:, None] + _ACROSS
    inside = (down >= 0) & (down < height) & (across >= 0) & (across < width)
    return np.where(inside, down * width + across, places[:, None]), inside


def _seen_change(a: Pixels, b: Pixels, places: Places) -> NDArray[np.float64]:
    """By how much red, green and blue change, over a pattern where a pixel is translucent."""
    first, second = a.astype(np.float64), b.astype(np.float64)
    change: NDArray[np.float64] = first[..., :3] - second[..., :3]
    clear = (first[..., 3] < 255) | (second[..., 3] < 255)
    if clear.any():
        alphas = first[..., 3:][clear], second[..., 3:][clear]
        # A pattern that no picture is likely to have, so that no colour equals its background.
        k = places[clear][..., None] * 4 // np.array([1, 1.618033988749895, 2.618033988749895])
        behind = 48 + 159 * (k % 2)
        over = first[..., :3][clear] * alphas[0] - second[..., :3][clear] * alphas[1]
        change[clear] = (over - behind * (alphas[0] - alphas[1])) / 255
    return change


def _dot(change: NDArray[np.float64], row: NDArray[np.float64]) -> NDArray[np.float64]:
    """The sum of products, in a fixed order."""
    total: NDArray[np.float64] = (
        change[..., 0] * row[0] + change[..., 1] * row[1] + change[..., 2] * row[2]
    )
    return total
