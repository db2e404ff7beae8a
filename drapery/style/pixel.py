"""Cloth as pixel art: the outline of a small cloth becomes a polygon of whole pixels.

The way of Slow Rush Studios' capes: the cloth's edge particles form a polygon, the smallest box
around it is scanned, and each pixel whose centre lies inside is filled.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array

Mask = NDArray[np.bool_]


def outline(rows: int, columns: int) -> NDArray[np.int32]:
    """Indices of a grid's edge particles, row by row from the top, in order around it."""
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    sides = [index[0, :-1], index[:-1, -1], index[-1, :0:-1], index[:0:-1, 0]]
    around: NDArray[np.int32] = np.concatenate(sides)
    return around


def bounding_box(polygon: Array, width: int, height: int) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of the pixels whose centres a polygon [P, 2] may hold, clipped."""
    low = np.floor(polygon.min(axis=0)).astype(int)
    high = np.ceil(polygon.max(axis=0)).astype(int)
    left, top = np.clip(low, 0, (width, height))
    right, bottom = np.clip(high, 0, (width, height))
    return int(left), int(top), int(right), int(bottom)


def fill_polygon(polygon: Array, width: int, height: int) -> Mask:
    """Pixels whose centres lie inside a polygon by the even-odd rule, shape [height, width].

    polygon: corners in pixels, shape [P, 2]; x to the right, y down, pixel (0, 0) covers 0..1.
    A centre on an edge belongs to the side to the right of the edge, or below it, so polygons that
    share an edge share no pixel and leave none out.
    """
    mask = np.zeros((height, width), np.bool_)
    left, top, right, bottom = bounding_box(polygon, width, height)
    if right <= left or bottom <= top:
        return mask
    x = np.arange(left, right) + 0.5
    y = np.arange(top, bottom)[:, None] + 0.5
    inside = np.zeros((bottom - top, right - left), np.bool_)
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        # From the upper end down, so an edge rounds alike whichever polygon it belongs to.
        (x0, y0), (x1, y1) = (start, end) if start[1] <= end[1] else (end, start)
        # Half-open in y: an edge counts for the rows at its upper end but not at its lower.
        crosses = (y0 <= y) != (y1 <= y)
        inside ^= crosses & ((x - x0) * (y1 - y0) >= (y - y0) * (x1 - x0))
    mask[top:bottom, left:right] = inside
    return mask
