"""Contact of a cloth with itself, or of several cloths that are sewn into one without seams.

Pairs of a particle and a face, and of two edges, that come near each other in a step are found with
a spatial hash of the faces (Teschner et al. 2003). Pairs nearer than the thickness are pushed
apart, shared by inverse mass, with friction (Bridson, Fedkiw, Anderson 2002).

At the end the step is made safe, as in offset geometric contact (Chen et al., SIGGRAPH 2025), which
bounds the displacement of each vertex so that it cannot pass through anything. A pair whose parts
move relative to each other by less than their distance at the start cannot cross. For the others
additive continuous collision detection (Li, Kaufman, Jiang, "Codimensional incremental potential
contact", 2021, section 5) finds how far they may move; the displacements of their particles are
shortened to that, until every pair is safe. So a cloth that does not cross itself at the start of a
step never does.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.box_contact import (
    COLUMNS,
    UP,
    BoxContact,
    Candidates,
    empty_candidates,
    grown,
    guard_boxes,
    higher,
    lower,
    meet_boxes,
    overlap,
    put,
)
from drapery.cloth.cloth import Cloth
from drapery.cloth.colliders.vectors import (
    Vector,
    add_scaled,
    dot,
    norm,
    row,
    scale,
    subtract,
)
from drapery.errors import OptionError
from drapery.jit import entry_point, kernel
from drapery.mesh import Array

PASSES = 4
"""The most passes over all pairs in a step."""
ROUNDS = 3
"""How often contacts with itself and with boxes take turns in a step."""
GUARDS = 24
"""The most rounds in which displacements are shortened; then the cloth rests for one step."""
MARGIN, CLOSE = 0.1, 0.02
"""Pairs that would cross stop at this part of their distance at the start, within CLOSE of it."""
LEAST = 2e-5
"""Pairs that would cross stop at this distance beside [m], or at half of that at the start: single
precision cannot hold less between particles some metres from the origin."""
CAREFUL = 0.9
"""Advances are shorter than they might be by this factor."""
ADVANCES = 64
"""The most advances of a pair in a step; one that needs more stops there."""
REACH = 1.5
"""Pairs are found that may come within this many times the thickness. So contacts may move each
particle by half of what this is above 1, and pairs that are not known still cannot cross."""
NARROW = 0.5
"""Parts of a cloth may be as near as this many times its shortest edge, however thick it is: else
the particles around one particle would push it."""
AT_REST = 0.75
"""Parts of one cloth may be as near as this many times their distance at rest."""
FRICTION = 0.3
"""Coulomb's coefficient between cloths: wool on wool has 0.3 to 0.5."""
ROUNDING = 1e-9
"""Parts are found that are farther than they may be by this [m]."""
PRIMES = (73856093, 19349663, 83492791)
"""Teschner's primes for the three cell coordinates."""


class SelfContact(NamedTuple):
    """What contact of a cloth with itself needs.

    thickness: least distance [m], see NARROW. rest: places at rest [m], [N, 3].
    inv_mass: [1/kg], [N].
    piece: number of the connected part of each particle, [N]. triangles: [T, 3]. edges: ends of
    each edge, [E, 2]. of_face: the three edges of each face, [T, 3]. owner: the face that answers
    for a particle, [N], and for an edge, [E], so that each pair is found once.
    rows, columns: of a grid, or 0.
    """

    thickness: float
    rest: Array
    inv_mass: Array
    piece: NDArray[np.int32]
    triangles: NDArray[np.int32]
    edges: NDArray[np.int32]
    of_face: NDArray[np.int32]
    particle_owner: NDArray[np.int32]
    edge_owner: NDArray[np.int32]
    rows: int
    columns: int


class Parts(NamedTuple):
    """Where particles, edges or faces are in a step. bounds: of the motion, [K, 6]. balls: a ball
    around each at the start, its centre (3), mean motion (3), radius, and how much the motion of a
    particle differs from the mean [m], [K, 8]."""

    bounds: Array
    balls: Array


class Surroundings(NamedTuple):
    """All parts of a cloth in a step, and how near two parts matter [m]."""

    particles: Parts
    edges: Parts
    faces: Parts
    limit: float


class TouchingPairs(NamedTuple):
    """Pairs in a step: particles [P, 4]; a particle and a face, or two edges if `edges` [P] is 1.

    normals: from the nearest point of the second to that of the first at the start [P, 3].
    starts: distance at the start [m], [P].
    """

    ends: NDArray[np.int32]
    edges: NDArray[np.uint8]
    normals: Array
    starts: Array


