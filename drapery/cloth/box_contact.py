"""Contact of one cloth with boxes, as kernels; planes are very large boxes.

A box is convex, so its signed distance is convex too. Along an edge of the cloth the distance
therefore has one minimum, which lies inside the edge only if the distance falls at its start and
rises at its end. Particles, edges and corners of the box against faces are tested, which are all
features of two bodies that can touch first (Ericson, "Real-Time Collision Detection", 2005,
section 5.1). A contact pushes the nearest point of the cloth out to the radius, shared by inverse
mass (Bridson, Fedkiw, Anderson 2002, section 7), and friction shortens its motion along the box by
at most the coefficient times the push (Macklin et al., "Unified particle physics", 2014).

At the end a particle that still makes an edge or a face of the cloth cross a box returns to
its place at the start of the step. The start is free of penetration, so this ends without one,
whatever the contacts could not solve.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.collider import Collider
from drapery.cloth.colliders.pose import Pose
from drapery.cloth.colliders.primitives import cuboid_distance
from drapery.cloth.colliders.shapes import Box, Plane, Shape
from drapery.cloth.colliders.vectors import (
    Vector,
    add,
    add_scaled,
    dot,
    norm,
    rotated,
    rotated_back,
    row,
    scale,
    subtract,
)
from drapery.jit import kernel
from drapery.mesh import Array

PASSES = 6
"""The most passes over all contacts in a step."""
TOLERANCE = 0.02
"""A pass whose deepest contact is shallower than this part of the radius is the last one."""
TOUCH = 1e-7
"""Distances [m] below which a contact is exact."""
GUARDED = 0.25
"""Particles may return to their start only if the last pass found a contact that is deeper than
this part of the radius."""
GUARDS = 16
"""The most rounds in which particles return to their places at the start of the step."""
AMPLIFIED = 4.0
"""A contact moves no particle by more than this many times its depth."""
SEARCH = 16
"""The most steps of the search for the nearest point of an edge."""
REACH = 1.5
"""No edge of a cloth is longer than this many times its longest edge at rest."""
FAR = 1e3
"""Half the size of the box that stands for a plane [m]."""
FLAT, NEAREST = 1e-4, 1e-4
"""That search ends where the slope of the distance is less, and where it cannot find a distance
that is less by more than this [m]."""
UP = (0.0, 1.0, 0.0)
START, END, DISTANCE, OUTWARD, MOVED, COLUMNS = 0, 3, 6, 7, 10, 11
"""The columns of a cloth in the frame of a box, [N, COLUMNS]: the place at the start and the end of
a step [m], the distance at the end [m] and its direction (infinite and unknown for particles that
are not near), and whether the particle was moved. One array is passed on much faster than five."""


class BoxContact(NamedTuple):
    """The boxes that a cloth meets, and what their kernels need of the cloth.

    poses: place [m] and rotation of each box, [K, 12].
    halves: half its edge lengths [m], [K, 3]. friction: [K].
    radius: distance that the cloth keeps [m].
    reach: no edge of the cloth is longer [m]. edges: [E, 2]. triangles: [T, 3]. inv_mass: [1/kg],
    [N].
    """

    poses: Array
    halves: Array
    friction: Array
    radius: float
    reach: float
    edges: NDArray[np.int32]
    triangles: NDArray[np.int32]
    inv_mass: Array


NO_CONTACT = BoxContact(
    np.zeros((0, 12)),
    np.zeros((0, 3)),
    np.zeros(0),
    0.0,
    0.0,
    np.zeros((0, 2), np.int32),
    np.zeros((0, 3), np.int32),
    np.zeros(0),
)
"""The contact of cloths that meet nothing."""


def boxes_of(
    inv_mass: Array,
    triangles: NDArray[np.int32],
    rest: Array,
    colliders: Sequence[Collider],
    radius: float,
) -> BoxContact:
    """The contact with colliders whose shapes are a Box or a Plane, which rest and do not bounce.

    inv_mass: [1/kg], [N]. triangles: [T, 3]. rest: places at rest [m], [N, 3]. radius: distance
    that the cloth keeps [m].
    """
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = np.unique(np.sort(pairs, axis=1), axis=0).astype(np.int32)
    lengths = np.sqrt(np.square(rest[edges[:, 0]] - rest[edges[:, 1]]).sum(axis=1))
    rests, halves = zip(*(_box_of(collider.shape) for collider in colliders), strict=True)
    return BoxContact(
        np.stack([np.append(pose.position, pose.rotation) for pose in rests]),
        np.stack(halves),
        np.array([collider.friction for collider in colliders], float),
        radius,
        REACH * float(lengths.max(initial=0.0)),
        edges,
        np.ascontiguousarray(triangles, np.int32),
        np.ascontiguousarray(inv_mass, float),
    )


def _box_of(shape: Shape) -> tuple[Pose, Array]:
    """The place and rotation of a box, and half its edge lengths [m]; a plane is a large box."""
    if isinstance(shape, Box):
        return Pose(np.asarray(shape.centre, float), np.asarray(shape.rotation, float)), (
            np.asarray(shape.size, float) / 2
        )
    assert isinstance(shape, Plane)
    normal = np.asarray(shape.normal, float)
    normal = normal / np.sqrt(np.square(normal).sum())
    side = np.eye(3)[np.argmin(np.abs(normal))]
    first = side - (side * normal).sum() * normal
    first /= np.sqrt(np.square(first).sum())
    rotation = np.stack([first, normal, np.cross(first, normal)], axis=1)
    centre = np.asarray(shape.point, float) - FAR * normal
    return Pose(centre, rotation), np.full(3, FAR)


class Candidates(NamedTuple):
    """What of a cloth is near each box during a step: numbers of particles [K, N], edges [K, E] and
    faces [K, T], and how many there are, [K, 3]."""

    particles: NDArray[np.int32]
    edges: NDArray[np.int32]
    faces: NDArray[np.int32]
    counts: NDArray[np.int64]


def candidate_arrays(contact: BoxContact) -> Candidates:
    """Arrays for the cloth and the boxes of a contact."""
    boxes = len(contact.halves)
    return Candidates(
        np.empty((boxes, len(contact.inv_mass)), np.int32),
        np.empty((boxes, len(contact.edges)), np.int32),
        np.empty((boxes, len(contact.triangles)), np.int32),
        np.zeros((boxes, 3), np.int64),
    )


empty_candidates = kernel(candidate_arrays)


@kernel
def meet_boxes(x0: Array, x: Array, contact: BoxContact, frame: Array, near: Candidates) -> bool:
    """Resolve the contacts of one cloth in one step; returns whether there was any.

    x0, x: places at the start and the end of the step [m], [N, 3]; x is changed.
    frame, near: arrays to work in.
    """
    find_boxes(x0, x, contact, frame, near)
    return solve_boxes(x0, x, contact, frame, near)


@kernel
def find_boxes(x0: Array, x: Array, contact: BoxContact, frame: Array, near: Candidates) -> bool:
    """List what is near the boxes; returns whether there is anything."""
    low, high = bounds_of(x0, x)
    found = False
    for k in range(len(contact.halves)):
        find_near(x0, x, low, high, contact, k, frame, near)
        found = found or near.counts[k, 0] > 0
    return found


@kernel
def solve_boxes(x0: Array, x: Array, contact: BoxContact, frame: Array, near: Candidates) -> bool:
    """`meet_boxes` for what was found near."""
    met, deepest = False, 0.0
    for _ in range(PASSES):
        deepest = 0.0
        for k in range(len(contact.halves)):
            if near.counts[k, 0] > 0:
                enter_frame(x0, x, contact, k, frame, near)
                deepest = max(deepest, solve_box(contact, k, frame, near))
                leave_frame(x, contact, k, frame, near)
        met = met or deepest > 0.0
        if deepest <= TOLERANCE * contact.radius:
            break
    if deepest > GUARDED * contact.radius:
        guard_boxes(x0, x, contact, frame, near)
    return met


@kernel
def bounds_of(x0: Array, x: Array) -> tuple[Vector, Vector]:
    """The least box about a cloth's places at the start and the end of a step."""
    low, high = row(x, 0), row(x, 0)
    for i in range(len(x)):
        a, b = row(x0, i), row(x, i)
        low, high = lower(low, lower(a, b)), higher(high, higher(a, b))
    return low, high


