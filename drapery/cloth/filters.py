"""The filter of Desbrun 1999, W = (I - dt² M⁻¹ H)⁻¹.

H is the springs' linear Hessian: H_ij = k_ij, H_ii = -sum_j k_ij. Pinned particles have no
inverse mass, so their rows of W are those of the identity. A free cloth's rows each sum to 1.
"""

from typing import NamedTuple

import numpy as np

from drapery.cloth.cloth import Cloth
from drapery.cloth.exact import inverse, sine_of_turns
from drapery.mesh import Array

DENSE, SEPARABLE = 0, 1


class Filter(NamedTuple):
    """A filter as the kernels read it: u = W g.

    kind: DENSE: left is W [N, N], and the rest is empty.
    SEPARABLE: over the grid's rows from `first` and its columns,
    u = left ((leftᵀ g right) * spectrum) rightᵀ with orthonormal left [R, R] and right [C, C]
    (and their transposes, laid out for the kernels);
    then u += pull u[pins], pull [N, P], which brings the pinned particles' u to 0.
    """

    kind: int
    left: Array
    left_t: Array
    right: Array
    right_t: Array
    spectrum: Array
    first: int
    pull: Array


def cloth_filter(cloth: Cloth, dt: float) -> Filter:
    """The cheapest filter for this cloth."""
    if _is_regular(cloth):
        return separable_filter(cloth, dt)
    none = np.zeros((0, 0))
    return Filter(DENSE, dense_filter(cloth, dt), none, none, none, none, 0, none)


def dense_filter(cloth: Cloth, dt: float) -> Array:
    """W [N, N], for any cloth."""
    count = len(cloth.inv_mass)
    a, b = cloth.spring_pairs.T
    H = np.zeros((count, count))
    np.add.at(H, (a, b), cloth.spring_stiffness)
    np.add.at(H, (b, a), cloth.spring_stiffness)
    np.add.at(H, (a, a), -cloth.spring_stiffness)
    np.add.at(H, (b, b), -cloth.spring_stiffness)
    return inverse(np.eye(count) - dt**2 * cloth.inv_mass[:, None] * H)


def separable_filter(cloth: Cloth, dt: float) -> Filter:
    """W of a regular grid as small products along its columns and its rows.

    The springs that would leave the grid are mirrored at its edges. Then the eigenvectors of H
    are products of those of the two 1-D Laplacians, which are cosines; sines for rows that hang
    from a pinned one. With 1-D eigenvalues r and c, structural springs have r + c, shear springs
    rc + 2r + 2c and flexion springs r² + 4r + c² + 4c.
    """
    assert cloth.grid_shape is not None
    rows, columns = cloth.grid_shape
    pins = np.flatnonzero(cloth.inv_mass == 0)
    hangs = np.array_equal(pins, np.arange(columns))
    left, r = _hanging(rows - 1) if hangs else _free(rows)
    right, c = _free(columns)
    r = r[:, None]
    k = [_stiffness(cloth, kind) for kind in range(3)]
    H = k[0] * (r + c) + k[1] * (r * c + 2 * r + 2 * c) + k[2] * (r * r + 4 * r + c * c + 4 * c)
    spectrum = 1 / (1 - dt**2 * cloth.inv_mass.max() * H)
    pull = np.zeros((len(cloth.inv_mass), 0))
    if not hangs and len(pins):
        at_row, at_column = np.divmod(pins, columns)
        waves = spectrum * left[at_row][:, :, None] * right[at_column][:, None, :]
        sums = (waves[:, None] * left[None, :, :, None]).sum(2)
        W = (sums[:, :, None] * right[None, None]).sum(3).reshape(len(pins), -1).T
        pull = -(W[:, :, None] * inverse(W[pins])[None]).sum(1)
    return Filter(SEPARABLE, left, left.T, right, right.T, spectrum, int(hangs), pull)


def _is_regular(cloth: Cloth) -> bool:
    free = cloth.inv_mass[cloth.inv_mass > 0]
    kinds = [cloth.spring_stiffness[cloth.spring_kind == kind] for kind in range(3)]
    uniform = [free, *kinds]
    return cloth.grid_shape is not None and all(
        values.size == 0 or np.ptp(values) <= 1e-12 * values.max() for values in uniform
    )


def _stiffness(cloth: Cloth, kind: int) -> float:
    return float(cloth.spring_stiffness[cloth.spring_kind == kind].max(initial=0.0))


def _free(count: int) -> tuple[Array, Array]:
    """Eigenvectors (in columns) and eigenvalues of a path's Laplacian: cosines."""
    wave = np.arange(count) / (2 * count)
    vectors = sine_of_turns(0.25 + (np.arange(count)[:, None] + 0.5) * wave)
    return _normal(vectors), 2 * sine_of_turns(0.25 + wave) - 2


def _hanging(count: int) -> tuple[Array, Array]:
    """The same for a path whose first particle hangs from a fixed one: sines."""
    wave = (2 * np.arange(count) + 1) / (2 * (2 * count + 1))
    vectors = sine_of_turns((np.arange(count)[:, None] + 1) * wave)
    return _normal(vectors), 2 * sine_of_turns(0.25 + wave) - 2


def _normal(vectors: Array) -> Array:
    normal: Array = vectors / np.sqrt((vectors * vectors).sum(axis=0))
    return normal
