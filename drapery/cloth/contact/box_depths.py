"""How deep particles, edges and faces of a cloth are in a box, in the frame of the box.

A box is convex, so its signed distance is convex too. Along an edge of the cloth the distance
therefore has one minimum, which lies inside the edge only if the distance falls at its start and
rises at its end. Particles, edges and corners of the box against faces are tested, which are all
features of two bodies that can touch first (Ericson, "Real-Time Collision Detection", 2005,
section 5.1).
"""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.primitives import cuboid_distance
from drapery.cloth.colliders.vectors import Vector, add_scaled, dot, norm, subtract
from drapery.cloth.contact.box_frame import DISTANCE, START, blend, end_of, outward_of, start_of
from drapery.cloth.contact.geometry import UP, grown, higher, lower, overlap
from drapery.jit import borrowing_kernel
from drapery.mesh import Array

SEARCH = 16
"""The most steps of the search for the nearest point of an edge."""
FLAT, NEAREST = 1e-4, 1e-4
"""That search ends where the slope of the distance is less, and where it cannot find a distance
that is less by more than this [m]."""
CLEAR = 1.000001
"""More than the error of a squared distance, in proportion."""
HELD = 0.9
"""What is fastened to a pin near a box keeps this part of the pin's distance."""


@borrowing_kernel
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


@borrowing_kernel
def edge_radius(w: Array, radius: float, frame: Array, i: int, j: int) -> float:
    """The distance [m] that an edge can keep: less than the radius where a pin holds it nearer, and
    below 0 where a pin is inside the box."""
    return min(particle_radius(w, radius, frame, i), particle_radius(w, radius, frame, j))


@borrowing_kernel
def face_radius(
    half: Vector, w: Array, radius: float, frame: Array, face: tuple[int, int, int]
) -> float:
    """The same for a face, of which two particles may be pinned."""
    i, j, k = face
    kept = min(edge_radius(w, radius, frame, i, j), particle_radius(w, radius, frame, k))
    for a, b in ((i, j), (j, k), (k, i)):
        if w[a] == 0.0 and w[b] == 0.0:
            _part, depth, _normal = edge_depth(half, radius, frame, a, b)
            if depth > 0.001 * radius:
                kept = min(kept, HELD * (radius - depth))
    return kept


@borrowing_kernel
def particle_radius(w: Array, radius: float, frame: Array, i: int) -> float:
    """The same for what is close to a particle."""
    d = frame[i, DISTANCE]
    return HELD * d if w[i] == 0.0 and d < 0.999 * radius else radius


@borrowing_kernel
def depth_at_pin(
    half: Vector,
    radius: float,
    frame: Array,
    ends: tuple[int, int, int],
    weights: Vector,
    depth: float,
) -> float:
    """The depth [m] that a point of an edge or a face with a pin is pushed: to its distance at the
    start of the step, if that is less than the radius that gave the depth.

    Farther out it would take the free ends along by a multiple of the depth, which tears the cells
    beside the pin: an edge that leaves a pin beside the end of a box may pass nearer to the box
    than the pin.
    """
    d0, _normal = cuboid_distance(half, blend(frame, START, ends, weights))
    return depth - max(0.0, radius - max(0.0, d0))


@borrowing_kernel
def passes(half: Vector, start: Vector, motion: Vector) -> bool:
    """Whether a segment passes through a box: it lies between all three pairs of planes at once."""
    first, last = 0.0, 1.0
    first, last = clip(half[0], start[0], motion[0], first, last)
    first, last = clip(half[1], start[1], motion[1], first, last)
    first, last = clip(half[2], start[2], motion[2], first, last)
    return first < last


@borrowing_kernel
def clip(
    half: float, start: float, motion: float, first: float, last: float
) -> tuple[float, float]:
    """The part from first to last of a motion that is between -half and half."""
    if motion == 0.0:
        return (first, last) if abs(start) < half else (1.0, 0.0)
    a, b = (-half - start) / motion, (half - start) / motion
    return max(first, min(a, b)), min(last, max(a, b))


@borrowing_kernel
def edge_depth(
    half: Vector, radius: float, frame: Array, i: int, j: int
) -> tuple[float, float, Vector]:
    """The part of an edge from i to j at which it is nearest to the box, if that is inside the
    edge, the depth [m] to push it there, and the direction. A radius below 0 is never kept."""
    a, along = end_of(frame, i), subtract(end_of(frame, j), end_of(frame, i))
    none = (0.0, 0.0, UP)
    if radius < 0.0:
        return none
    total = frame[i, DISTANCE] + frame[j, DISTANCE] - 2.0 * radius
    if total > 0.0 and total * total >= dot(along, along):
        return none
    fall, rise = dot(outward_of(frame, i), along), dot(outward_of(frame, j), along)
    if fall >= 0.0 or rise <= 0.0 or passes_by(half, radius, a, along):
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


@borrowing_kernel
def passes_by(half: Vector, radius: float, a: Vector, along: Vector) -> bool:
    """Whether the line of an edge, seen along an edge of the box, keeps the radius from the box.

    This is the test for separating axes of two edges (Ericson 2005, section 5.2.1). It needs no
    roots and no divisions, and most edges that touch nothing pass it.
    """
    return (
        line_passes_by(half[1], half[2], radius, a[1], a[2], along[1], along[2])
        or line_passes_by(half[2], half[0], radius, a[2], a[0], along[2], along[0])
        or line_passes_by(half[0], half[1], radius, a[0], a[1], along[0], along[1])
    )


@borrowing_kernel
def line_passes_by(
    half: float, half1: float, radius: float, p: float, p1: float, u: float, u1: float
) -> bool:
    """Whether the line through (p, p1) along (u, u1) keeps the radius from an upright rectangle."""
    gap = abs(u * p1 - u1 * p) - abs(u1) * half - abs(u) * half1
    return gap > 0.0 and gap * gap > CLEAR * radius * radius * (u * u + u1 * u1)


@borrowing_kernel
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


@borrowing_kernel
def corner_of(half: Vector, number: int) -> Vector:
    """Corner number 0 to 7 of a box."""
    return (
        half[0] if number & 1 else -half[0],
        half[1] if number & 2 else -half[1],
        half[2] if number & 4 else -half[2],
    )


@borrowing_kernel
def near_face(frame: Array, face: tuple[int, int, int], radius: float, corner: Vector) -> bool:
    """Whether a corner of the box is within the radius of a face's bounds; a radius below 0 is
    never kept."""
    if radius < 0.0:
        return False
    a, b, c = end_of(frame, face[0]), end_of(frame, face[1]), end_of(frame, face[2])
    low, high = lower(a, lower(b, c)), higher(a, higher(b, c))
    return overlap(grown(low, -radius), grown(high, radius), corner, corner)


@borrowing_kernel
def face_depth(
    half: Vector, radius: float, frame: Array, face: tuple[int, int, int], corner: Vector
) -> tuple[Vector, float, Vector]:
    """The weights of the point of a face that is nearest to a corner of the box, if it is inside
    the face, the depth [m] to push it there, and the direction."""
    a, b, c = end_of(frame, face[0]), end_of(frame, face[1]), end_of(frame, face[2])
    weights, foot = foot_on_face(a, b, c, corner)
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


@borrowing_kernel
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


@borrowing_kernel
def face_of(triangles: NDArray[np.int32], t: int) -> tuple[int, int, int]:
    """The particles of a face."""
    return triangles[t, 0], triangles[t, 1], triangles[t, 2]