@kernel
def lower(a: Vector, b: Vector) -> Vector:
    """The lower of each pair of coordinates."""
    return min(a[0], b[0]), min(a[1], b[1]), min(a[2], b[2])


@kernel
def higher(a: Vector, b: Vector) -> Vector:
    """The higher of each pair of coordinates."""
    return max(a[0], b[0]), max(a[1], b[1]), max(a[2], b[2])


@kernel
def grown(a: Vector, length: float) -> Vector:
    """All coordinates and the same length."""
    return a[0] + length, a[1] + length, a[2] + length


@kernel
def overlap(low: Vector, high: Vector, first: Vector, last: Vector) -> bool:
    """Whether two upright boxes have a common point."""
    return (
        low[0] <= last[0]
        and high[0] >= first[0]
        and low[1] <= last[1]
        and high[1] >= first[1]
        and low[2] <= last[2]
        and high[2] >= first[2]
    )


@kernel
def extent_of(contact: BoxContact, k: int) -> tuple[Vector, Vector]:
    """The lowest and the highest coordinates of what a box keeps free."""
    pose, half = contact.poses[k], row(contact.halves, k)
    x = abs(pose[3]) * half[0] + abs(pose[4]) * half[1] + abs(pose[5]) * half[2]
    y = abs(pose[6]) * half[0] + abs(pose[7]) * half[1] + abs(pose[8]) * half[2]
    z = abs(pose[9]) * half[0] + abs(pose[10]) * half[1] + abs(pose[11]) * half[2]
    centre, extent = row(contact.poses, k), grown((x, y, z), contact.radius)
    return subtract(centre, extent), add(centre, extent)


