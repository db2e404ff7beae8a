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
    """Pairs in a step, or room for them. ends: particles of each, and 1 if it is two edges, 0 if it
    is a particle and a face, [P, 5]. offsets: unit vector from the nearest point of the second part
    to the nearest of the first at the start, and their distance [m], [P, 4]."""

    ends: NDArray[np.int32]
    offsets: Array


def room_for_pairs(contact: SelfContact) -> TouchingPairs:
    """Room for most cloths' pairs and those that are listed beside them; none for a cloth that
    passes through itself."""
    faces = len(contact.triangles)
    count = 8 * faces + 2 * LISTED if faces else 0
    return TouchingPairs(np.empty((count, 5), np.int32), np.empty((count, 4)))


@kernel
def find_pairs(
    x0: Array,
    x: Array,
    contact: SelfContact,
    windows: Windows,
    limit: float,
    stop: bool,
    room: TouchingPairs,
) -> TouchingPairs:
    """All pairs that may come within a limit [m] in this step, in an order that depends on the
    cloth alone. They lie in `room` unless they are too many for it.

    windows: no pairs are wanted in those that are smooth; none if all pairs are.
    stop: whether each particle may also stop anywhere on its way, so that others run into it.
    """
    bounds = particle_bounds(x0, x, 0.5 * limit, stop)
    of_edges = joined_bounds(bounds, contact.edges)
    of_faces = joined_bounds(bounds, contact.triangles)
    tree = tree_of(of_faces, contact.begin)
    pairs, count = room, 0
    stack, depth = np.empty((DEEPEST, 2), np.int32), 1
    stack[0] = 1
    # References are counted in this loop, as `pairs` is set in it, so it is left to do little.
    while depth > 0:
        if count + LISTED > len(pairs.ends):
            pairs = longer(pairs)
        depth, last = list_pairs(
            bounds, of_edges, of_faces, tree, contact, windows, stack, depth, pairs.ends, count
        )
        count = keep_near(x0, x, limit, stop, pairs, count, last)
    return TouchingPairs(pairs.ends[:count], pairs.offsets[:count])


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
    first: int,
) -> tuple[int, int]:
    """List pairs whose bounds overlap, from row `first` on, until all are listed or LISTED of them;
    returns the new depth of the stack and the end of the list.

    stack: pairs of equally deep nodes that are still to be searched, [DEEPEST, 2].
    """
    particles, triangles, edges = contact.particles, contact.triangles, contact.edges
    begin, leaves, last = contact.begin, len(tree) // 2, first
    while depth > 0 and last + MOST <= first + LISTED:
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
        last = list_corners(bounds, of_faces, particles, triangles, begin, a, b, listed, last)
        if b > a:
            last = list_corners(bounds, of_faces, particles, triangles, begin, b, a, listed, last)
        last = list_edges(of_edges, edges, begin, a, b, listed, last)
    return depth, last


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
    last: int,
) -> int:
    """List the particles of leaf a with the faces of leaf b whose bounds overlap; returns the new
    end of the list."""
    for n in range(begin[a, 0], begin[a + 1, 0]):
        p = particles[n]
        low, high = row(bounds, p), top(bounds, p)
        for t in range(begin[b, 1], begin[b + 1, 1]):
            if overlap(low, high, row(of_faces, t), top(of_faces, t)):
                i, j, k = triangles[t, 0], triangles[t, 1], triangles[t, 2]
                if p not in (i, j, k):
                    listed[last, 0], listed[last, 1], listed[last, 2] = p, i, j
                    listed[last, 3], listed[last, 4] = k, 0
                    last += 1
    return last


@borrowing_kernel
def list_edges(
    of_edges: Array,
    edges: NDArray[np.int32],
    begin: NDArray[np.int32],
    a: int,
    b: int,
    listed: NDArray[np.int32],
    last: int,
) -> int:
    """The same for the edges of both leaves."""
    for e in range(begin[a, 2], begin[a + 1, 2]):
        low, high = row(of_edges, e), top(of_edges, e)
        for f in range(e + 1 if a == b else begin[b, 2], begin[b + 1, 2]):
            if overlap(low, high, row(of_edges, f), top(of_edges, f)):
                i, j, k, m = edges[e, 0], edges[e, 1], edges[f, 0], edges[f, 1]
                if i not in (k, m) and j not in (k, m):
                    listed[last, 0], listed[last, 1], listed[last, 2] = i, j, k
                    listed[last, 3], listed[last, 4] = m, 1
                    last += 1
    return last


@kernel
def longer(pairs: TouchingPairs) -> TouchingPairs:
    """The same pairs with twice the space."""
    count = len(pairs.ends)
    more = TouchingPairs(np.empty((2 * count, 5), np.int32), np.empty((2 * count, 4)))
    for i in range(count):  # slices would compile numba's messages about shapes, for seconds
        for n in range(5):
            more.ends[i, n] = pairs.ends[i, n]
        for n in range(4):
            more.offsets[i, n] = pairs.offsets[i, n]
    return more


@borrowing_kernel
def keep_near(
    x0: Array, x: Array, limit: float, stop: bool, pairs: TouchingPairs, first: int, last: int
) -> int:
    """Keep of the listed pairs first..last those that may come within the limit, from `first` on;
    returns their end."""
    count, ends, offsets = first, pairs.ends, pairs.offsets
    for n in range(first, last):
        i, j, k, m, edges = ends[n, 0], ends[n, 1], ends[n, 2], ends[n, 3], ends[n, 4]
        direction = between_middles(x0, i, j, k, m, edges)
        gap = swept_gap(direction, x0, x, i, j, k, m, edges, stop)
        if gap > 0.0 and gap * gap > limit * limit * dot(direction, direction):
            continue
        _weights, offset = nearest(x0, i, j, k, m, edges)
        length = norm(offset)
        normal = scale(1.0 / length, offset) if length > 0.0 else UP
        if swept_gap(normal, x0, x, i, j, k, m, edges, stop) <= limit:
            ends[count, 0], ends[count, 1], ends[count, 2] = i, j, k
            ends[count, 3], ends[count, 4] = m, edges
            put(offsets, count, 0, normal)
            offsets[count, 3] = length
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
