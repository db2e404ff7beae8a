"""One point against one shape over one step: the time of impact and the response.

All of it is computed in the shape's frame, in which the shape rests. The point moves there along
the straight line from its position at the start of the step to its position at the end. So the
motion of a collider counts as motion of the point. (If a collider rotates, the true path is curved;
the error is of second order in the angle of the rotation in a step.)

The time of impact is found by conservative advancement (Mirtich 1996; on distance fields also known
as sphere tracing, Hart 1996): a point may advance by its distance to the shape without crossing the
surface. So even very thin features are found. Between two samples the distance of the point from
the surface stays at least half the radius. A convex shape allows longer advances: its distance is a
convex function along a line, and the slopes at both ends of an advance bound it from below.
"""

from typing import NamedTuple

import numpy as np

from drapery.cloth.colliders.fields import Field
from drapery.cloth.colliders.packing import distance, outward
from drapery.cloth.colliders.vectors import (
    Vector,
    add,
    add_scaled,
    dot,
    norm,
    rotated,
    rotated_back,
    scale,
    subtract,
)
from drapery.jit import kernel
from drapery.mesh import Array

TOUCH = 1e-9
"""Distances [m] that count as 0: far above rounding at 1000 m, far below a picture's pixel."""
CLOSE = 1e-7
"""Tolerance [m] of the search for the time of impact."""
FINEST = 1e-6
"""The least advance [m] of a point that starts on the surface."""
MAX_ADVANCES = 1 << 14
"""Most advances in one motion; a point that needs more stops there until the next step."""
MAX_TOUCHES = 4
"""Most contacts in one step: floor, wall, second wall, and one more. Then the point stops."""
MAX_PUSHES = 8
MISSED, TOUCHED, BOUNCED = range(3)
RESTITUTION_THRESHOLD = 0.25
"""Approach speed [m/s] below which nothing bounces: more than gravity adds in a step of 1/60 s."""


class RigidSweep(NamedTuple):
    """A shape's pose at the start and the end of a step: positions [m], rotations [3, 3]."""

    position0: Array
    rotation0: Array
    position1: Array
    rotation1: Array


class ContactParams(NamedTuple):
    """Parameters of a contact: distance kept [m], restitution, Coulomb friction."""

    radius: float
    restitution: float
    friction: float


@kernel
def into_frame(position: Array, rotation: Array, p: Vector) -> Vector:
    return rotated_back(rotation, subtract(p, (position[0], position[1], position[2])))


@kernel
def out_of_frame(position: Array, rotation: Array, p: Vector) -> Vector:
    return add(rotated(rotation, p), (position[0], position[1], position[2]))


@kernel
def surface_velocity(sweep: RigidSweep, p: Vector, dt: float) -> Vector:
    """Velocity [m/s] in the world of the shape's point p."""
    start = out_of_frame(sweep.position0, sweep.rotation0, p)
    return scale(1 / dt, subtract(out_of_frame(sweep.position1, sweep.rotation1, p), start))


@kernel
def boxes_apart(field: Field, a: Vector, b: Vector, radius: float) -> bool:
    """Whether the segment's box and the shape's box are further apart than the radius."""
    for axis in range(3):
        if max(a[axis], b[axis]) < field.bounds[0, axis] - radius:
            return True
        if min(a[axis], b[axis]) > field.bounds[1, axis] + radius:
            return True
    return False


@kernel
def time_of_impact(field: Field, p: Vector, motion: Vector, radius: float) -> tuple[float, Vector]:
    """The part of `motion` after which p comes nearer than `radius`, and the normal there.

    2 when it never does, NaN where the distance is NaN. A point that starts nearer than `radius`
    is stopped only if it approaches the surface.
    """
    length = norm(motion)
    if length == 0.0:
        return 2.0, (0.0, 1.0, 0.0)
    limit = length + 2 * radius
    gap, normal = distance(field, p, limit)
    gap -= radius
    if np.isnan(gap):
        return gap, normal
    part = 0.0
    for _ in range(MAX_ADVANCES):
        ahead = min(part + advance(field, gap, radius) / length, 1.0)
        ahead_gap, ahead_normal = distance(field, add_scaled(p, ahead, motion), limit)
        ahead_gap -= radius
        if np.isnan(ahead_gap):
            return ahead_gap, normal
        if ahead_gap < min(gap, 0.0) - TOUCH:
            return refine_impact(field, p, motion, radius, part, gap, normal, ahead, ahead_gap)
        if field.inradius > 0.0:
            fall, rise = dot(normal, motion), dot(ahead_normal, motion)
            least = least_between(gap, fall, ahead_gap, rise, ahead - part)
            if least < min(gap, 0.0) - radius / 2:
                touch, there = descend(field, p, motion, radius, part, gap, normal, ahead)
                if touch < ahead:
                    return touch, there
        part, gap, normal = ahead, ahead_gap, ahead_normal
        if part == 1.0:
            return 2.0, normal
    return part, normal


@kernel
def advance(field: Field, gap: float, radius: float) -> float:
    """A length [m] that a point may move before the distance must be evaluated again."""
    if field.inradius > 0.0:
        return max(gap, radius, field.inradius / 8)
    if gap >= 0.0:
        return max(gap, radius)
    return max(abs(gap + radius), FINEST)


@kernel
def least_between(start: float, slope: float, end: float, end_slope: float, width: float) -> float:
    """A lower bound of a convex function over an interval, from its values and slopes at the ends:
    the value where the two tangents cross."""
    if slope >= 0.0 or end_slope <= 0.0:
        return min(start, end)
    product = slope * end_slope * width
    return (start * end_slope - end * slope + product) / (end_slope - slope)


