"""Vectors as tuples of three floats, which the compiler keeps in registers inside a kernel."""

import numpy as np

from drapery.jit import borrowing_kernel
from drapery.mesh import Array

Vector = tuple[float, float, float]


@borrowing_kernel
def add(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@borrowing_kernel
def subtract(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@borrowing_kernel
def scale(s: float, a: Vector) -> Vector:
    return s * a[0], s * a[1], s * a[2]


@borrowing_kernel
def add_scaled(a: Vector, s: float, b: Vector) -> Vector:
    """a + s b."""
    return a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]


@borrowing_kernel
def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@borrowing_kernel
def cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@borrowing_kernel
def norm(a: Vector) -> float:
    return float(np.sqrt(dot(a, a)))


@borrowing_kernel
def unit(a: Vector, length: float) -> Vector:
    """a / length, or (0, 1, 0) where a has no direction."""
    if length > 1e-300:
        return a[0] / length, a[1] / length, a[2] / length
    return 0.0, 1.0, 0.0


@borrowing_kernel
def row(rows: Array, i: int) -> Vector:
    """Row i of an array [..., 3] as a vector."""
    return rows[i, 0], rows[i, 1], rows[i, 2]


@borrowing_kernel
def rotated(rotation: Array, a: Vector) -> Vector:
    """R a, for a matrix R of shape [3, 3]."""
    return dot(row(rotation, 0), a), dot(row(rotation, 1), a), dot(row(rotation, 2), a)


@borrowing_kernel
def rotated_back(rotation: Array, a: Vector) -> Vector:
    """R^T a: the inverse of `rotated` for a rotation."""
    x = scale(a[0], row(rotation, 0))
    return add_scaled(add_scaled(x, a[1], row(rotation, 1)), a[2], row(rotation, 2))
