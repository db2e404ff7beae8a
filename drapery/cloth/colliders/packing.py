"""From shapes to signed distance fields, and the one function for the distance to any of them."""

from functools import singledispatch

import numpy as np

from drapery.cloth.colliders.blocks import blocks_distance
from drapery.cloth.colliders.fields import (
    BLOCKS,
    BOX,
    CAPSULE,
    PLANE,
    SPHERE,
    USER_DEFINED,
    Field,
)
from drapery.cloth.colliders.primitives import (
    box_distance,
    capsule_distance,
    plane_distance,
    sphere_distance,
)
from drapery.cloth.colliders.shapes import Box, Capsule, Plane, Shape, Sphere, TriangleMesh, Voxels
from drapery.cloth.colliders.surfaces import pack_surface, surface_distance
from drapery.cloth.colliders.user_defined import (
    call_distance,
    call_gradient,
    is_user_defined,
    pack_user_defined,
)
from drapery.cloth.colliders.vectors import Vector, add, norm, scale, subtract, unit
from drapery.errors import OptionError
from drapery.jit import entry_point, kernel

UP = (0.0, 1.0, 0.0)
DIFFERENCE = 1e-5
"""Half the width [m] of a central difference: truncation and rounding errors are about equal."""


@entry_point
def distance(field: Field, p: Vector, limit: float) -> tuple[float, Vector]:
    """Signed distance [m] and outward unit direction at p, in the shape's frame.

    Exact below `limit` [m]; above it any number of at least `limit` or a lower bound. The
    direction of user-defined shapes comes from `outward`, which evaluates more distances.
    """
    if field.kind == USER_DEFINED:
        return call_distance(field.distance_address, p[0], p[1], p[2], field.numbers), UP
    if field.kind == SPHERE:
        return sphere_distance(field.numbers, p)
    if field.kind == CAPSULE:
        return capsule_distance(field.numbers, p)
    if field.kind == BOX:
        return box_distance(field.numbers, p)
    if field.kind == PLANE:
        return plane_distance(field.numbers, p)
    if field.kind == BLOCKS:
        size, corner = field.numbers[0], (field.numbers[1], field.numbers[2], field.numbers[3])
        d, normal = blocks_distance(field.filled, scale(1 / size, subtract(p, corner)))
        return size * d, normal
    return surface_distance(field, p, limit)


@kernel
def outward(field: Field, p: Vector, direction: Vector) -> Vector:
    """The outward unit direction at p, where `distance` gave `direction`: a user-defined shape's
    own gradient, or central differences."""
    if field.kind != USER_DEFINED:
        return direction
    if field.gradient_address != 0:
        result = np.empty(3)
        call_gradient(field.gradient_address, p[0], p[1], p[2], field.numbers, result)
        gradient = (result[0], result[1], result[2])
    else:
        gradient = (
            _difference(field, p, (DIFFERENCE, 0.0, 0.0)),
            _difference(field, p, (0.0, DIFFERENCE, 0.0)),
            _difference(field, p, (0.0, 0.0, DIFFERENCE)),
        )
    return unit(gradient, norm(gradient))


@kernel
def _difference(field: Field, p: Vector, step: Vector) -> float:
    there, _there = distance(field, add(p, step), 0.0)
    back, _back = distance(field, subtract(p, step), 0.0)
    return there - back


@singledispatch
def pack(shape: Shape) -> Field:
    """A shape as the kernels read it."""
    if is_user_defined(shape):
        return pack_user_defined(shape)
    raise OptionError(
        f"collider {type(shape).__name__} has no signed_distance; give one of the built-in shapes "
        "or an object as SignedDistance describes it"
    )


@pack.register
def _(shape: Sphere) -> Field:
    centre = np.asarray(shape.centre, float)
    bounds = np.stack([centre - shape.radius, centre + shape.radius])
    return Field(SPHERE, np.append(centre, shape.radius), bounds, shape.radius)


@pack.register
def _(shape: Capsule) -> Field:
    ends = np.stack([np.asarray(shape.start, float), np.asarray(shape.end, float)])
    bounds = np.stack([ends.min(axis=0) - shape.radius, ends.max(axis=0) + shape.radius])
    return Field(CAPSULE, np.append(ends.ravel(), shape.radius), bounds, shape.radius)


@pack.register
def _(shape: Box) -> Field:
    centre, half = np.asarray(shape.centre, float), np.asarray(shape.size, float) / 2
    rotation = np.asarray(shape.rotation, float)
    extent = (np.abs(rotation) * half).sum(axis=1)
    numbers = np.concatenate([centre, half, rotation.ravel()])
    return Field(BOX, numbers, np.stack([centre - extent, centre + extent]), float(half.min()))


@pack.register
def _(shape: Plane) -> Field:
    normal = np.asarray(shape.normal, float)
    numbers = np.concatenate(
        [np.asarray(shape.point, float), normal / np.sqrt(np.square(normal).sum())]
    )
    return Field(PLANE, numbers, np.array([[-np.inf] * 3, [np.inf] * 3]), np.inf)


@pack.register
def _(shape: Voxels) -> Field:
    cells = np.asarray(shape.cells, np.int64)
    low, high = cells.min(axis=0), cells.max(axis=0) + 1
    filled = np.zeros(high - low, np.uint8)
    filled[tuple((cells - low).T)] = 1
    bounds = np.stack([low, high]) * float(shape.size)
    numbers = np.append(shape.size, bounds[0])
    return Field(BLOCKS, numbers, bounds, 0.0, filled=filled)


@pack.register
def _(shape: TriangleMesh) -> Field:
    return pack_surface(shape)
