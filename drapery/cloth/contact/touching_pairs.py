"""Parts of a cloth that may come near each other in a step.

Pairs of a particle and a face, and of two edges, are found with a spatial hash of the faces
(Teschner et al., "Optimized spatial hashing for collision detection of deformable objects", 2003).
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
from drapery.cloth.contact.geometry import UP, grown, higher, lower, overlap, put
from drapery.cloth.contact.pair_distance import nearest
from drapery.cloth.contact.self_contact_data import SelfContact
from drapery.jit import kernel
from drapery.mesh import Array

REACH = 1.5
"""Pairs are found that may come within this many times the thickness. So contacts may move each
particle by half of what this is above 1, and pairs that are not known still cannot cross."""
ROUNDING = 1e-9
"""Parts are found that are farther than they may be by this [m]."""
PRIMES = (73856093, 19349663, 83492791)
"""Teschner's primes for the three cell coordinates."""


class Parts(NamedTuple):
    """Where particles, edges or faces are in a step. bounds: of the motion, [K, 6]. balls: a ball
    around each at the start, its centre (3), mean motion (3), radius, and how much the motion of a
    particle differs from the mean [m], [K, 8]."""

    bounds: Array
    balls: Array


class Surroundings(NamedTuple):
    """All parts of a cloth in a step. limit: how near two parts matter [m]. stop: whether a
    particle may stop anywhere on its way."""

    particles: Parts
    edges: Parts
    faces: Parts
    limit: float
    stop: bool


class TouchingPairs(NamedTuple):
    """Pairs in a step: particles [P, 4]; a particle and a face, or two edges if `edges` [P] is 1.

    normals: from the nearest point of the second to that of the first at the start [P, 3].
    starts: distance at the start [m], [P].
    """

    ends: NDArray[np.int32]
    edges: NDArray[np.uint8]
    normals: Array
    starts: Array


@kernel
def find_pairs(
    x0: Array, x: Array, contact: SelfContact, limit: float, stop: bool
) -> TouchingPairs:
    """All pairs that may come within a limit [m] in this step.

    stop: whether each particle may also stop anywhere on its way, so that others run into it.
    """
    triangles = contact.triangles
    bounds = particle_bounds(x0, x, 0.5 * limit, stop)
    near = Surroundings(
        Parts(bounds, balls_of(x0, x, single(len(x)))),
        Parts(joined_bounds(bounds, contact.edges), balls_of(x0, x, contact.edges)),
        Parts(joined_bounds(bounds, triangles), balls_of(x0, x, triangles)),
        limit,
        stop,
    )
    faces = near.faces
    cells = cells_of(faces.bounds)
    starts, members = hashed(cells)
    pairs, count = empty_pairs(8 * len(triangles) + 64), 0
    for s in range(len(triangles)):
        for a in range(cells[s, 0] - 1, cells[s, 0] + 2):
            for b in range(cells[s, 1] - 1, cells[s, 1] + 2):
                for c in range(cells[s, 2] - 1, cells[s, 2] + 2):
                    key = key_of(a, b, c, len(starts) - 1)
                    for place in range(starts[key], starts[key + 1]):
                        t = members[place]
                        if t <= s or cells[t, 0] != a or cells[t, 1] != b or cells[t, 2] != c:
                            continue
                        if not may_meet(faces, s, faces, t, near):
                            continue
                        if count + 15 > len(pairs.ends):
                            pairs = longer(pairs)
                        count = add_corners(x0, x, s, t, contact, near, pairs, count)
                        count = add_corners(x0, x, t, s, contact, near, pairs, count)
                        count = add_edges(x0, x, s, t, contact, near, pairs, count)
    return TouchingPairs(
        pairs.ends[:count], pairs.edges[:count], pairs.normals[:count], pairs.starts[:count]
    )


@kernel
def key_of(a: int, b: int, c: int, slots: int) -> int:
    """The slot of a cell of the spatial hash."""
    return ((a * PRIMES[0]) ^ (b * PRIMES[1]) ^ (c * PRIMES[2])) % slots


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
def top(bounds: Array, i: int) -> Vector:
    """The high corner of bounds [K, 6]."""
    return bounds[i, 3], bounds[i, 4], bounds[i, 5]


@kernel
def touch(one: Array, i: int, other: Array, j: int) -> bool:
    """Whether two bounds overlap."""
    return overlap(row(one, i), top(one, i), row(other, j), top(other, j))


