"""The one form in which the kernels read shapes: a signed distance field, packed once."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array

SPHERE, CAPSULE, BOX, PLANE, BLOCKS, SURFACE, USER_DEFINED = range(7)

NO_FILLED = np.zeros((0, 0, 0), np.uint8)
NO_CORNERS = np.zeros((0, 3, 3))
NO_LINKS = np.zeros((0, 3), np.int32)


class Field(NamedTuple):
    """A shape as the kernels read it. It is flat: a parallel loop accepts no nested tuples.

    kind: one of the constants above; numbers: what its kernel documents; bounds: low and high
    corner [m], shape [2, 3]; inradius: of the largest ball inside a convex shape [m], 0 for a shape
    that is not convex.
    Blocks have filled: 1 where there is a cube, shape [I, J, K].
    Surfaces have, triangles in the tree's order, corners [m], shape [T, 3, 3]; normals:
    pseudonormals, shape [T, 7, 3]; boxes [M, 2, 3] and links [M, 3], see `bvh.Tree`; parts: first
    node and whether solid, shape [P, 2].
    User-defined shapes have the addresses of their compiled functions; 0 for none.
    """

    kind: int
    numbers: Array
    bounds: Array
    inradius: float
    filled: NDArray[np.uint8] = NO_FILLED
    corners: Array = NO_CORNERS
    normals: Array = NO_CORNERS
    boxes: Array = NO_CORNERS
    links: NDArray[np.int32] = NO_LINKS
    parts: NDArray[np.int32] = NO_LINKS
    distance_address: int = 0
    gradient_address: int = 0
