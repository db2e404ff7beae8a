"""Signed distance of a set of unit cubes, in units of one cube.

Outside, the distance to a union is the least of the distances to its cubes, and the nearest point
always lies on a face that has free space before it, so a cloth never touches the faces between two
cubes.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.primitives import cuboid_distance
from drapery.cloth.colliders.vectors import Vector, norm, subtract, unit
from drapery.jit import kernel

Grid = NDArray[np.uint8]
HALF = (0.5, 0.5, 0.5)


@kernel
def blocks_distance(filled: Grid, p: Vector) -> tuple[float, Vector]:
    """filled: 1 where there is a cube, shape [I, J, K]; p: relative to the grid's corner.

    Farther away than one cube's length the result is a lower bound, which is enough for a sweep.
    """
    i, j, k = int(np.floor(p[0])), int(np.floor(p[1])), int(np.floor(p[2]))
    if _is_filled(filled, i, j, k):
        return _exit_distance(filled, i, j, k, p)
    wide, tall, deep = filled.shape
    if i < -1 or j < -1 or k < -1 or i > wide or j > tall or k > deep:
        return _outside_grid(filled, p)
    return _nearest_cube(filled, i, j, k, p)


@kernel
def _is_filled(filled: Grid, i: int, j: int, k: int) -> bool:
    wide, tall, deep = filled.shape
    inside = 0 <= i < wide and 0 <= j < tall and 0 <= k < deep
    return inside and bool(filled[i, j, k])


@kernel
def _outside_grid(filled: Grid, p: Vector) -> tuple[float, Vector]:
    wide, tall, deep = filled.shape
    closest = (min(max(p[0], 0.0), wide), min(max(p[1], 0.0), tall), min(max(p[2], 0.0), deep))
    offset = subtract(p, closest)
    length = norm(offset)
    return length, unit(offset, length)


@kernel
def _nearest_cube(filled: Grid, i: int, j: int, k: int, p: Vector) -> tuple[float, Vector]:
    best, normal = 1.0, (0.0, 1.0, 0.0)
    for a in range(i - 1, i + 2):
        for b in range(j - 1, j + 2):
            for c in range(k - 1, k + 2):
                if _is_filled(filled, a, b, c):
                    d, n = cuboid_distance(HALF, subtract(p, (a + 0.5, b + 0.5, c + 0.5)))
                    if d < best:
                        best, normal = d, n
    return best, normal


@kernel
def _exit_distance(filled: Grid, i: int, j: int, k: int, p: Vector) -> tuple[float, Vector]:
    """Distance and direction from inside a cube to free space, along the axes."""
    best, normal = np.inf, (0.0, 1.0, 0.0)
    for axis in (1, 0, 2):
        for side in (1, -1):
            a, b, c, cubes = i, j, k, 0
            while _is_filled(filled, a, b, c):
                a += side * (axis == 0)
                b += side * (axis == 1)
                c += side * (axis == 2)
                cubes += 1
            inside = p[axis] - np.floor(p[axis])
            length = cubes - inside if side > 0 else cubes - 1 + inside
            if length < best:
                best = length
                normal = (
                    float(side * (axis == 0)),
                    float(side * (axis == 1)),
                    float(side * (axis == 2)),
                )
    return -best, normal
