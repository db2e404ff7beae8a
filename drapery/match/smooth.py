"""Smooth functions over a face, and their fit by least squares, with sums in a fixed order."""

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]


def products(u: Reals, v: Reals, across: int, down: int) -> Reals:
    """Products of Chebyshev polynomials at places of the unit square, [K, ...].

    across, down: the highest orders along the two sides; K = (across + 1) (down + 1), the order
    across changes fastest.
    """
    along_u, along_v = _chebyshev(2 * u - 1, across), _chebyshev(2 * v - 1, down)
    return np.stack([second * first for second in along_v for first in along_u])


def orders(across: int, down: int) -> tuple[Reals, Reals]:
    """The orders across and down of each of the `products`, [K] each."""
    second, first = np.divmod(np.arange((across + 1) * (down + 1)), across + 1)
    return first.astype(np.float64), second.astype(np.float64)


def row_sums(rows: Reals, factors: Reals) -> Reals:
    """The products of rows [K, n] with factors [n], [K]."""
    return np.asarray((rows * factors).sum(axis=1))


def least_squares(rows: Reals, goal: Reals, weights: Reals, stiffness: Reals) -> Reals:
    """The factors [K] of rows [K, n] whose sum is nearest to a goal [n].

    weights: of the squares of differences, [n]. stiffness: of the squares of factors, [K].
    """
    matrix = np.diag(stiffness)
    weighted = rows * weights
    for number, row in enumerate(rows):
        # The matrix is symmetric.
        matrix[number, number:] += row_sums(weighted[number:], row)
        matrix[number:, number] = matrix[number, number:]
    return _solved(matrix, row_sums(weighted, goal))


def _chebyshev(x: Reals, highest: int) -> list[Reals]:
    rows = [np.ones_like(x), x]
    while len(rows) <= highest:
        rows.append(2 * x * rows[-1] - rows[-2])
    return rows[: highest + 1]


def _solved(matrix: Reals, right: Reals) -> Reals:
    """The solution of a positive definite system, by Gaussian elimination."""
    rows = np.concatenate([matrix, right[:, None]], axis=1)
    for pivot in range(len(right)):
        rows[pivot] /= rows[pivot, pivot]
        factors = rows[:, pivot].copy()
        factors[pivot] = 0
        rows -= factors[:, None] * rows[pivot]
    return rows[:, -1]
