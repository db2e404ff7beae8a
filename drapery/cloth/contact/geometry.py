"""Bounds and vectors of the contact kernels."""

from drapery.cloth.colliders.vectors import Vector, row
from drapery.jit import borrowing_kernel
from drapery.mesh import Array

UP = (0.0, 1.0, 0.0)


@borrowing_kernel
def put(rows: Array, i: int, first: int, values: Vector) -> None:
    """Set three numbers of row i, from number `first` on."""
    rows[i, first], rows[i, first + 1], rows[i, first + 2] = values


@borrowing_kernel
def read(rows: Array, i: int, first: int) -> Vector:
    """Three numbers of row i, from number `first` on."""
    return rows[i, first], rows[i, first + 1], rows[i, first + 2]


@borrowing_kernel
def lower(a: Vector, b: Vector) -> Vector:
    """The lower of each pair of coordinates."""
    return min(a[0], b[0]), min(a[1], b[1]), min(a[2], b[2])


@borrowing_kernel
def higher(a: Vector, b: Vector) -> Vector:
    """The higher of each pair of coordinates."""
    return max(a[0], b[0]), max(a[1], b[1]), max(a[2], b[2])


@borrowing_kernel
def grown(a: Vector, length: float) -> Vector:
    """All coordinates and the same length."""
    return a[0] + length, a[1] + length, a[2] + length


@borrowing_kernel
def overlap(low: Vector, high: Vector, first: Vector, last: Vector) -> bool:
    """Whether two upright boxes have a common point."""
    # Which comparison fails first cannot be predicted, so no branch depends on one of them.
    x = (low[0] <= last[0]) & (high[0] >= first[0])
    y = (low[1] <= last[1]) & (high[1] >= first[1])
    z = (low[2] <= last[2]) & (high[2] >= first[2])
    return x & y & z


@borrowing_kernel
def bounds_of(x0: Array, x: Array, first: int, last: int) -> tuple[Vector, Vector]:
    """The least box about the places of particles first..last at the start and the end of a
    step."""
    low, high = row(x, first), row(x, first)
    for i in range(first, last):
        a, b = row(x0, i), row(x, i)
        low, high = lower(low, lower(a, b)), higher(high, higher(a, b))
    return low, high


@borrowing_kernel
def has_end(low: float, high: float, half: float) -> bool:
    """Whether -half or half lies between two numbers."""
    return low < half < high or low < -half < high
