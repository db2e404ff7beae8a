"""Parts of a grid that cannot meet themselves, as they lie over a plane without folds.

Let J be the derivative of the places of a cloth by row and column, and P a map from space to a
plane. Where the symmetric part of P J is positive definite on a convex domain, points that differ
in row or column differ in P as well: (P a - P b) · (a - b) is the integral of a positive number
along the way from b to a. This is tested for rectangles of cells, which are convex, with bounds of
J over a rectangle, and P the pseudoinverse of their middle. It needs no test whether the outline
crosses itself, as a cone of normals does (Volino, Thalmann, "Efficient self-collision detection on
smoothly discretized surface animations using geometrical shape regularity", 1994).

Rectangles are the windows of 2 x 2 blocks of cells. A block of level l has 2^l x 2^l cells, and
window (i, j) of a level holds its blocks i and i + 1, and j and j + 1.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.vectors import Vector, add_scaled, dot, row, scale, subtract
from drapery.cloth.contact.geometry import higher, lower, put, read
from drapery.cloth.contact.self_contact_data import SelfContact
from drapery.jit import borrowing_kernel, kernel
from drapery.mesh import Array

LEAST = 0.05
"""The least eigenvalue of the symmetric part of P J. So two points of a window are never nearer to
each other than this part of their distance at rest, up to a factor for the shear of the window."""


@kernel
def smooth_windows(x: Array, contact: SelfContact) -> NDArray[np.uint8]:
    """Whether each window is smooth, [W]; windows are numbered as blocks are in `SelfContact`."""
    levels, windows = contact.levels, 0
    for level in range(len(levels)):
        windows = levels[level, 0] + levels[level, 1] * levels[level, 2]
    tangents, smooth = np.empty((windows, 12)), np.zeros(windows, np.uint8)
    for level in range(len(levels)):
        first, rows, columns = levels[level, 0], levels[level, 1], levels[level, 2]
        for i in range(rows):
            for j in range(columns):
                block = first + i * columns + j
                if level == 0:
                    bound_tangents(x, contact.columns, i, j, tangents, block)
                else:
                    before, wide = levels[level - 1, 0], levels[level - 1, 2]
                    low, right = 2 * i + 1 < levels[level - 1, 1], 2 * j + 1 < wide
                    part = before + 2 * i * wide + 2 * j
                    join_tangents(tangents, part, wide, low, right, tangents, block)
    bounds = np.empty((1, 12))
    for level in range(len(levels)):
        first, rows, columns = levels[level, 0], levels[level, 1], levels[level, 2]
        for i in range(rows):
            for j in range(columns):
                block = first + i * columns + j
                low, right = i + 1 < rows, j + 1 < columns
                join_tangents(tangents, block, columns, low, right, bounds, 0)
                smooth[block] = is_smooth(bounds)
    return smooth


@borrowing_kernel
def bound_tangents(x: Array, columns: int, i: int, j: int, tangents: Array, block: int) -> None:
    """The bounds of both derivatives in a cell: its edges along rows, then those along columns."""
    n = i * columns + j
    a, b, c, d = row(x, n), row(x, n + 1), row(x, n + columns), row(x, n + columns + 1)
    along, below = subtract(b, a), subtract(d, c)
    put(tangents, block, 0, lower(along, below))
    put(tangents, block, 3, higher(along, below))
    down, beside = subtract(c, a), subtract(d, b)
    put(tangents, block, 6, lower(down, beside))
    put(tangents, block, 9, higher(down, beside))


@borrowing_kernel
def join_tangents(
    parts: Array, first: int, wide: int, low: bool, right: bool, joined: Array, number: int
) -> None:
    """The bounds of a block and of those below and right of it. wide: blocks of a row."""
    for value in range(12):
        joined[number, value] = parts[first, value]
    if low:
        join_one(parts, first + wide, joined, number)
    if right:
        join_one(parts, first + 1, joined, number)
    if low and right:
        join_one(parts, first + wide + 1, joined, number)


@borrowing_kernel
def join_one(parts: Array, part: int, joined: Array, number: int) -> None:
    for value in (0, 6):
        put(joined, number, value, lower(read(joined, number, value), read(parts, part, value)))
        top = value + 3
        put(joined, number, top, higher(read(joined, number, top), read(parts, part, top)))


@borrowing_kernel
def is_smooth(bounds: Array) -> bool:
    """Whether derivatives within bounds, [1, 12], are those of a smooth window."""
    u, v = middle_of(bounds, 0), middle_of(bounds, 6)
    uu, uv, vv = dot(u, u), dot(u, v), dot(v, v)
    area = uu * vv - uv * uv
    if area <= 1e-6 * uu * vv:
        return False
    # The rows of P times the area. P maps the middle of J to the identity.
    p, q = subtract(scale(vv, u), scale(uv, v)), subtract(scale(uu, v), scale(uv, u))
    first = (1.0 - LEAST) * area - spread(p, bounds, 0)
    second = (1.0 - LEAST) * area - spread(q, bounds, 6)
    mixed = 0.5 * (spread(p, bounds, 6) + spread(q, bounds, 0))
    return first > 0.0 and second > 0.0 and first * second > mixed * mixed


@borrowing_kernel
def middle_of(bounds: Array, value: int) -> Vector:
    return scale(0.5, add_scaled(read(bounds, 0, value), 1.0, read(bounds, 0, value + 3)))


@borrowing_kernel
def spread(direction: Vector, bounds: Array, value: int) -> float:
    """How far vectors within bounds are from their middle along a direction, times its length."""
    size = subtract(read(bounds, 0, value + 3), read(bounds, 0, value))
    a, b, c = abs(direction[0]), abs(direction[1]), abs(direction[2])
    return 0.5 * (a * size[0] + b * size[1] + c * size[2])


@borrowing_kernel
def share_smooth(
    nodes: NDArray[np.int32],
    levels: NDArray[np.int32],
    smooth: NDArray[np.uint8],
    m: int,
    n: int,
) -> bool:
    """Whether the cells of two nodes lie in a smooth window."""
    if len(levels) == 0:
        return False
    i, k = min(nodes[m, 0], nodes[n, 0]), max(nodes[m, 2], nodes[n, 2])
    j, last = min(nodes[m, 1], nodes[n, 1]), max(nodes[m, 3], nodes[n, 3])
    level = 0
    while k - i > 1 or last - j > 1:
        i, j, k, last, level = i >> 1, j >> 1, k >> 1, last >> 1, level + 1
    # The last window of a row or column holds the last two blocks.
    i, j = max(0, min(i, levels[level, 1] - 2)), max(0, min(j, levels[level, 2] - 2))
    return bool(smooth[levels[level, 0] + i * levels[level, 2] + j])
