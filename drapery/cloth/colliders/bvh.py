"""A bounding volume hierarchy of boxes over triangles: median splits, nodes in depth-first order.

So a node's first child is the next node, and its second child follows the first child's last node.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array

LEAF = 4
"""Triangles in a leaf: a test of a box takes about as long as a test of one or two triangles."""


class Tree(NamedTuple):
    """order: triangle indices, shape [T]; boxes: low and high corners, shape [M, 2, 3];
    links: of each node, the end of its subtree, and the first and the end of its triangles, shape
    [M, 3] (both 0 for inner nodes); roots: the first node of each part, shape [P].
    """

    order: NDArray[np.int32]
    boxes: Array
    links: NDArray[np.int32]
    roots: NDArray[np.int32]


def build_tree(corners: Array, part: NDArray[np.int32]) -> Tree:
    """One tree for every part. corners: triangle corners [m], shape [T, 3, 3]; part: shape [T]."""
    lows, highs, centres = corners.min(axis=1), corners.max(axis=1), corners.mean(axis=1)
    order: list[NDArray[np.int64]] = []
    boxes: list[Array] = []
    links: list[list[int]] = []
    done = 0

    def grow(members: NDArray[np.int64]) -> None:
        nonlocal done
        node = len(boxes)
        boxes.append(np.stack([lows[members].min(axis=0), highs[members].max(axis=0)]))
        links.append([0, 0, 0])
        if len(members) <= LEAF:
            order.append(members)
            links[node][1:] = [done, done + len(members)]
            done += len(members)
        else:
            for half in _halves(centres, members):
                grow(half)
        links[node][0] = len(boxes)

    roots = []
    for number in range(int(part.max()) + 1):
        roots.append(len(boxes))
        grow(np.flatnonzero(part == number))
    return Tree(
        np.concatenate(order).astype(np.int32),
        np.array(boxes),
        np.array(links, np.int32),
        np.array(roots, np.int32),
    )


def _halves(
    centres: Array, members: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Split at the median along the longest side; equal centres keep their order."""
    places = centres[members]
    axis = int(np.argmax(np.ptp(places, axis=0)))
    ranked = members[np.argsort(places[:, axis], kind="stable")]
    return ranked[: len(ranked) // 2], ranked[len(ranked) // 2 :]
