"""From shapes to signed distance fields, and the one door to all distances."""

from functools import singledispatch

import numpy as np

from drapery.cloth.colliders.blocks import blocks_distance
from drapery.cloth.colliders.fields import BLOCKS, BOX, CAPSULE, PLANE, SPHERE, Field
from drapery.cloth.colliders.primitives import (
    box_distance,
    capsule_distance,
    plane_distance,
    sphere_distance,
)
from drapery.cloth.colliders.shapes import Box, Capsule, Plane, Shape, Sphere, TriangleMesh, Voxels
from drapery.cloth.colliders.surfaces import pack_surface, surface_distance
from drapery.cloth.colliders.vectors import Vector, scale, subtract
from drapery.errors import OptionError
from drapery.jit import entry_point


@entry_point
def distance(field: Field, p: Vector, limit: float) -> tuple[float, Vector]:
    """Signed distance [m] and outward unit direction at p, in the shape's frame.

    Exact below `limit` [m]; above it any number of at least `limit` or a lower bound.
    """
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


@singledispatch
def pack(shape: Shape) -> Field:
    """A shape as the kernels read it."""
    raise OptionError(f"collider {type(shape).__name__}: give one of the shapes of this package")


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
    reach = np.abs(rotation) @ half
    numbers = np.concatenate([centre, half, rotation.ravel()])
    return Field(BOX, numbers, np.stack([centre - reach, centre + reach]), float(half.min()))


@pack.register
def _(shape: Plane) -> Field:
    normal = np.asarray(shape.normal, float)
    numbers = np.concatenate([np.asarray(shape.point, float), normal / np.linalg.norm(normal)])
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