@kernel
def find_near(
    x0: Array,
    x: Array,
    low: Vector,
    high: Vector,
    contact: BoxContact,
    k: int,
    frame: Array,
    near: Candidates,
) -> None:
    """List what is so near a box that it may touch it in this step. low, high: of the cloth."""
    near.counts[k, 0] = near.counts[k, 1] = near.counts[k, 2] = 0
    first, last = extent_of(contact, k)
    margin = 2.0 * contact.radius + contact.reach
    if not overlap(low, high, first, last):
        return
    first, last = grown(first, -margin), grown(last, margin)
    found = 0
    for i in range(len(x)):
        frame[i, DISTANCE] = np.inf
        a, b = row(x0, i), row(x, i)
        if overlap(lower(a, b), higher(a, b), first, last):
            frame[i, DISTANCE] = 0.0
            near.particles[k, found] = i
            found += 1
    near.counts[k, 0] = found
    if found == 0:
        return
    enter_frame(x0, x, contact, k, frame, near)
    found = 0
    for e in range(len(contact.edges)):
        i, j = contact.edges[e, 0], contact.edges[e, 1]
        if frame[i, DISTANCE] + frame[j, DISTANCE] < 2.0 * margin and may_touch(
            contact, frame, i, j
        ):
            near.edges[k, found] = e
            found += 1
    near.counts[k, 1] = found
    found = 0
    for t in range(len(contact.triangles)):
        if near_corner(contact, k, frame, t):
            near.faces[k, found] = t
            found += 1
    near.counts[k, 2] = found


