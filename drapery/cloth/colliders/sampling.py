"""The points of a cloth that are tested against colliders: particles, and points on the faces."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Triangles
from drapery.cloth.cloth import Cloth
from drapery.errors import OptionError
from drapery.mesh import Array


class SamplePoints(NamedTuple):
    """Points as weighted sums of particles: particle indices [M, 3] and their weights [M, 3]."""

    particles: NDArray[np.int32]
    weights: Array


def sample_points(cloth: Cloth, order: int = 2) -> SamplePoints:
    """The points of a cloth to test, face points first and particles last.

    order: parts into which each side of a face is cut. 1 tests only the particles, 2 also the
        middles of all edges, 3 two points on every edge and the middle of every face, and so on.
        Choose it so that the distance between points is less than the thinnest collider.

    Raises OptionError.
    """
    if not 1 <= order <= 16:
        raise OptionError(f"collision order {order} is out of range; use a whole number 1 to 16")
    return face_sample_points(len(cloth.inv_mass), cloth.triangles, order)


def face_sample_points(count: int, triangles: Triangles, order: int) -> SamplePoints:
    """As `sample_points`, for `count` particles and triangles [T, 3]."""
    own = np.arange(count, dtype=np.int32)
    alone = SamplePoints(np.stack([own, own, own], axis=1), np.tile([1.0, 0.0, 0.0], (count, 1)))
    shares = [
        (i, j, order - i - j)
        for i in range(order + 1)
        for j in range(order + 1 - i)
        if order not in (i, j, order - i - j)
    ]
    if not shares or not len(triangles):
        return alone
    lattice = np.array(shares)
    corners = np.repeat(triangles, len(lattice), axis=0)
    parts = np.tile(lattice, (len(triangles), 1))
    # Two triangles share the points of their common edge: keep each point once.
    rank = np.argsort(np.where(parts > 0, corners, np.iinfo(np.int32).max), axis=1, kind="stable")
    corners = np.take_along_axis(corners, rank, axis=1)
    parts = np.take_along_axis(parts, rank, axis=1)
    corners = np.where(parts > 0, corners, corners[:, :1])
    unique = np.unique(np.concatenate([corners, parts], axis=1), axis=0)
    return SamplePoints(
        np.concatenate([unique[:, :3].astype(np.int32), alone.particles]),
        np.concatenate([unique[:, 3:] / order, alone.weights]),
    )
