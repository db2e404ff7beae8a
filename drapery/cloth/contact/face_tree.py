"""A tree of upright boxes about the faces of a cloth.

Its leaves hold neighbouring faces, see `make_self_contact`. It is a complete binary tree in one
array: the children of node n are 2 n and 2 n + 1, the root is 1, and the leaves are the nodes of
the second half. So its shape never changes, only its boxes do.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.vectors import Vector, row
from drapery.cloth.contact.geometry import higher, lower, put
from drapery.jit import borrowing_kernel, kernel
from drapery.mesh import Array

NOWHERE = 1e300
"""The coordinates of a box about nothing; no box overlaps it."""


@kernel
def joined_bounds(bounds: Array, parts: NDArray[np.int32]) -> Array:
    """The bounds of edges or faces from those of their particles: parts [K, 2] or [K, 3]."""
    joined = np.empty((len(parts), 6))
    for n in range(len(parts)):
        i, j, k = parts[n, 0], parts[n, 1], parts[n, parts.shape[1] - 1]
        put(joined, n, 0, lower(row(bounds, i), lower(row(bounds, j), row(bounds, k))))
        put(joined, n, 3, higher(top(bounds, i), higher(top(bounds, j), top(bounds, k))))
    return joined


@kernel
def tree_of(faces: Array, begin: NDArray[np.int32]) -> Array:
    """The boxes of all nodes, [2 L, 6], from those of the faces [T, 6].

    begin: the first particle, face and edge of each leaf, see `SelfContact`.
    """
    leaves, count = 1, len(begin) - 1
    while leaves < count:
        leaves *= 2
    tree = np.empty((2 * leaves, 6))
    for leaf in range(leaves):
        low, high = (NOWHERE, NOWHERE, NOWHERE), (-NOWHERE, -NOWHERE, -NOWHERE)
        if leaf < count:
            for t in range(begin[leaf, 1], begin[leaf + 1, 1]):
                low, high = lower(low, row(faces, t)), higher(high, top(faces, t))
        put(tree, leaves + leaf, 0, low)
        put(tree, leaves + leaf, 3, high)
    for node in range(leaves - 1, 0, -1):
        put(tree, node, 0, lower(row(tree, 2 * node), row(tree, 2 * node + 1)))
        put(tree, node, 3, higher(top(tree, 2 * node), top(tree, 2 * node + 1)))
    return tree


@borrowing_kernel
def top(bounds: Array, i: int) -> Vector:
    """The high corner of bounds [K, 6]."""
    return bounds[i, 3], bounds[i, 4], bounds[i, 5]
