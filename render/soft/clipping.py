"""Clips triangles that extend behind the camera or too far aside (Sutherland and Hodgman 1974).

Few triangles need it, so it is plain numpy: at each plane a triangle becomes none, one or two. An
edge is always cut from its inner end, so two triangles that share it get exactly the same new
corner.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Matrices
from drapery.render.soft.projection import GUARD

Corners = NDArray[np.float64]
"""Triangles' corners, shape [K, 3, 4 + A]: clip coordinates x, y, z, w, then A attributes."""
Index = NDArray[np.integer[Any]]


@dataclass(frozen=True, eq=False)
class ClippedTriangles:
    """Clipped triangles. corners: shape [P, 3, 4 + A]. source: their original's index, [P]."""

    corners: Corners
    source: Index


def clip(corners: Corners, source: Index, width: int, height: int) -> ClippedTriangles:
    """Cut triangles [K] to the space between near and far plane and within the guard band."""
    clipped = ClippedTriangles(corners, source)
    for plane in _planes(width, height):
        clipped = _cut(clipped, plane)
    return clipped


def _planes(width: int, height: int) -> Matrices:
    """Planes; a point is inside if plane . (x, y, z, w) >= 0. The near plane is first: after it
    w > 0."""
    aside, up = GUARD / width, GUARD / height
    return np.array(
        [
            [0, 0, 1, 1],
            [0, 0, -1, 1],
            [1, 0, 0, aside],
            [-1, 0, 0, aside],
            [0, 1, 0, up],
            [0, -1, 0, up],
        ],
        np.float64,
    )


def _cut(clipped: ClippedTriangles, plane: NDArray[np.float64]) -> ClippedTriangles:
    distance = sum(clipped.corners[..., axis] * plane[axis] for axis in range(4))
    inside = np.asarray(distance) >= 0
    count = inside.sum(axis=1)
    whole, one, two = (np.nonzero(count == corners)[0] for corners in (3, 1, 2))
    (a, b, c), (da, db, dc) = _turned(clipped, distance, one, inside.argmax(axis=1))
    tip = np.stack([a, _between(a, b, da, db), _between(a, c, da, dc)], axis=1)
    (a, b, c), (da, db, dc) = _turned(clipped, distance, two, inside.argmin(axis=1))
    on_ab, on_ca = _between(b, a, db, da), _between(c, a, dc, da)
    kept = [clipped.corners[whole], tip, np.stack([on_ab, b, c], 1), np.stack([on_ab, c, on_ca], 1)]
    source = [clipped.source[which] for which in (whole, one, two, two)]
    return ClippedTriangles(np.concatenate(kept), np.concatenate(source))


def _turned(
    clipped: ClippedTriangles, distance: Any, which: Index, first: Index
) -> tuple[list[Corners], list[NDArray[np.float64]]]:
    """Corners and their distances, rotated so that each triangle begins with corner `first`."""
    turns = [(first[which] + step) % 3 for step in range(3)]
    return (
        [clipped.corners[which, corner] for corner in turns],
        [distance[which, corner] for corner in turns],
    )


def _between(inner: Corners, outer: Corners, d_in: Any, d_out: Any) -> Corners:
    cut: Corners = inner + (outer - inner) * (d_in / (d_in - d_out))[:, None]
    return cut