@kernel
def may_touch(contact: BoxContact, frame: Array, i: int, j: int) -> bool:
    """Whether an edge may come within the radius, contacts of the radius included."""
    along = subtract(end_of(frame, j), end_of(frame, i))
    total = frame[i, DISTANCE] + frame[j, DISTANCE] - 3.0 * contact.radius
    near: bool = total < 0.0 or total * total < dot(along, along)
    return near


@kernel
def near_corner(contact: BoxContact, k: int, frame: Array, t: int) -> bool:
    """Whether a corner of the box may come near the inside of a face."""
    i, j, m = contact.triangles[t, 0], contact.triangles[t, 1], contact.triangles[t, 2]
    nearest = min(frame[i, DISTANCE], frame[j, DISTANCE], frame[m, DISTANCE])
    if max(frame[i, DISTANCE], frame[j, DISTANCE], frame[m, DISTANCE]) == np.inf:
        return False
    if nearest > 3.0 * contact.radius + contact.reach:
        return False
    a, b, c = end_of(frame, i), end_of(frame, j), end_of(frame, m)
    low, high = lower(a, lower(b, c)), higher(a, higher(b, c))
    margin = 2.0 * contact.radius
    low, high = grown(low, -margin), grown(high, margin)
    half = row(contact.halves, k)
    return (
        has_end(low[0], high[0], half[0])
        and has_end(low[1], high[1], half[1])
        and has_end(low[2], high[2], half[2])
    )


@kernel
def has_end(low: float, high: float, half: float) -> bool:
    """Whether -half or half lies between two numbers."""
    return low < half < high or low < -half < high


@kernel
def enter_frame(
    x0: Array, x: Array, contact: BoxContact, k: int, frame: Array, near: Candidates
) -> None:
    """Set the places of near particles relative to a box, and their distances."""
    turn, centre = contact.poses[k, 3:].reshape(3, 3), row(contact.poses, k)
    half = row(contact.halves, k)
    for n in range(near.counts[k, 0]):
        i = near.particles[k, n]
        put(frame, i, START, rotated_back(turn, subtract(row(x0, i), centre)))
        put(frame, i, END, rotated_back(turn, subtract(row(x, i), centre)))
        measure(half, frame, i)
        frame[i, MOVED] = 0.0


@kernel
def leave_frame(x: Array, contact: BoxContact, k: int, frame: Array, near: Candidates) -> None:
    """Write the new places of the particles that were moved."""
    turn, centre = contact.poses[k, 3:].reshape(3, 3), row(contact.poses, k)
    for n in range(near.counts[k, 0]):
        i = near.particles[k, n]
        if frame[i, MOVED] > 0.0:
            put(x, i, 0, add_scaled(centre, 1.0, rotated(turn, end_of(frame, i))))


@kernel
def put(rows: Array, i: int, first: int, values: Vector) -> None:
    """Set three numbers of row i, from number `first` on."""
    rows[i, first], rows[i, first + 1], rows[i, first + 2] = values


@kernel
def start_of(frame: Array, i: int) -> Vector:
    return frame[i, 0], frame[i, 1], frame[i, 2]


@kernel
def end_of(frame: Array, i: int) -> Vector:
    return frame[i, 3], frame[i, 4], frame[i, 5]


@kernel
def outward_of(frame: Array, i: int) -> Vector:
    return frame[i, 7], frame[i, 8], frame[i, 9]


@kernel
def measure(half: Vector, frame: Array, i: int) -> None:
    """Set the distance and the direction of particle i at its end."""
    frame[i, DISTANCE], outward = cuboid_distance(half, end_of(frame, i))
    put(frame, i, OUTWARD, outward)


