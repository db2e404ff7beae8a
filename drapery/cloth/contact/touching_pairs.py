"""Parts of a cloth that may come near each other in a step.

Pairs of a particle and a face, and of two edges, are found with a tree of boxes about the faces.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.vectors import (
    Vector,
    add_scaled,
    dot,
    norm,
    row,
    scale,
    subtract,
)
from drapery.cloth.contact.face_tree import joined_bounds, top, tree_of
from drapery.cloth.contact.geometry import UP, grown, higher, lower, overlap, put
from drapery.cloth.contact.pair_distance import gap_of, nearest
from drapery.cloth.contact.self_contact_data import LEAF, SelfContact
from drapery.cloth.contact.smoothness import Windows, share_smooth
from drapery.jit import borrowing_kernel, kernel
from drapery.mesh import Array

REACH = 1.5
"""Pairs are found that may come within this many times the thickness. So contacts may move each
particle by half of what this is above 1, and pairs that are not known still cannot cross."""
LISTED = 1024
"""Pairs whose bounds overlap are collected up to this number, then their distances are computed."""
DEEPEST = 128
"""More pairs of nodes than wait at once: three for each level of a tree of 2^32 leaves."""
MOST = 2 * 3 * LEAF * LEAF + 9 * LEAF * LEAF
"""Two leaves have no more pairs than this."""


class TouchingPairs(NamedTuple):
    """Pairs in a step: particles [P, 4]; a particle and a face, or two edges if `edges` [P] is 1.

    normals: from the nearest point of the second to the nearest of the first at the start [P, 3].
    starts: distance at the start [m], [P].
    """

    ends: NDArray[np.int32]
    edges: NDArray[np.uint8]
    normals: Array
    starts: Array


@kernel
def find_pairs(
    x0: Array,
    x: Array,
    contact: SelfContact,
    windows: Windows,
    limit: float,
    stop: bool,
) -> TouchingPairs:
    """All pairs that may come within a limit [m] in this step, in an order that depends on the
    cloth alone.

    windows: no pairs are wanted in those that are smooth; none if all pairs are.
    stop: whether each particle may also stop anywhere on its way, so that others run into it.
    """
    bounds = particle_bounds(x0, x, 0.5 * limit, stop)
    of_edges = joined_bounds(bounds, contact.edges)
    of_faces = joined_bounds(bounds, contact.triangles)
    tree = tree_of(of_faces, contact.begin)
    listed = np.empty((LISTED, 5), np.int32)
    pairs, count = empty_pairs(8 * len(of_faces) + LISTED), 0
    stack, depth = np.empty((DEEPEST, 2), np.int32), 1
    stack[0] = 1
    # References are counted in this loop, as `pairs` is set in it, so it is left to do little.
    while depth > 0:
        depth, waiting = list_pairs(
            bounds, of_edges, of_faces, tree, contact, windows, stack, depth, listed
        )
        if count + waiting > len(pairs.ends):
            pairs = longer(pairs)
        count = add_pairs(x0, x, limit, stop, listed, waiting, pairs, count)
    return TouchingPairs(
        pairs.ends[:count],
        pairs.edges[:count],
        pairs.normals[:count],
        pairs.starts[:count],
    )


@borrowing_kernel
def list_pairs(
    bounds: Array,
    of_edges: Array,
    of_faces: Array,
    tree: Array,
    contact: SelfContact,
    windows: Windows,
    stack: NDArray[np.int32],
    depth: int,
    listed: NDArray[np.int32],
) -> tuple[int, int]:
    """List pairs whose bounds overlap until all are listed or the list is nearly full; returns the
    new depth of the stack and the number of listed pairs.

    stack: pairs of equally deep nodes that are still to be searched, [DEEPEST, 2].
    """
    particles, triangles, edges = contact.particles, contact.triangles, contact.edges
    begin, leaves, waiting = contact.begin, len(tree) // 2, 0
    while depth > 0 and waiting + MOST <= LISTED:
        depth -= 1
        m, n = stack[depth, 0], stack[depth, 1]
        if not overlap(row(tree, m), top(tree, m), row(tree, n), top(tree, n)):
            continue
        if share_smooth(contact.nodes, contact.levels, windows, m, n):
            continue
        if m < leaves:
            depth = add_children(stack, depth, m, n)
            continue
        a, b = m - leaves, n - leaves
        waiting = list_corners(bounds, of_faces, particles, triangles, begin, a, b, listed, waiting)
        if b > a:
            waiting = list_corners(
                bounds, of_faces, particles, triangles, begin, b, a, listed, waiting
            )
        waiting = list_edges(of_edges, edges, begin, a, b, listed, waiting)
    return depth, waiting


@borrowing_kernel
def add_children(stack: NDArray[np.int32], depth: int, m: int, n: int) -> int:
    """Add the pairs of children of two nodes, or of one, to the stack; returns its new depth."""
    for a in range(2 * m, 2 * m + 2):
        for b in range(max(a, 2 * n), 2 * n + 2):
            stack[depth, 0], stack[depth, 1] = a, b
            depth += 1
    return depth


@kernel
def particle_bounds(x0: Array, x: Array, margin: float, stop: bool) -> Array:
    """Low and high corner of the motion of each particle with a margin [m], [N, 6].

    The mean motion of the cloth is left out, as it brings no parts together unless some stop.
    """
    mean = (0.0, 0.0, 0.0)
    for i in range(0 if stop else len(x)):
        mean = add_scaled(mean, 1.0 / len(x), moved(x0, x, i))
    bounds = np.empty((len(x), 6))
    for i in range(len(x)):
        a, b = row(x0, i), subtract(row(x, i), mean)
        put(bounds, i, 0, grown(lower(a, b), -margin))
        put(bounds, i, 3, grown(higher(a, b), margin))
    return bounds


@borrowing_kernel
def list_corners(
    bounds: Array,
    of_faces: Array,
    particles: NDArray[np.int32],
    triangles: NDArray[np.int32],
    begin: NDArray[np.int32],
    a: int,
    b: int,
    listed: NDArray[np.int32],
    waiting: int,
) -> int:
    """List the particles of leaf a with the faces of leaf b whose bounds overlap; returns the new
    number of pairs in the list."""
    for n in range(begin[a, 0], begin[a + 1, 0]):
        p = particles[n]
        low, high = row(bounds, p), top(bounds, p)
        for t in range(begin[b, 1], begin[b + 1, 1]):
            if overlap(low, high, row(of_faces, t), top(of_faces, t)):
                i, j, k = triangles[t, 0], triangles[t, 1], triangles[t, 2]
                if p not in (i, j, k):
                    listed[waiting, 0], listed[waiting, 1], listed[waiting, 2] = p, i, j
                    listed[waiting, 3], listed[waiting, 4] = k, 0
                    waiting += 1
    return waiting


@borrowing_kernel
def list_edges(
    of_edges: Array,
    edges: NDArray[np.int32],
    begin: NDArray[np.int32],
    a: int,
    b: int,
    listed: NDArray[np.int32],
    waiting: int,
) -> int:
    """The same for the edges of both leaves."""
    for e in range(begin[a, 2], begin[a + 1, 2]):
        low, high = row(of_edges, e), top(of_edges, e)
        for f in range(e + 1 if a == b else begin[b, 2], begin[b + 1, 2]):
            if overlap(low, high, row(of_edges, f), top(of_edges, f)):
                i, j, k, m = edges[e, 0], edges[e, 1], edges[f, 0], edges[f, 1]
                if i not in (k, m) and j not in (k, m):
                    listed[waiting, 0], listed[waiting, 1], listed[waiting, 2] = i, j, k
                    listed[waiting, 3], listed[waiting, 4] = m, 1
                    waiting += 1
    return waiting


@kernel
def empty_pairs(count: int) -> TouchingPairs:
    return TouchingPairs(
        np.empty((count, 4), np.int32),
        np.empty(count, np.uint8),
        np.empty((count, 3)),
        np.empty(count),
    )


@kernel
def longer(pairs: TouchingPairs) -> TouchingPairs:
    """The same pairs with twice the space."""
    count = len(pairs.ends)
    more = empty_pairs(2 * count)
    for i in range(count):  # slices would compile numba's messages about shapes, for seconds
        for end in range(4):
            more.ends[i, end] = pairs.ends[i, end]
        more.edges[i], more.starts[i] = pairs.edges[i], pairs.starts[i]
        put(more.normals, i, 0, row(pairs.normals, i))
    return more


@borrowing_kernel
def add_pairs(
    x0: Array,
    x: Array,
    limit: float,
    stop: bool,
    listed: NDArray[np.int32],
    waiting: int,
    pairs: TouchingPairs,
    count: int,
) -> int:
    """Add the listed pairs that may come within the limit; returns the new count."""
    for n in range(waiting):
        i, j, k, m = listed[n, 0], listed[n, 1], listed[n, 2], listed[n, 3]
        edges = listed[n, 4]
        direction = between_middles(x0, i, j, k, m, edges)
        gap = swept_gap(direction, x0, x, i, j, k, m, edges, stop)
        if gap > 0.0 and gap * gap > limit * limit * dot(direction, direction):
            continue
        _weights, offset = nearest(x0, i, j, k, m, edges)
        length = norm(offset)
        normal = scale(1.0 / length, offset) if length > 0.0 else UP
        if swept_gap(normal, x0, x, i, j, k, m, edges, stop) <= limit:
            pairs.ends[count, 0], pairs.ends[count, 1] = i, j
            pairs.ends[count, 2], pairs.ends[count, 3] = k, m
            pairs.edges[count] = edges
            put(pairs.normals, count, 0, normal)
            pairs.starts[count] = length
            count += 1
    return count


@borrowing_kernel
def between_middles(x: Array, i: int, j: int, k: int, m: int, edges: int) -> Vector:
    """The vector from the middle of the second part of a pair to the middle of the first."""
    a, b, c, d = row(x, i), row(x, j), row(x, k), row(x, m)
    if edges:
        return scale(0.5, subtract(add_scaled(a, 1.0, b), add_scaled(c, 1.0, d)))
    return add_scaled(a, -1.0 / 3.0, add_scaled(add_scaled(b, 1.0, c), 1.0, d))


@borrowing_kernel
def swept_gap(
    direction: Vector, x0: Array, x: Array, i: int, j: int, k: int, m: int, edges: int, stop: bool
) -> float:
    """The least gap between the parts of a pair along a direction in a step, times its length; see
    `find_pairs` for stop.

    Each particle moves along a line at a constant speed, so this gap is least at the start or the
    end.
    """
    a, b = dot(row(x0, i), direction), dot(row(x0, j), direction)
    c, d = dot(row(x0, k), direction), dot(row(x0, m), direction)
    a1, b1 = dot(row(x, i), direction), dot(row(x, j), direction)
    c1, d1 = dot(row(x, k), direction), dot(row(x, m), direction)
    if not stop:
        return min(gap_of(a, b, c, d, edges), gap_of(a1, b1, c1, d1, edges))
    c, d = max(c, c1), max(d, d1)
    if edges:
        return min(min(a, a1), min(b, b1)) - max(c, d)
    return min(a, a1) - max(max(b, b1), max(c, d))


@borrowing_kernel
def moved(x0: Array, x: Array, i: int) -> Vector:
    """The displacement of particle i."""
    return subtract(row(x, i), row(x0, i))
