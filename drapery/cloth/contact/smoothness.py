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

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.vectors import Vector, add_scaled, dot, scale, subtract
from drapery.cloth.contact.geometry import higher, lower, put, read
from drapery.cloth.contact.self_contact_data import SelfContact
from drapery.jit import borrowing_kernel, kernel
from drapery.mesh import Array

LEAST = 0.05
"""The least eigenvalue of the symmetric part of P J. So two points of a window are never nearer to
each other than this part of their distance at rest, up to a factor for the shear of the window."""
U_LOW, U_HIGH, V_LOW, V_HIGH = range(4)
"""The rows of `Windows.tangents`: bounds of the derivatives along rows and along columns."""
UNKNOWN, SMOOTH, NOT_SMOOTH = range(3)
"""What is known of a window."""


class Windows(NamedTuple):
    """The windows of a cloth at one moment, numbered as blocks are in `SelfContact`.

    tangents: bounds of J over each block, x, y and z of each, [4, 3 B]. known: of each window what
    was worked out when it was first asked for, [B].
    """

    tangents: Array
    known: NDArray[np.uint8]


@kernel
def windows_of(x: Array, contact: SelfContact) -> Windows:
    """The windows of a cloth whose particles are at x, [N, 3]."""
    levels, blocks = contact.levels, 0
    for level in range(len(levels)):
        blocks = levels[level, 0] + levels[level, 1] * levels[level, 2]
    tangents = np.empty((4, 3 * blocks))
    if blocks > 0:
        bound_cells(x.reshape(x.size), contact.columns, levels[0, 1], tangents)
        join_blocks(levels, tangents)
    return Windows(tangents, np.zeros(blocks, np.uint8))


@borrowing_kernel
def bound_cells(x: Array, columns: int, rows: int, tangents: Array) -> None:
    """The bounds of both derivatives in each cell: its edges along rows, then those along columns.

    x: x, y and z of each particle, [3 N]. rows: of cells. One loop over all three of a row, so that
    it is compiled to vectors.
    """
    wide = 3 * (columns - 1)
    for i in range(rows):
        top, below = x[3 * i * columns :], x[3 * (i + 1) * columns :]
        u_low, u_high = tangents[U_LOW, i * wide :], tangents[U_HIGH, i * wide :]
        v_low, v_high = tangents[V_LOW, i * wide :], tangents[V_HIGH, i * wide :]
        for n in range(wide):
            a, b, c, d = top[n], top[n + 3], below[n], below[n + 3]
            u_low[n], u_high[n] = min(b - a, d - c), max(b - a, d - c)
            v_low[n], v_high[n] = min(c - a, d - b), max(c - a, d - b)


@borrowing_kernel
def join_blocks(levels: NDArray[np.int32], tangents: Array) -> None:
    """The bounds of the blocks above cells, each from those of its four parts."""
    for level in range(1, len(levels)):
        first, before, wide = levels[level, 0], levels[level - 1, 0], levels[level - 1, 2]
        for i in range(levels[level, 1]):
            down = wide if 2 * i + 1 < levels[level - 1, 1] else 0
            for j in range(levels[level, 2]):
                across, part = 1 if 2 * j + 1 < wide else 0, before + 2 * i * wide + 2 * j
                block = 3 * (first + i * levels[level, 2] + j)
                for low in (U_LOW, V_LOW):
                    put(tangents, low, block, lowest(tangents, low, part, down, across))
                    put(tangents, low + 1, block, highest(tangents, low + 1, part, down, across))


@borrowing_kernel
def lowest(tangents: Array, bound: int, block: int, down: int, across: int) -> Vector:
    """A lower bound over a block and the blocks that are `down` and `across` numbers from it."""
    a, b = read(tangents, bound, 3 * block), read(tangents, bound, 3 * (block + across))
    below = block + down
    c, d = read(tangents, bound, 3 * below), read(tangents, bound, 3 * (below + across))
    return lower(lower(a, b), lower(c, d))