@kernel
def solve_box(contact: BoxContact, k: int, frame: Array, near: Candidates) -> float:
    """One pass over the contacts with one box; returns the depth of the deepest [m]."""
    half, deepest = row(contact.halves, k), 0.0
    w, friction, radius = contact.inv_mass, contact.friction[k], contact.radius
    particles, edges, faces = near.particles[k], near.edges[k], near.faces[k]
    for n in range(near.counts[k, 0]):
        i = particles[n]
        depth, normal = particle_depth(half, radius, frame, i)
        if depth > TOUCH and push(
            half, w, friction, frame, (i, i, i), (1.0, 0.0, 0.0), depth, normal
        ):
            deepest = max(deepest, depth)
    for n in range(near.counts[k, 1]):
        i, j = contact.edges[edges[n], 0], contact.edges[edges[n], 1]
        part, depth, normal = edge_depth(half, radius, frame, i, j)
        weights = (1.0 - part, part, 0.0)
        if depth > TOUCH and push(half, w, friction, frame, (i, j, j), weights, depth, normal):
            deepest = max(deepest, depth)
    for n in range(near.counts[k, 2]):
        face = face_of(contact, faces[n])
        for corner in range(8):
            weights, depth, normal = face_depth(half, radius, frame, face, corner)
            if depth > TOUCH and push(half, w, friction, frame, face, weights, depth, normal):
                deepest = max(deepest, depth)
    return deepest


@kernel
def face_of(contact: BoxContact, t: int) -> tuple[int, int, int]:
    """The particles of a face."""
    return contact.triangles[t, 0], contact.triangles[t, 1], contact.triangles[t, 2]


@kernel
def particle_depth(half: Vector, radius: float, frame: Array, i: int) -> tuple[float, Vector]:
    """How far [m] particle i must move along a direction to keep the radius; 0 or less: none."""
    d, normal = frame[i, DISTANCE], outward_of(frame, i)
    motion = subtract(end_of(frame, i), start_of(frame, i))
    if d * abs(d) < dot(motion, motion):
        # It may have passed through the box, or entered it: it stays on the side of its start.
        start = start_of(frame, i)
        d0, normal0 = cuboid_distance(half, start)
        if d0 > 0.0 and (d < 0.0 or passes(half, start, motion)):
            return radius - d0 - dot(normal0, motion), normal0
    return radius - d, normal


@kernel
def passes(half: Vector, start: Vector, motion: Vector) -> bool:
    """Whether a segment passes through a box: it lies between all three pairs of planes at once."""
    first, last = 0.0, 1.0
    first, last = clip(half[0], start[0], motion[0], first, last)
    first, last = clip(half[1], start[1], motion[1], first, last)
    first, last = clip(half[2], start[2], motion[2], first, last)
    return first < last


@kernel
def clip(
    half: float, start: float, motion: float, first: float, last: float
) -> tuple[float, float]:
    """The part from first to last of a motion that is between -half and half."""
    if motion == 0.0:
        return (first, last) if abs(start) < half else (1.0, 0.0)
    a, b = (-half - start) / motion, (half - start) / motion
    return max(first, min(a, b)), min(last, max(a, b))


@kernel
def edge_depth(
    half: Vector, radius: float, frame: Array, i: int, j: int
) -> tuple[float, float, Vector]:
    """The part of an edge from i to j at which it is nearest to the box, if that is inside the
    edge, the depth [m] to push it there, and the direction."""
    a, along = end_of(frame, i), subtract(end_of(frame, j), end_of(frame, i))
    none = (0.0, 0.0, UP)
    total = frame[i, DISTANCE] + frame[j, DISTANCE] - 2.0 * radius
    if total > 0.0 and total * total >= dot(along, along):
        return none
    fall, rise = dot(outward_of(frame, i), along), dot(outward_of(frame, j), along)
    if fall >= 0.0 or rise <= 0.0:
        return none
    part, d, normal = nearest_of_edge(
        half, radius, a, along, frame[i, DISTANCE], fall, frame[j, DISTANCE], rise
    )
    if not d < radius:
        return none
    if d < 0.0:
        # The edge has entered the box: it leaves on the side on which it was at the start.
        start = start_of(frame, i)
        along0 = subtract(start_of(frame, j), start)
        d0, normal0 = cuboid_distance(half, add_scaled(start, part, along0))
        if d0 > 0.0:
            motion = subtract(add_scaled(a, part, along), add_scaled(start, part, along0))
            return part, radius - d0 - dot(normal0, motion), normal0
    return part, radius - d, normal


