"""The filter of Desbrun 1999, W = (I - dt² M⁻¹ H)⁻¹, in the cheapest form for a cloth.

H is the springs' linear Hessian: H_ij = k_ij, H_ii = -sum_j k_ij. Pinned particles have no
inverse mass, so their rows of W are those of the identity. A free cloth's rows each sum to 1.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.cloth.exact import inverse, sine_of_turns
from drapery.mesh import Array

MAX_MATRIX_NUMBERS = 1 << 20
"""A separable filter with more numbers in its matrices is stored as factors."""

MAX_DENSE = 400
"""An irregular cloth with more particles has a band matrix as its filter."""
MAX_SEPARABLE_PINS = 64
"""A grid with more pins, other than its top row, has no separable filter."""


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


class BandFilter(NamedTuple):
    """u = W g as the solution of (M - dt² H) u = M g for the F free particles.

    The matrix is L D Lᵀ with particles in an order [F] that keeps it within a narrow band.
    lower: L[i, i - back + k] at [i, k], shape [F, back]. inverse: of D, [F]. mass: [F].
    """

    order: NDArray[np.int64]
    lower: Array
    inverse: Array
    mass: Array


class SheetFilter(NamedTuple):
    """W of a regular grid laid out as rows of lanes; see `drapery.cloth.sheets`.

    into: [W, W], each column's part of each wave along the row; back: the inverse.
    near, far, inverse: of each wave's column, L one and two below the diagonal and 1 / D, [R, W].
    first: the first free row. release: [P, R · W], see `Filter`.
    """

    into: Array
    back: Array
    near: Array
    far: Array
    inverse: Array
    first: int
    release: Array


def cloth_filter(cloth: Cloth, dt: float) -> Filter | BandFilter:
    """The cheapest filter for this cloth."""
    columns = cloth.grid_shape[1] if cloth.grid_shape else 0
    pins = np.flatnonzero(cloth.inv_mass == 0)
    hangs = np.array_equal(pins, np.arange(columns))
    if is_regular(cloth) and (hangs or len(pins) <= MAX_SEPARABLE_PINS):
        return separable_filter(cloth, dt)
    if len(cloth.inv_mass) > MAX_DENSE:
        return band_filter(cloth, dt)
    W = dense_filter(cloth, dt)
    return Filter(W.ravel(), np.array([[0, len(W), 0, 1, 0]]), np.zeros((len(W), 0)))


def hessian(cloth: Cloth) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
    """Rows, columns and values [N/m] of H; entries at the same place add up."""
    a, b = cloth.spring_pairs.T.astype(np.int64)
    k = cloth.spring_stiffness
    return (
        np.concatenate([a, b, a, b]),
        np.concatenate([b, a, a, b]),
        np.concatenate([k, k, -k, -k]),
    )


def dense_filter(cloth: Cloth, dt: float) -> Array:
    """W [N, N], for any cloth."""
    count = len(cloth.inv_mass)
    H = np.zeros((count, count))
    rows, columns, values = hessian(cloth)
    np.add.at(H, (rows, columns), values)
    return inverse(np.eye(count) - dt**2 * cloth.inv_mass[:, None] * H)


def band_filter(cloth: Cloth, dt: float) -> BandFilter:
    """W for a cloth of any topology and size; the order is that of Cuthill and McKee (1969)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    free = np.flatnonzero(cloth.inv_mass > 0)
    number = np.full(len(cloth.inv_mass), -1)
    number[free] = np.arange(len(free))
    rows, columns, values = hessian(cloth)
    inside = (number[rows] >= 0) & (number[columns] >= 0)
    rows, columns, values = number[rows[inside]], number[columns[inside]], values[inside]
    graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(len(free),) * 2).tocsr()
    order = reverse_cuthill_mckee(graph, symmetric_mode=True)
    place = np.empty(len(free), np.int64)
    place[order] = np.arange(len(free))
    rows, columns = place[rows], place[columns]
    back = int((rows - columns).max(initial=1))
    band = np.zeros((len(free), back + 1))
    low = rows >= columns
    np.add.at(band, (rows[low], back - rows[low] + columns[low]), -(dt**2) * values[low])
    mass = 1 / cloth.inv_mass[free[order]]
    band[:, back] += mass
    lower, pivots = _ldl(band)
    return BandFilter(free[order].astype(np.int64), lower, 1 / pivots, mass)


def _ldl(band: Array) -> tuple[Array, Array]:
    """L D Lᵀ of a positive definite band matrix, [F, back + 1] with the diagonal last."""
    count, back = band.shape[0], band.shape[1] - 1
    lower, pivots = np.zeros((count, back)), np.zeros(count)
    reach = np.arange(back)
    padded = np.concatenate([band, np.zeros((back, back + 1))])
    for i in range(count):
        pivots[i] = padded[i, back]
        # Column i of the matrix below the diagonal lies on a diagonal of the band.
        below = padded[i + 1 + reach, back - 1 - reach]
        factors = below / pivots[i]
        for j in range(back):
            if factors[j] != 0:
                row = i + 1 + j
                if row < count:
                    lower[row, back - 1 - j] = factors[j]
                # row `row` loses factors[j] times the part of the column up to its own diagonal.
                padded[row, back - j : back + 1] -= factors[j] * below[: j + 1]
    return lower, pivots


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
    spectrum = _spectrum(cloth, r, c, dt)
    matrices, products = _products(V, U, spectrum, columns * int(hangs))
    return Filter(matrices, products, _release(V, U, spectrum, pins, hangs))


