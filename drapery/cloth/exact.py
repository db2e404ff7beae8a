"""Elementary functions with the same bits on every machine.

The C library's sine and LAPACK's kernels differ between processors in the last bit. These functions
use only IEEE additions, multiplications and divisions in a fixed order.
"""

from math import copysign, floor, pi
from typing import Any

import numpy as np

from drapery.mesh import Array


def sine_of_turns(turns: Any) -> Any:
    """sin(2π turns) of a number or an array, by its Taylor series, with an error below 1e-12."""
    part = turns - np.floor(turns + 0.5)
    part = np.sign(part) * (0.25 - abs(abs(part) - 0.25))
    angle = 2 * np.pi * part
    square = angle * angle
    term = angle
    total = angle
    for n in range(2, 20, 2):
        term = -term * square / (n * (n + 1))
        total = total + term
    return total


def sine_of_turn(turns: float) -> float:
    """The bits of `sine_of_turns` for one number, in a quarter of the time."""
    part = turns - floor(turns + 0.5)
    part = copysign(0.25 - abs(abs(part) - 0.25), part)
    angle = 2 * pi * part
    square = angle * angle
    term = total = angle
    for n in range(2, 20, 2):
        term = -term * square / (n * (n + 1))
        total = total + term
    return total


def inverse(A: Array) -> Array:
    """Inverse of a diagonally dominant matrix [N, N], by Gauss-Jordan without pivoting."""
    A = A.astype(np.float64)
    B = np.eye(len(A))
    for pivot in range(len(A)):
        B[pivot] /= A[pivot, pivot]
        A[pivot] /= A[pivot, pivot]
        factors = A[:, pivot].copy()
        factors[pivot] = 0.0
        B -= factors[:, None] * B[pivot]
        A -= factors[:, None] * A[pivot]
    return B