@kernel
def hashed(cells: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Counting sort of cells [T, 3] by key; equal keys stay in the order of their indices."""
    count = len(cells)
    slots = 2 * count + 1
    starts = np.zeros(slots + 1, np.int64)
    keys = np.empty(count, np.int64)
    for i in range(count):
        keys[i] = key_of(cells[i, 0], cells[i, 1], cells[i, 2], slots)
        starts[keys[i] + 1] += 1
    for slot in range(slots):
        starts[slot + 1] += starts[slot]
    fill, members = starts[:-1].copy(), np.empty(count, np.int64)
    for i in range(count):
        members[fill[keys[i]]] = i
        fill[keys[i]] += 1
    return starts, members


@kernel
def single(count: int) -> NDArray[np.int32]:
    """Parts of one particle each, [count, 1]."""
    parts = np.empty((count, 1), np.int32)
    for i in range(count):
        parts[i, 0] = i
    return parts


@kernel
def balls_of(x0: Array, x: Array, parts: NDArray[np.int32]) -> Array:
    """The balls of `Parts`; parts: particles, [K, 1], [K, 2] or [K, 3]."""
    balls, size = np.empty((len(parts), 8)), parts.shape[1]
    for n in range(len(parts)):
        centre, motion = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        for corner in range(size):
            i = parts[n, corner]
            centre = add_scaled(centre, 1.0 / size, row(x0, i))
            motion = add_scaled(motion, 1.0 / size, moved(x0, x, i))
        radius, spread = 0.0, 0.0
        for corner in range(size):
            i = parts[n, corner]
            radius = max(radius, square(row(x0, i), centre))
            spread = max(spread, square(moved(x0, x, i), motion))
        put(balls, n, 0, centre)
        put(balls, n, 3, motion)
        balls[n, 6], balls[n, 7] = np.sqrt(radius), np.sqrt(spread)
    return balls


@kernel
def may_meet(one: Parts, i: int, other: Parts, j: int, near: Surroundings) -> bool:
    """Whether two parts may come within the limit: their bounds overlap, and their balls are
    not farther from each other than that and their motion relative to each other."""
    a, b = one.balls, other.balls
    away = square(row(a, i), row(b, j))
    reach = near.limit + a[i, 6] + b[j, 6] + a[i, 7] + b[j, 7] + ROUNDING
    if away > reach * reach:
        first, second = (a[i, 3], a[i, 4], a[i, 5]), (b[j, 3], b[j, 4], b[j, 5])
        reach += norm(first) + norm(second) if near.stop else np.sqrt(square(first, second))
        if away > reach * reach:
            return False
    return touch(one.bounds, i, other.bounds, j)


@kernel
def cells_of(bounds: Array) -> NDArray[np.int64]:
    """The cells of the middles of bounds [T, 6]; bounds that overlap are in neighbouring cells."""
    size = 1e-9
    for t in range(len(bounds)):
        low, high = row(bounds, t), top(bounds, t)
        size = max(size, max(high[0] - low[0], max(high[1] - low[1], high[2] - low[2])))
    cells = np.empty((len(bounds), 3), np.int64)
    for t in range(len(bounds)):
        for axis in range(3):
            cells[t, axis] = int(np.floor((bounds[t, axis] + bounds[t, 3 + axis]) / 2 / size))
    return cells


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


@kernel
def add_corners(
    x0: Array,
    x: Array,
    s: int,
    t: int,
    contact: SelfContact,
    near: Surroundings,
    pairs: TouchingPairs,
    count: int,
) -> int:
    """Add the pairs of face t and the particles for which face s answers; returns the new count."""
    triangles, owner = contact.triangles, contact.particle_owner
    i, j, k = triangles[t, 0], triangles[t, 1], triangles[t, 2]
    for corner in range(3):
        p = triangles[s, corner]
        if owner[p] != s or p in (i, j, k):
            continue
        if may_meet(near.particles, p, near.faces, t, near):
            count = add_pair(x0, x, near, pairs, count, p, i, j, k, 0)
    return count


@kernel
def add_edges(
    x0: Array,
    x: Array,
    s: int,
    t: int,
    contact: SelfContact,
    near: Surroundings,
    pairs: TouchingPairs,
    count: int,
) -> int:
    """Add the pairs of edges for which faces s and t answer; returns the new count."""
    edges, owner = contact.edges, contact.edge_owner
    for n in range(9):
        e, f = contact.of_face[s, n // 3], contact.of_face[t, n % 3]
        if owner[e] != s or owner[f] != t:
            continue
        i, j, k, m = edges[e, 0], edges[e, 1], edges[f, 0], edges[f, 1]
        if i in (k, m) or j in (k, m):
            continue
        if may_meet(near.edges, e, near.edges, f, near):
            count = add_pair(x0, x, near, pairs, count, i, j, k, m, 1)
    return count


@kernel
def add_pair(
    x0: Array,
    x: Array,
    near: Surroundings,
    pairs: TouchingPairs,
    count: int,
    i: int,
    j: int,
    k: int,
    m: int,
    edges: int,
) -> int:
    """Add a pair if its parts may come within the limit; returns the new count."""
    _weights, offset = nearest(x0, i, j, k, m, edges)
    length = norm(offset)
    if near.stop:
        longest = longest_sum(x0, x, i, j, k, m, edges)
    else:
        longest = longest_relative(x0, x, i, j, k, m, edges)
    if length > near.limit + longest:
        return count
    pairs.ends[count, 0], pairs.ends[count, 1] = i, j
    pairs.ends[count, 2], pairs.ends[count, 3] = k, m
    pairs.edges[count] = edges
    put(pairs.normals, count, 0, scale(1.0 / length, offset) if length > 0.0 else UP)
    pairs.starts[count] = length
    return count + 1


@kernel
def moved(x0: Array, x: Array, i: int) -> Vector:
    """The displacement of particle i."""
    return subtract(row(x, i), row(x0, i))


@kernel
def longest_relative(x0: Array, x: Array, i: int, j: int, k: int, m: int, edges: int) -> float:
    """The longest displacement [m] of a particle of one part relative to one of the other."""
    a, b, c, d = moved(x0, x, i), moved(x0, x, j), moved(x0, x, k), moved(x0, x, m)
    most = max(square(a, c), square(a, d))
    most = max(most, max(square(b, c), square(b, d)) if edges else square(a, b))
    return float(np.sqrt(most))


@kernel
def longest_sum(x0: Array, x: Array, i: int, j: int, k: int, m: int, edges: int) -> float:
    """The longest displacement [m] of a particle of one part, and of one of the other, together."""
    a, b = norm(moved(x0, x, i)), norm(moved(x0, x, j))
    c, d = norm(moved(x0, x, k)), norm(moved(x0, x, m))
    return max(a, b) + max(c, d) if edges else a + max(b, max(c, d))


@kernel
def square(a: Vector, b: Vector) -> float:
    offset = subtract(a, b)
    return dot(offset, offset)
