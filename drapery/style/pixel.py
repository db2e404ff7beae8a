"""Cloth as pixel art: the outline of a small cloth becomes a polygon of whole pixels.

The method of Slow Rush Studios' capes: the particles at the cloth's edge form a polygon, and each
pixel of its bounding box whose centre lies inside is filled.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array

Mask = NDArray[np.bool_]


def outline(rows: int, columns: int) -> NDArray[np.int32]:
    """Indices of the particles at the edge of a grid, in order around it from the top left."""
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    sides = [index[0, :-1], index[:-1, -1], index[-1, :0:-1], index[:0:-1, 0]]
    around: NDArray[np.int32] = np.concatenate(sides)
    return around


def bounding_box(polygon: Array, width: int, height: int) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of the pixels that a polygon [P, 2] may cover, clipped."""
    low = np.floor(polygon.min(axis=0)).astype(int)
    high = np.ceil(polygon.max(axis=0)).astype(int)
    left, top = np.clip(low, 0, (width, height))
    right, bottom = np.clip(high, 0, (width, height))
    return int(left), int(top), int(right), int(bottom)


def fill_polygon(polygon: Array, width: int, height: int) -> Mask:
    """Pixels whose centres lie inside a polygon by the even-odd rule, shape [height, width].

    polygon: corners in pixels, shape [P, 2]; x to the right, y down, pixel (0, 0) covers 0..1.
    A centre on an edge belongs to the side to the right of the edge, or below it, so polygons with
    a common edge fill each pixel along it exactly once.
    """
    mask = np.zeros((height, width), np.bool_)
    left, top, right, bottom = bounding_box(polygon, width, height)
    if right <= left or bottom <= top:
        return mask
    x = np.arange(left, right) + 0.5
    y = np.arange(top, bottom)[:, None] + 0.5
    inside = np.zeros((bottom - top, right - left), np.bool_)
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        # From the upper end down, so that an edge is rounded alike for both of its polygons.
        (x0, y0), (x1, y1) = (start, end) if start[1] <= end[1] else (end, start)
        # Half-open in y: an edge counts for the rows at its upper end but not at its lower.
        crosses = (y0 <= y) != (y1 <= y)
        inside ^= crosses & ((x - x0) * (y1 - y0) >= (y - y0) * (x1 - x0))
    mask[top:bottom, left:right] = inside
    return mask
