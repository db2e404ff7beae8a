"""The filter of Desbrun 1999, W = (I - dt² M⁻¹ H)⁻¹.

H is the springs' linear Hessian: H_ij = k_ij, H_ii = -sum_j k_ij. Pinned particles have no
inverse mass, so their rows of W are those of the identity. A free cloth's rows each sum to 1.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.cloth.exact import inverse, sine_of_turns
from drapery.mesh import Array


class Filter(NamedTuple):
    """u = W g as products of small matrices with the particles of a grid's lines.

    matrices: all of them, flat. products: [n, 5], for each the place and size of its matrix, the
    first particle of its line and the step to the next, and whether it reads g or u (0 or 1) to
    write the other. The last one writes u. release: [N, P]; u += release u[pins] brings the
    pinned particles' u to 0; [N, 0] where it is so already.
    """

    matrices: Array
    products: NDArray[np.int64]
    release: Array


def cloth_filter(cloth: Cloth, dt: float) -> Filter:
    """The cheapest filter for this cloth."""
    if _is_regular(cloth):
        return separable_filter(cloth, dt)
    W = dense_filter(cloth, dt)
    products = np.array([[0, len(W), 0, 1, 0]])
    return Filter(W.ravel(), products, np.zeros((len(W), 0)))


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
    """W of a regular grid as small products along its rows and columns.

    The springs that would leave the grid are mirrored at its edges. Then the eigenvectors of H
    are products of those of the two 1-D Laplacians, which are cosines; sines for columns that
    hang from a pinned row. With 1-D eigenvalues r and c, structural springs have r + c, shear
    springs rc + 2r + 2c and flexion springs r² + 4r + c² + 4c. So: to the waves of each row; for
    each wave, the filter of the columns; and back.
    """
    assert cloth.grid_shape is not None
    rows, columns = cloth.grid_shape
    pins = np.flatnonzero(cloth.inv_mass == 0)
    hangs = np.array_equal(pins, np.arange(columns))
    V, r = _hanging(rows - 1) if hangs else _free(rows)
    U, c = _free(columns)
    r = r[:, None]
    k = [_stiffness(cloth, kind) for kind in range(3)]
    H = k[0] * (r + c) + k[1] * (r * c + 2 * r + 2 * c) + k[2] * (r * r + 4 * r + c * c + 4 * c)
    spectrum = 1 / (1 - dt**2 * cloth.inv_mass.max() * H)
    # One matrix a wave: V diag(spectrum[:, wave]) Vᵀ, summed without BLAS.
    down = (V[None, :, None, :] * V[None, None] * spectrum.T[:, None, None]).sum(-1)
    first, size = columns * hangs, columns * columns
    lines = [(0, columns, first + row * columns, 1, 0) for row in range(len(V))]
    lines += [(2 * size + c * len(V) ** 2, len(V), first + c, columns, 1) for c in range(columns)]
    lines += [(size, columns, first + row * columns, 1, 0) for row in range(len(V))]
    release = np.zeros((rows * columns, 0))
    if not hangs and len(pins):
        release = _release(down, U, pins)
    matrices = np.concatenate([U.T.ravel(), U.ravel(), down.ravel()])
    return Filter(matrices, np.array(lines), release)


def _release(down: Array, U: Array, pins: NDArray[np.int64]) -> Array:
    """-W[:, pins] W[pins, pins]⁻¹: forces at the pins that hold them still."""
    row, column = np.divmod(pins, len(U))
    waves = down[:, :, row] * U[column].T[:, None, :]
    W = (waves[:, :, None, :] * U.T[:, None, :, None]).sum(0).reshape(-1, len(pins))
    release: Array = -(W[:, :, None] * inverse(W[pins])[None]).sum(1)
    return release


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