@kernel
def nearest_of_edge(
    half: Vector,
    radius: float,
    a: Vector,
    along: Vector,
    d_low: float,
    fall: float,
    d_high: float,
    rise: float,
) -> tuple[float, float, Vector]:
    """The part of an edge at which the distance is least, that distance [m], and its direction.

    The search ends early where the tangents at both ends show that it is at least the radius.
    """
    low, high, flat = 0.0, 1.0, FLAT * norm(along)
    part, d, normal = 0.5, np.inf, UP
    for number in range(SEARCH):
        # The tangents at both ends meet where a convex function cannot be lower.
        meeting = (d_high - d_low + fall * low - rise * high) / (fall - rise)
        least = d_low + fall * (meeting - low)
        if least >= radius or d - least < NEAREST:
            break
        part = 0.5 * (low + high) if number % 2 else min(max(meeting, low), high)
        d, normal = cuboid_distance(half, add_scaled(a, part, along))
        slope = dot(normal, along)
        if abs(slope) <= flat:
            break
        if slope < 0.0:
            low, d_low, fall = part, d, slope
        else:
            high, d_high, rise = part, d, slope
    return part, d, normal


@kernel
def face_depth(
    half: Vector, radius: float, frame: Array, face: tuple[int, int, int], corner: int
) -> tuple[Vector, float, Vector]:
    """The weights of the point of a face that is nearest to a corner of the box, if it is inside
    the face, the depth [m] to push it there, and the direction."""
    point = (
        half[0] if corner & 1 else -half[0],
        half[1] if corner & 2 else -half[1],
        half[2] if corner & 4 else -half[2],
    )
    a, b, c = end_of(frame, face[0]), end_of(frame, face[1]), end_of(frame, face[2])
    low, high = lower(a, lower(b, c)), higher(a, higher(b, c))
    if not overlap(grown(low, -radius), grown(high, radius), point, point):
        return UP, 0.0, UP
    weights, foot = foot_on_face(a, b, c, point)
    if not (weights[0] > 0.0 and weights[1] > 0.0 and weights[2] > 0.0):
        return weights, 0.0, UP
    d, normal = cuboid_distance(half, foot)
    if d >= radius:
        return weights, 0.0, UP
    if d < 0.0:
        start = blend(frame, START, face, weights)
        d0, normal0 = cuboid_distance(half, start)
        if d0 > 0.0:
            return weights, radius - d0 - dot(normal0, subtract(foot, start)), normal0
    return weights, radius - d, normal


@kernel
def blend(frame: Array, first: int, face: tuple[int, int, int], weights: Vector) -> Vector:
    """The weighted sum of the places of three particles, at the start or the end of the step."""
    i, j, k = face
    return (
        weights[0] * frame[i, first] + weights[1] * frame[j, first] + weights[2] * frame[k, first],
        weights[0] * frame[i, first + 1]
        + weights[1] * frame[j, first + 1]
        + weights[2] * frame[k, first + 1],
        weights[0] * frame[i, first + 2]
        + weights[1] * frame[j, first + 2]
        + weights[2] * frame[k, first + 2],
    )