@borrowing_kernel
def highest(tangents: Array, bound: int, block: int, down: int, across: int) -> Vector:
    """The same for an upper bound."""
    a, b = read(tangents, bound, 3 * block), read(tangents, bound, 3 * (block + across))
    below = block + down
    c, d = read(tangents, bound, 3 * below), read(tangents, bound, 3 * (below + across))
    return higher(higher(a, b), higher(c, d))


@borrowing_kernel
def is_smooth(windows: Windows, levels: NDArray[np.int32], level: int, i: int, j: int) -> bool:
    """Whether a window is smooth."""
    block = levels[level, 0] + i * levels[level, 2] + j
    if windows.known[block] == UNKNOWN:
        down = levels[level, 2] if i + 1 < levels[level, 1] else 0
        across = 1 if j + 1 < levels[level, 2] else 0
        smooth = bounds_are_smooth(windows.tangents, block, down, across)
        windows.known[block] = SMOOTH if smooth else NOT_SMOOTH
    return bool(windows.known[block] == SMOOTH)


@borrowing_kernel
def is_all_smooth(windows: Windows, levels: NDArray[np.int32]) -> bool:
    """Whether the window that holds all cells is smooth."""
    return len(levels) > 0 and is_smooth(windows, levels, len(levels) - 1, 0, 0)


@borrowing_kernel
def stay_smooth(before: Windows, after: Windows, levels: NDArray[np.int32]) -> bool:
    """Whether all windows that were asked for and found smooth are so in a later moment."""
    for level in range(len(levels)):
        for i in range(levels[level, 1]):
            for j in range(levels[level, 2]):
                known = before.known[levels[level, 0] + i * levels[level, 2] + j]
                if known == SMOOTH and not is_smooth(after, levels, level, i, j):
                    return False
    return True


@borrowing_kernel
def bounds_are_smooth(tangents: Array, block: int, down: int, across: int) -> bool:
    """Whether derivatives within the bounds of up to four blocks are those of a smooth window."""
    u0 = lowest(tangents, U_LOW, block, down, across)
    u1 = highest(tangents, U_HIGH, block, down, across)
    v0 = lowest(tangents, V_LOW, block, down, across)
    v1 = highest(tangents, V_HIGH, block, down, across)
    u, v = scale(0.5, add_scaled(u0, 1.0, u1)), scale(0.5, add_scaled(v0, 1.0, v1))
    u_size, v_size = subtract(u1, u0), subtract(v1, v0)
    uu, uv, vv = dot(u, u), dot(u, v), dot(v, v)
    area = uu * vv - uv * uv
    if area <= 1e-6 * uu * vv:
        return False
    # The rows of P times the area. P maps the middle of J to the identity.
    p, q = subtract(scale(vv, u), scale(uv, v)), subtract(scale(uu, v), scale(uv, u))
    first = (1.0 - LEAST) * area - spread(p, u_size)
    second = (1.0 - LEAST) * area - spread(q, v_size)
    mixed = 0.5 * (spread(p, v_size) + spread(q, u_size))
    return first > 0.0 and second > 0.0 and first * second > mixed * mixed


@borrowing_kernel
def spread(direction: Vector, size: Vector) -> float:
    """How far vectors within bounds of a size are from their middle along a direction, times its
    length."""
    a, b, c = abs(direction[0]), abs(direction[1]), abs(direction[2])
    return 0.5 * (a * size[0] + b * size[1] + c * size[2])


@borrowing_kernel
def share_smooth(
    nodes: NDArray[np.int32], levels: NDArray[np.int32], windows: Windows, m: int, n: int
) -> bool:
    """Whether the cells of two nodes lie in a smooth window."""
    if len(windows.known) == 0:
        return False
    i, k = min(nodes[m, 0], nodes[n, 0]), max(nodes[m, 2], nodes[n, 2])
    j, last = min(nodes[m, 1], nodes[n, 1]), max(nodes[m, 3], nodes[n, 3])
    level = 0
    while k - i > 1 or last - j > 1:
        i, j, k, last, level = i >> 1, j >> 1, k >> 1, last >> 1, level + 1
    # The last window of a row or column holds the last two blocks.
    i, j = max(0, min(i, levels[level, 1] - 2)), max(0, min(j, levels[level, 2] - 2))
    return is_smooth(windows, levels, level, i, j)
