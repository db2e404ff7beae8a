"""Signed distance and outward direction of spheres, capsules, planes and boxes.

Each kernel takes the shape's numbers and a point in the shape's frame, and gives the distance [m],
negative inside, and the unit direction in which it grows fastest.
"""

from drapery.cloth.colliders.vectors import (
    Vector,
    add_scaled,
    dot,
    norm,
    rotated,
    rotated_back,
    subtract,
    unit,
)
from drapery.jit import kernel
from drapery.mesh import Array


@kernel
def sphere_distance(numbers: Array, p: Vector) -> tuple[float, Vector]:
    """numbers: centre, radius."""
    offset = subtract(p, (numbers[0], numbers[1], numbers[2]))
    length = norm(offset)
    return length - numbers[3], unit(offset, length)


@kernel
def capsule_distance(numbers: Array, p: Vector) -> tuple[float, Vector]:
    """numbers: start, end, radius."""
    start = (numbers[0], numbers[1], numbers[2])
    axis = subtract((numbers[3], numbers[4], numbers[5]), start)
    square = dot(axis, axis)
    part = dot(subtract(p, start), axis) / square if square > 0 else 0.0
    offset = subtract(p, add_scaled(start, min(max(part, 0.0), 1.0), axis))
    length = norm(offset)
    if length > 1e-300:
        return length - numbers[6], unit(offset, length)
    return -numbers[6], _across(axis)


@kernel
def _across(axis: Vector) -> Vector:
    """A unit vector at a right angle to the axis, for points on the axis."""
    x, y, z = axis
    side = (-y, x, 0.0) if abs(x) + abs(y) > abs(z) * 1e-6 else (1.0, 0.0, 0.0)
    return unit(side, norm(side))


@kernel
def plane_distance(numbers: Array, p: Vector) -> tuple[float, Vector]:
    """numbers: point, unit normal."""
    normal = (numbers[3], numbers[4], numbers[5])
    return dot(subtract(p, (numbers[0], numbers[1], numbers[2])), normal), normal


@kernel
def box_distance(numbers: Array, p: Vector) -> tuple[float, Vector]:
    """numbers: centre, half edge lengths, rotation row by row."""
    rotation = numbers[6:15].reshape(3, 3)
    local = rotated_back(rotation, subtract(p, (numbers[0], numbers[1], numbers[2])))
    distance, normal = cuboid_distance((numbers[3], numbers[4], numbers[5]), local)
    return distance, rotated(rotation, normal)


@kernel
def cuboid_distance(half: Vector, p: Vector) -> tuple[float, Vector]:
    """An upright box about the origin. Outside: the nearest point. Inside: the nearest face."""
    closest = (
        min(max(p[0], -half[0]), half[0]),
        min(max(p[1], -half[1]), half[1]),
        min(max(p[2], -half[2]), half[2]),
    )
    offset = subtract(p, closest)
    length = norm(offset)
    if length > 0:
        return length, unit(offset, length)
    return _nearest_face(half, p)


@kernel
def _nearest_face(half: Vector, p: Vector) -> tuple[float, Vector]:
    x, y, z = abs(p[0]) - half[0], abs(p[1]) - half[1], abs(p[2]) - half[2]
    if y >= x and y >= z:
        return y, (0.0, 1.0 if p[1] >= 0 else -1.0, 0.0)
    if x >= z:
        return x, (1.0 if p[0] >= 0 else -1.0, 0.0, 0.0)
    return z, (0.0, 0.0, 1.0 if p[2] >= 0 else -1.0)