def _spectrum(cloth: Cloth, rows: Array, columns: Array, dt: float) -> Array:
    """W of each wave: 1-D eigenvalues of the rows [R] and columns [C] to [R, C]."""
    r, c = rows[:, None], columns[None]
    k = [_stiffness(cloth, kind) for kind in range(3)]
    H = k[0] * (r + c) + k[1] * (r * c + 2 * r + 2 * c) + k[2] * (r * r + 4 * r + c * c + 4 * c)
    spectrum: Array = 1 / (1 - dt**2 * cloth.inv_mass.max() * H)
    return spectrum


def sheet_filter(cloth: Cloth, dt: float, width: int) -> SheetFilter:
    """The filter of `separable_filter`, with the waves' columns solved instead of multiplied.

    Along a column the Laplacian is a band of one, its square a band of two.
    """
    assert cloth.grid_shape is not None
    rows, columns = cloth.grid_shape
    pins = np.flatnonzero(cloth.inv_mass == 0)
    hangs = np.array_equal(pins, np.arange(columns))
    U, c = _free(columns)
    V, r = _hanging(rows - 1) if hangs else _free(rows)
    L = np.diag(np.full(len(V), -2.0)) + np.eye(len(V), k=1) + np.eye(len(V), k=-1)
    L[-1, -1] = -1.0
    if not hangs:
        L[0, 0] += 1.0
    square = L @ L  # whole numbers, exact in any order
    k = [_stiffness(cloth, kind) for kind in range(3)]
    a = dt**2 * cloth.inv_mass.max()
    linear, constant = k[0] + k[1] * (c + 2) + 4 * k[2], (k[0] + 2 * k[1]) * c + k[2] * (c + 4) * c
    bands = [
        (offset == 0) * (1 - a * constant)
        - a * np.diagonal(L, -offset)[:, None] * linear
        - a * np.diagonal(square, -offset)[:, None] * k[2]
        for offset in range(3)
    ]
    near, far, inverse_diagonal = _pentadiagonal(*bands)
    whole = -(-width // 16) * 16
    release = _release(V, U, _spectrum(cloth, r, c, dt), pins, hangs)
    held = _padded(release.T.reshape(-1, rows, columns), width)
    return SheetFilter(
        _padded(_padded(U.T, width).T, whole),
        _padded(_padded(U, width).T, whole),
        _padded(near, whole),
        _padded(far, whole),
        _padded(inverse_diagonal, whole, 1.0),
        int(hangs),
        _padded(held.reshape(len(held), rows * width), -(-rows * width // 16) * 16),
    )


def _pentadiagonal(diagonal: Array, near: Array, far: Array) -> tuple[Array, Array, Array]:
    """L D Lᵀ of C matrices at once: L one and two below the diagonal, and 1 / D, [R, C] each."""
    rows = len(diagonal)
    one, two, inverse = np.zeros((3, *diagonal.shape))
    pivot = np.zeros_like(diagonal)
    for i in range(rows):
        rest = diagonal[i].copy()
        if i > 1:
            two[i] = far[i - 2] * inverse[i - 2]
            rest -= two[i] ** 2 * pivot[i - 2]
        if i > 0:
            link = near[i - 1] - (two[i] * one[i - 1] * pivot[i - 2] if i > 1 else 0.0)
            one[i] = link * inverse[i - 1]
            rest -= one[i] ** 2 * pivot[i - 1]
        pivot[i], inverse[i] = rest, 1 / rest
    return one, two, inverse


def _padded(values: Array, width: int, filling: float = 0.0) -> Array:
    """The last axis filled up."""
    wide = np.full((*values.shape[:-1], width), filling)
    wide[..., : values.shape[-1]] = values
    return wide


def _products(V: Array, U: Array, spectrum: Array, first: int) -> tuple[Array, NDArray[np.int64]]:
    """Matrices and products: to the waves of each row, filter each wave's column, and back."""
    rows, columns = spectrum.shape
    size = columns * columns
    starts = first + columns * np.arange(rows)
    into = [(0, columns, start, 1, 0) for start in starts]
    back = [(size, columns, start, 1, 0) for start in starts]
    if rows * rows * columns <= MAX_MATRIX_NUMBERS:
        # One matrix a wave, V diag(spectrum[:, wave]) Vᵀ, summed without BLAS.
        down = (V[None, :, None, :] * V[None, None] * spectrum.T[:, None, None]).sum(-1)
        lines = [(2 * size + c * rows * rows, rows, first + c, columns, 1) for c in range(columns)]
        matrices = [U.T, U, down]
    else:
        place = 2 * size + 2 * rows * rows
        lines = [(2 * size, rows, first + c, columns, 1) for c in range(columns)]
        lines += [(place + i, 1, first + i, 1, 0) for i in range(rows * columns)]
        lines += [(2 * size + rows * rows, rows, first + c, columns, 1) for c in range(columns)]
        matrices = [U.T, U, V.T, V, spectrum]
    return np.concatenate([part.ravel() for part in matrices]), np.array([*into, *lines, *back])


def _release(V: Array, U: Array, spectrum: Array, pins: NDArray[np.int64], hangs: bool) -> Array:
    """-W[:, pins] W[pins, pins]⁻¹, [N, P]: forces at the pins that hold them still."""
    columns = [np.zeros((len(V) * len(U), 0))]
    if hangs:
        return np.zeros(((len(V) + 1) * len(U), 0))
    for pin in pins:
        row, column = divmod(int(pin), len(U))
        waves = spectrum * V[row][:, None] * U[column]
        down = (V[:, :, None] * waves[None]).sum(1)
        columns.append((down[:, None] * U[None]).sum(-1).reshape(-1, 1))
    W = np.concatenate(columns, axis=1)
    release: Array = -(W[:, :, None] * inverse(W[pins])[None]).sum(1)
    return release


def is_regular(cloth: Cloth) -> bool:
    """Whether a grid's free particles are alike, and its springs of each kind."""
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
