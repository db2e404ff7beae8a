"""Smooth functions over a face, and their fit by least squares, with sums in a fixed order."""

from itertools import product

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
    """The products of rows [..., n] with factors [n], [...]."""
    return np.asarray((rows * factors).sum(axis=-1))


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


def grid_fit(goal: Reals, weights: Reals, stiffness: Reals, across: int, down: int) -> Reals:
    """As `least_squares` with the `products` at the middles of a grid's cells, goal [H, W].

    A product of Chebyshev polynomials is a sum, T_a T_b = (T_a+b + T_|a-b|) / 2, so the matrix
    needs the sums over the grid of few polynomials only.
    """
    sums = _moments(weights, 2 * across, 2 * down)
    first, second = (order.astype(np.intp) for order in orders(across, down))
    columns = first[:, None] + first, abs(first[:, None] - first)
    rows = second[:, None] + second, abs(second[:, None] - second)
    matrix = np.diag(stiffness)
    for row, column in product(rows, columns):
        matrix += sums[row, column] / 4
    return _solved(matrix, _moments(weights * goal, across, down).reshape(-1))


def _moments(values: Reals, across: int, down: int) -> Reals:
    """The sums over a grid [H, W] of values times `products`, [down + 1, across + 1]."""
    height, width = values.shape
    along_u = np.stack(_chebyshev(2 * (np.arange(width) + 0.5) / width - 1, across))
    along_v = np.stack(_chebyshev(2 * (np.arange(height) + 0.5) / height - 1, down))
    rows = row_sums(along_u[:, None], values)
    return np.asarray((along_v[:, None] * rows).sum(axis=2))


def _chebyshev(x: Reals, highest: int) -> list[Reals]:
    rows = [np.ones_like(x), x]
    while len(rows) <= highest:
        rows.append(2 * x * rows[-1] - rows[-2])
    return rows[: highest + 1]


def _solved(matrix: Reals, right: Reals) -> Reals:
    """The solution of a positive definite system, by Gaussian elimination."""
    rows = np.concatenate([matrix, right[:, None]], axis=1)
    for pivot in range(len(right)):
        factors = rows[pivot + 1 :, pivot] / rows[pivot, pivot]
        rows[pivot + 1 :, pivot:] -= factors[:, None] * rows[pivot, pivot:]
    found = rows[:, -1].copy()
    for pivot in reversed(range(len(right))):
        found[pivot] /= rows[pivot, pivot]
        found[:pivot] -= found[pivot] * rows[:pivot, pivot]
    return found