def make_self_contact(cloth: Cloth, thickness: float) -> SelfContact:
    """What contact of a cloth with itself needs; thickness: least distance [m].

    Raises OptionError unless it is above 0.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    if not 0 < thickness < np.inf:
        raise OptionError(
            f"self-collision thickness {thickness} is out of range; use a length above 0 [m]"
        )
    triangles = np.ascontiguousarray(cloth.triangles, np.int32)
    count = len(cloth.inv_mass)
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges, number = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    of_face = number.reshape(3, -1).T.astype(np.int32)
    graph = coo_array((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(count, count))
    piece = connected_components(graph, directed=False)[1]
    faces = np.arange(len(triangles), dtype=np.int32)
    rows, columns = cloth.grid_shape or (0, 0)
    ends = cloth.rest_positions[edges]
    shortest = np.sqrt(np.square(ends[:, 0] - ends[:, 1]).sum(axis=1)).min(initial=np.inf)
    return SelfContact(
        min(float(thickness), float(NARROW * shortest)),
        np.ascontiguousarray(cloth.rest_positions, float),
        np.ascontiguousarray(cloth.inv_mass, float),
        piece.astype(np.int32),
        triangles,
        np.ascontiguousarray(edges, np.int32),
        np.ascontiguousarray(of_face),
        _owners(triangles, faces, count),
        _owners(of_face, faces, len(edges)),
        rows,
        columns,
    )


def _owners(parts: NDArray[np.int32], faces: NDArray[np.int32], count: int) -> NDArray[np.int32]:
    """The first face of each part, -1 for parts of no face."""
    owner = np.full(count, len(faces), np.int32)
    np.minimum.at(owner, parts.ravel(), np.repeat(faces, 3))
    owner[owner == len(faces)] = -1
    return owner


@entry_point
def meet_all(
    x0: Array, x: Array, begin: int, end: int, contact: SelfContact, boxes: BoxContact
) -> None:
    """Resolve the contacts of cloths begin..end with themselves and with boxes.

    x0, x: places at the start and the end of a step [m], [B, N, 3]; x is changed.
    """
    frame, near = np.empty((len(contact.inv_mass), COLUMNS)), empty_candidates(boxes)
    for cloth in range(begin, end):
        meet_one(x0[cloth], x[cloth], contact, boxes, frame, near)


@kernel
def meet_one(
    x0: Array, x: Array, contact: SelfContact, boxes: BoxContact, frame: Array, near: Candidates
) -> None:
    """The same for one cloth, [N, 3]."""
    meets_boxes = len(boxes.halves) > 0
    if is_smooth(x0, contact) and is_smooth(x, contact):
        if meets_boxes:
            meet_boxes(x0, x, boxes, frame, near)
        return
    wanted = x.copy()
    pairs = find_pairs(x0, x, contact)
    for _ in range(ROUNDS):
        deepest = 0.0
        for _ in range(PASSES):
            deepest = push_pairs(x0, x, pairs, contact)
            if deepest < 0.02 * contact.thickness:
                break
        if not meets_boxes or not meet_boxes(x0, x, boxes, frame, near):
            break
    for i in range(len(x)):
        change = subtract(row(x, i), row(wanted, i))
        length, limit = norm(change), 0.5 * (REACH - 1.0) * contact.thickness
        if length > limit:
            put(x, i, 0, add_scaled(row(wanted, i), limit / length, change))
    make_safe(x0, x, pairs, contact, boxes, frame, near)


@kernel
def make_safe(
    x0: Array,
    x: Array,
    pairs: TouchingPairs,
    contact: SelfContact,
    boxes: BoxContact,
    frame: Array,
    near: Candidates,
) -> None:
    """Shorten displacements until no pair can have crossed and no part of the cloth is in a box."""
    for number in range(GUARDS):
        found = shorten_unsafe(x0, x, pairs, contact.inv_mass, number >= GUARDS // 2)
        if len(boxes.halves) > 0:
            before = x.copy()
            guard_boxes(x0, x, boxes, frame, near)
            for i in range(len(x)):
                for axis in range(3):
                    found = found or before[i, axis] != x[i, axis]
        if not found:
            return
    for i in range(len(x)):
        if contact.inv_mass[i] > 0.0:
            put(x, i, 0, row(x0, i))


@kernel
def is_smooth(x: Array, contact: SelfContact) -> bool:
    """Whether a grid lies over a plane without folds, so that it cannot touch itself.

    It does if, seen along some direction, every edge along a row is within 45 degrees of one
    axis and every edge along a column within 45 degrees of the other: then the picture of no two
    points of the grid is the same.
    """
    rows, columns = contact.rows, contact.columns
    if rows < 2 or columns < 2:
        return False
    across, down = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for r in range(rows):
        across = add_scaled(
            across, 1.0, subtract(row(x, r * columns + columns - 1), row(x, r * columns))
        )
    for c in range(columns):
        down = add_scaled(down, 1.0, subtract(row(x, (rows - 1) * columns + c), row(x, c)))
    length = norm(across)
    if length == 0.0:
        return False
    first = scale(1.0 / length, across)
    down = add_scaled(down, -dot(down, first), first)
    length = norm(down)
    if length == 0.0:
        return False
    second = scale(1.0 / length, down)
    for r in range(rows):
        for c in range(columns):
            i = r * columns + c
            if c + 1 < columns:
                edge = subtract(row(x, i + 1), row(x, i))
                if dot(edge, first) <= abs(dot(edge, second)):
                    return False
            if r + 1 < rows:
                edge = subtract(row(x, i + columns), row(x, i))
                if dot(edge, second) <= abs(dot(edge, first)):
                    return False
    return True


@kernel
def key_of(a: int, b: int, c: int, slots: int) -> int:
    """The slot of a cell of the spatial hash."""
    return ((a * PRIMES[0]) ^ (b * PRIMES[1]) ^ (c * PRIMES[2])) % slots


@kernel
def particle_bounds(x0: Array, x: Array, margin: float) -> Array:
    """Low and high corner of the motion of each particle with a margin [m], [N, 6].

    The mean motion of the cloth is left out: it brings no parts together.
    """
    mean = (0.0, 0.0, 0.0)
    for i in range(len(x)):
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
def find_pairs(x0: Array, x: Array, contact: SelfContact) -> TouchingPairs:
    """All pairs that may come nearer than the thickness in this step."""
    triangles, limit = contact.triangles, REACH * contact.thickness
    bounds = particle_bounds(x0, x, 0.5 * limit)
    near = Surroundings(
        Parts(bounds, balls_of(x0, x, single(len(x)))),
        Parts(joined_bounds(bounds, contact.edges), balls_of(x0, x, contact.edges)),
        Parts(joined_bounds(bounds, triangles), balls_of(x0, x, triangles)),
        limit,
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
                        if not may_meet(faces, s, faces, t, limit):
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
def may_meet(one: Parts, i: int, other: Parts, j: int, limit: float) -> bool:
    """Whether two parts may come within the limit [m]: their bounds overlap, and their balls are
    not farther from each other than that and their motion relative to each other."""
    a, b = one.balls, other.balls
    away = square(row(a, i), row(b, j))
    reach = limit + a[i, 6] + b[j, 6] + a[i, 7] + b[j, 7] + ROUNDING
    if away > reach * reach:
        reach += np.sqrt(square((a[i, 3], a[i, 4], a[i, 5]), (b[j, 3], b[j, 4], b[j, 5])))
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
        if may_meet(near.particles, p, near.faces, t, near.limit):
            count = add_pair(x0, x, near.limit, pairs, count, p, i, j, k, 0)
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
        if may_meet(near.edges, e, near.edges, f, near.limit):
            count = add_pair(x0, x, near.limit, pairs, count, i, j, k, m, 1)
    return count


@kernel
def add_pair(
    x0: Array,
    x: Array,
    limit: float,
    pairs: TouchingPairs,
    count: int,
    i: int,
    j: int,
    k: int,
    m: int,
    edges: int,
) -> int:
    """Add a pair if its parts may come within a limit [m]; returns the new count."""
    _weights, offset = nearest(x0, i, j, k, m, edges)
    length = norm(offset)
    if length > limit + longest_relative(x0, x, i, j, k, m, edges):
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
def square(a: Vector, b: Vector) -> float:
    offset = subtract(a, b)
    return dot(offset, offset)


@kernel
def nearest(
    x: Array, i: int, j: int, k: int, m: int, edges: int
) -> tuple[tuple[float, float, float, float], Vector]:
    """Weights of the nearest points of a pair (for the first part positive, for the second
    negative), and the vector between them."""
    a, b, c, d = row(x, i), row(x, j), row(x, k), row(x, m)
    if edges:
        s, t = nearest_of_segments(a, b, c, d)
        p = add_scaled(a, s, subtract(b, a))
        q = add_scaled(c, t, subtract(d, c))
        return (1.0 - s, s, t - 1.0, -t), subtract(p, q)
    u, v, w = nearest_of_face(b, c, d, a)
    q = add_scaled(add_scaled(scale(u, b), v, c), w, d)
    return (1.0, -u, -v, -w), subtract(a, q)


@kernel
def nearest_of_segments(a: Vector, b: Vector, c: Vector, d: Vector) -> tuple[float, float]:
    """The parts of two segments at which they are nearest (Ericson 2005, section 5.1.9)."""
    d1, d2, r = subtract(b, a), subtract(d, c), subtract(a, c)
    aa, ee, f = dot(d1, d1), dot(d2, d2), dot(d2, r)
    cc, bb = dot(d1, r), dot(d1, d2)
    if aa <= 0.0 or ee <= 0.0:
        return 0.0, min(max(f / ee, 0.0), 1.0) if ee > 0.0 else 0.0
    denominator = aa * ee - bb * bb
    s = 0.5
    if denominator > 1e-12 * aa * ee:
        s = min(max((bb * f - cc * ee) / denominator, 0.0), 1.0)
    t = (bb * s + f) / ee
    if t < 0.0:
        return min(max(-cc / aa, 0.0), 1.0), 0.0
    if t > 1.0:
        return min(max((bb - cc) / aa, 0.0), 1.0), 1.0
    return s, t


@kernel
def nearest_of_face(a: Vector, b: Vector, c: Vector, p: Vector) -> Vector:
    """Barycentric weights of the nearest point of a triangle (Ericson 2005, section 5.1.5)."""
    ab, ac, ap = subtract(b, a), subtract(c, a), subtract(p, a)
    d1, d2 = dot(ab, ap), dot(ac, ap)
    if d1 <= 0 and d2 <= 0:
        return 1.0, 0.0, 0.0
    bp = subtract(p, b)
    d3, d4 = dot(ab, bp), dot(ac, bp)
    if d3 >= 0 and d4 <= d3:
        return 0.0, 1.0, 0.0
    vc = d1 * d4 - d3 * d2
    if vc <= 0 and d1 >= 0 and d3 <= 0:
        v = d1 / (d1 - d3)
        return 1.0 - v, v, 0.0
    cp = subtract(p, c)
    d5, d6 = dot(ab, cp), dot(ac, cp)
    if d6 >= 0 and d5 <= d6:
        return 0.0, 0.0, 1.0
    vb = d5 * d2 - d1 * d6
    if vb <= 0 and d2 >= 0 and d6 <= 0:
        w = d2 / (d2 - d6)
        return 1.0 - w, 0.0, w
    va = d3 * d6 - d5 * d4
    if va <= 0 and d4 >= d3 and d5 >= d6:
        w = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        return 0.0, 1.0 - w, w
    inverse = 1 / (va + vb + vc)
    return va * inverse, vb * inverse, vc * inverse


@kernel
def push_pairs(x0: Array, x: Array, pairs: TouchingPairs, contact: SelfContact) -> float:
    """Push apart the pairs that are too near, one after another; returns the deepest [m]."""
    w, deepest = contact.inv_mass, 0.0
    for n in range(len(pairs.ends)):
        i, j, k, m = pairs.ends[n, 0], pairs.ends[n, 1], pairs.ends[n, 2], pairs.ends[n, 3]
        weights, offset = nearest(x, i, j, k, m, pairs.edges[n])
        length = norm(offset)
        normal = row(pairs.normals, n)
        # A pair that has crossed in this step goes back to the side of its start.
        crossed = dot(offset, normal) < 0.0
        if length >= contact.thickness and not crossed:
            continue
        limit = contact.thickness
        if contact.piece[i] == contact.piece[k]:
            _weights, at_rest = nearest(contact.rest, i, j, k, m, pairs.edges[n])
            limit = min(limit, AT_REST * norm(at_rest))
        depth = limit - length
        if crossed:
            depth = limit + length
        elif length > 0.0:
            normal = scale(1.0 / length, offset)
        total = weights[0] * weights[0] * w[i] + weights[1] * weights[1] * w[j]
        total += weights[2] * weights[2] * w[k] + weights[3] * weights[3] * w[m]
        if depth <= 1e-7 or total == 0.0:
            continue
        slide = scale(weights[0], moved(x0, x, i))
        slide = add_scaled(slide, weights[1], moved(x0, x, j))
        slide = add_scaled(slide, weights[2], moved(x0, x, k))
        slide = add_scaled(slide, weights[3], moved(x0, x, m))
        slide = add_scaled(slide, -dot(slide, normal), normal)
        held, along = FRICTION * depth, norm(slide)
        back = 1.0 if along <= held else held / along
        change = add_scaled(scale(depth, normal), -back, slide)
        put(x, i, 0, add_scaled(row(x, i), weights[0] * w[i] / total, change))
        put(x, j, 0, add_scaled(row(x, j), weights[1] * w[j] / total, change))
        put(x, k, 0, add_scaled(row(x, k), weights[2] * w[k] / total, change))
        put(x, m, 0, add_scaled(row(x, m), weights[3] * w[m] / total, change))
        deepest = max(deepest, depth)
    return deepest


@kernel
def shorten_unsafe(x0: Array, x: Array, pairs: TouchingPairs, w: Array, stop: bool) -> bool:
    """Shorten the displacements of pairs that would cross, to 0 if they shall stop; returns whether
    there was any."""
    found = False
    for n in range(len(pairs.ends)):
        i, j, k, m = pairs.ends[n, 0], pairs.ends[n, 1], pairs.ends[n, 2], pairs.ends[n, 3]
        if longest_relative(x0, x, i, j, k, m, pairs.edges[n]) < CAREFUL * pairs.starts[n]:
            continue
        part = safe_part(x0, x, i, j, k, m, pairs.edges[n], pairs.starts[n])
        if part < 1.0:
            found = True
            part = 0.0 if stop else CAREFUL * part
            shorten(x0, x, w, i, part)
            shorten(x0, x, w, j, part)
            shorten(x0, x, w, k, part)
            shorten(x0, x, w, m, part)
    return found


@kernel
def shorten(x0: Array, x: Array, w: Array, i: int, part: float) -> None:
    """Shorten the displacement of a free particle to a part of it."""
    if w[i] > 0.0:
        put(x, i, 0, add_scaled(row(x0, i), part, moved(x0, x, i)))


@kernel
def safe_part(
    x0: Array, x: Array, i: int, j: int, k: int, m: int, edges: int, start: float
) -> float:
    """The part of the step after which a pair is as near as MARGIN times its distance at the start;
    1 if it never is. Each advance is less than the distance, so it cannot miss a contact."""
    a, b, c, d = row(x0, i), row(x0, j), row(x0, k), row(x0, m)
    u, v, p, q = moved(x0, x, i), moved(x0, x, j), moved(x0, x, k), moved(x0, x, m)
    mean = scale(0.25, add_scaled(add_scaled(add_scaled(u, 1.0, v), 1.0, p), 1.0, q))
    u, v, p, q = subtract(u, mean), subtract(v, mean), subtract(p, mean), subtract(q, mean)
    if edges:
        speed = max(norm(u), norm(v)) + max(norm(p), norm(q))
    else:
        speed = norm(u) + max(norm(v), max(norm(p), norm(q)))
    part, length, least = 0.0, start, MARGIN * start + min(0.5 * start, LEAST)
    for _ in range(ADVANCES):
        advance = CAREFUL * (length - least) / speed
        part += advance
        if part >= 1.0:
            return 1.0
        a1, b1 = add_scaled(a, part, u), add_scaled(b, part, v)
        c1, d1 = add_scaled(c, part, p), add_scaled(d, part, q)
        length = distance_of(a1, b1, c1, d1, edges)
        if length - least <= CLOSE * start:
            return part - advance
    return part


@kernel
def distance_of(a: Vector, b: Vector, c: Vector, d: Vector, edges: int) -> float:
    """The distance [m] of two edges ab and cd, or of a particle a and a face bcd."""
    if edges:
        s, t = nearest_of_segments(a, b, c, d)
        p, q = add_scaled(a, s, subtract(b, a)), add_scaled(c, t, subtract(d, c))
        return norm(subtract(p, q))
    u, v, w = nearest_of_face(b, c, d, a)
    return norm(subtract(a, add_scaled(add_scaled(scale(u, b), v, c), w, d)))