@kernel
def foot_on_face(a: Vector, b: Vector, c: Vector, p: Vector) -> tuple[Vector, Vector]:
    """Barycentric weights of the foot of p on the plane of a triangle, and the foot."""
    ab, ac, ap = subtract(b, a), subtract(c, a), subtract(p, a)
    bb, bc, cc = dot(ab, ab), dot(ab, ac), dot(ac, ac)
    pb, pc = dot(ap, ab), dot(ap, ac)
    area = bb * cc - bc * bc
    if area <= 0.0:
        return (-1.0, 0.0, 0.0), a
    v, w = (cc * pb - bc * pc) / area, (bb * pc - bc * pb) / area
    return (1.0 - v - w, v, w), add_scaled(add_scaled(a, v, ab), w, ac)


@kernel
def push(
    half: Vector,
    w: Array,
    friction: float,
    frame: Array,
    ends: tuple[int, int, int],
    weights: Vector,
    depth: float,
    normal: Vector,
) -> bool:
    """Move a point of the cloth by the depth [m] along the normal, with friction; returns whether
    it can be moved."""
    shares = (weights[0] * w[ends[0]], weights[1] * w[ends[1]], weights[2] * w[ends[2]])
    total = dot(shares, weights)
    if total == 0.0:
        return False
    motion = subtract(blend(frame, END, ends, weights), blend(frame, START, ends, weights))
    slide = add_scaled(motion, -dot(motion, normal), normal)
    length, held = norm(slide), friction * depth
    back = 1.0 if length <= held else held / length
    change = add_scaled(scale(depth, normal), -back, slide)
    shift(half, frame, ends[0], shares[0] / total, change)
    shift(half, frame, ends[1], shares[1] / total, change)
    shift(half, frame, ends[2], shares[2] / total, change)
    return True


@kernel
def shift(half: Vector, frame: Array, i: int, part: float, change: Vector) -> None:
    """Move particle i by a part of a change."""
    if part > 0.0:
        place = add_scaled(end_of(frame, i), min(part, AMPLIFIED), change)
        put(frame, i, END, place)
        measure(half, frame, i)
        frame[i, MOVED] = 1.0


@kernel
def guard_boxes(x0: Array, x: Array, contact: BoxContact, frame: Array, near: Candidates) -> None:
    """Return particles to their start until no part of the cloth is in a box."""
    for k in range(len(contact.halves)):
        if near.counts[k, 0] > 0:
            enter_frame(x0, x, contact, k, frame, near)
            for _ in range(GUARDS):
                if not return_some(contact, k, frame, near):
                    break
            leave_frame(x, contact, k, frame, near)


@kernel
def return_some(contact: BoxContact, k: int, frame: Array, near: Candidates) -> bool:
    """Return the particles of edges and faces that are inside the box; whether any was moved."""
    half, found = row(contact.halves, k), False
    for n in range(near.counts[k, 0]):
        i = near.particles[k, n]
        if frame[i, DISTANCE] < 0.0:
            found = to_start(half, contact.inv_mass, frame, i) or found
    for n in range(near.counts[k, 1]):
        i, j = contact.edges[near.edges[k, n], 0], contact.edges[near.edges[k, n], 1]
        _part, depth, _normal = edge_depth(half, 0.0, frame, i, j)
        if depth > 0.0:
            found = to_start(half, contact.inv_mass, frame, i) or found
            found = to_start(half, contact.inv_mass, frame, j) or found
    for n in range(near.counts[k, 2]):
        face = face_of(contact, near.faces[k, n])
        for corner in range(8):
            _weights, depth, _normal = face_depth(half, 0.0, frame, face, corner)
            if depth > 0.0:
                for i in face:
                    found = to_start(half, contact.inv_mass, frame, i) or found
    return found


@kernel
def to_start(half: Vector, w: Array, frame: Array, i: int) -> bool:
    """Return a free particle to its start; whether that moved it."""
    start, end = start_of(frame, i), end_of(frame, i)
    same = start[0] == end[0] and start[1] == end[1] and start[2] == end[2]
    if w[i] == 0.0 or same:
        return False
    put(frame, i, END, start)
    measure(half, frame, i)
    frame[i, MOVED] = 1.0
    return True