@kernel
def descend(
    field: Field,
    p: Vector,
    motion: Vector,
    radius: float,
    part: float,
    gap: float,
    normal: Vector,
    end: float,
) -> tuple[float, Vector]:
    """The first moment from `part` to `end` at which a convex shape is as near as the radius, by
    Newton's method, which cannot pass it; 2 if there is none."""
    limit = norm(motion) + 2 * radius
    for _ in range(64):
        slope = dot(normal, motion)
        if slope >= 0.0 or part >= end:
            return 2.0, normal
        if gap < CLOSE:
            break
        part -= gap / slope
        gap, normal = distance(field, add_scaled(p, part, motion), limit)
        gap -= radius
    return part, normal


@kernel
def refine_impact(
    field: Field,
    p: Vector,
    motion: Vector,
    radius: float,
    low: float,
    gap: float,
    normal: Vector,
    high: float,
    depth: float,
) -> tuple[float, Vector]:
    """The last moment outside, between `low` (gap above 0) and `high` (depth below 0): false
    position, halved where it stalls (the Illinois rule)."""
    limit = norm(motion) + 2 * radius
    outside = gap
    for _ in range(40):
        if outside < CLOSE:
            break
        middle = low + (high - low) * gap / (gap - depth)
        d, n = distance(field, add_scaled(p, middle, motion), limit)
        d -= radius
        if d >= -TOUCH:
            low, outside, normal, gap = middle, d, n, d
            depth *= 0.5
        else:
            high, depth = middle, d
            gap *= 0.5
    return low, normal


@kernel
def apply_friction(along_surface: Vector, limit: float) -> Vector:
    """The tangential vector after Coulomb friction: shortened by `limit`, at least 0."""
    length = norm(along_surface)
    if length <= limit:
        return 0.0, 0.0, 0.0
    return scale(1 - limit / length, along_surface)


@kernel
def respond(v: Vector, normal: Vector, restitution: float, friction: float) -> Vector:
    """A velocity or motion after a contact; one that leaves the surface does not change."""
    into = -dot(v, normal)
    if into <= 0:
        return v
    tangent = add_scaled(v, into, normal)
    left = apply_friction(tangent, friction * (1 + restitution) * into)
    return add_scaled(left, restitution * into, normal)


@kernel
def sweep_point(
    field: Field,
    sweep: RigidSweep,
    contact: ContactParams,
    start: Vector,
    end: Vector,
    velocity: Vector,
    dt: float,
) -> tuple[int, Vector, Vector]:
    """Whether a point that moves from start to end [m] is MISSED, TOUCHED or BOUNCED; its new end,
    and its velocity after the impact [m/s]."""
    p = into_frame(sweep.position0, sweep.rotation0, start)
    goal = into_frame(sweep.position1, sweep.rotation1, end)
    if boxes_apart(field, p, goal, contact.radius):
        return MISSED, end, velocity
    touch, v = MISSED, velocity
    motion = subtract(goal, p)
    for _ in range(MAX_TOUCHES):
        part, normal = time_of_impact(field, p, motion, contact.radius)
        if part > 1.0:
            p = add(p, motion)
            break
        p = add_scaled(p, part, motion)
        normal = outward(field, p, normal)
        v, bounce = impact_velocity(sweep, contact, p, normal, v, dt)
        touch = max(touch, BOUNCED if bounce > 0 else TOUCHED)
        motion = respond(scale(1 - part, motion), normal, bounce, contact.friction)
    pushed, p, v = push_out(field, sweep, contact, p, v, dt)
    if touch == MISSED and not pushed:
        return MISSED, end, velocity
    return max(touch, TOUCHED), out_of_frame(sweep.position1, sweep.rotation1, p), v


@kernel
def impact_velocity(
    sweep: RigidSweep,
    contact: ContactParams,
    p: Vector,
    normal: Vector,
    velocity: Vector,
    dt: float,
) -> tuple[Vector, float]:
    """The velocity after a contact at p, and the restitution that applied."""
    direction = rotated(sweep.rotation1, normal)
    carried = surface_velocity(sweep, p, dt)
    relative = subtract(velocity, carried)
    bounce = contact.restitution if -dot(relative, direction) > RESTITUTION_THRESHOLD else 0.0
    return add(carried, respond(relative, direction, bounce, contact.friction)), bounce


@kernel
def push_out(
    field: Field, sweep: RigidSweep, contact: ContactParams, p: Vector, velocity: Vector, dt: float
) -> tuple[bool, Vector, Vector]:
    """Move a point out that is still too near (it began inside, or stopped in a corner)."""
    pushed = False
    for _ in range(MAX_PUSHES):
        d, normal = distance(field, p, 2 * contact.radius)
        if d >= contact.radius:
            break
        normal = outward(field, p, normal)
        p = add_scaled(p, clear_push(field, p, d, normal, contact.radius), normal)
        velocity, _bounce = impact_velocity(sweep, contact, p, normal, velocity, dt)
        pushed = pushed or d < contact.radius - TOUCH
    return pushed, p, velocity


@kernel
def clear_push(field: Field, p: Vector, d: float, normal: Vector, radius: float) -> float:
    """How far [m] to push a point at distance d out along the normal: to the radius, or less if the
    push might cross an opposite surface."""
    push = radius - d
    while push > max(abs(d), FINEST):
        there, _normal = distance(field, add_scaled(p, push, normal), 2 * radius)
        if push <= abs(d) + abs(there) + TOUCH:
            break
        push *= 0.5
    return push
