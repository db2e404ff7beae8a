"""The filter of Desbrun 1999, W = (I - dt² M⁻¹ H)⁻¹, in the form that is fastest for a cloth.

H is the springs' linear Hessian: H_ij = k_ij, H_ii = -sum_j k_ij. Pinned particles have inverse
mass 0, so their rows of W are rows of the identity. Each row of W sums to 1 if nothing is pinned.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.elementary import sine_of_turns
from drapery.mesh import Array

MAX_MATRIX_NUMBERS = 1 << 20
"""The most numbers in the matrices of a separable filter; a larger one is stored as factors."""

MAX_DENSE = 400
"""The most particles of an irregular cloth with a dense filter; larger ones have a band matrix."""
MAX_SEPARABLE_PINS = 64
"""The most pins of a grid with a separable filter, unless its pins are the top row."""


class Filter(NamedTuple):
    """u = W g as products of small matrices with the rows and columns of a grid.

    matrices: all of them, flat. products: [n, 5], one row for each product: the offset and the size
    of its matrix, the first particle of its row or column, the step to the next particle, and
    whether it reads g and writes u (0) or reads u and writes g (1). The last product writes u.
    release: [N, P]; u += release u[pins] makes u of the pinned particles 0; [N, 0] if it is 0
    without that.
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

    into: [W, W], the transform of a row into its eigenvectors ("waves"). back: the inverse.
    near, far, inverse: for each wave the factors of its matrix along the column: L one and two
    below the diagonal, and 1 / D, [R, W].
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
    """The fastest form of the filter for this cloth."""
    columns = cloth.grid_shape[1] if cloth.grid_shape else 0
    pins = np.flatnonzero(cloth.inv_mass == 0)
    hangs = np.array_equal(pins, np.arange(columns))
    if is_regular(cloth) and (hangs or len(pins) <= MAX_SEPARABLE_PINS):
        return separable_filter(cloth, dt)
    if len(cloth.inv_mass) > MAX_DENSE:
        return band_filter(cloth, dt)
    W = dense_filter(cloth, dt)
    return Filter(W.ravel(), np.array([[0, len(W), 0, 1, 0]]), np.zeros((len(W), 0)))


def hessian(cloth: Cloth, dt: float) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
    """Rows, columns and values [N/m] of H; entries at the same place add up.

    The damping of bending acts on the velocity, so it multiplies the stiffness by 1 + damping / dt.
    """
    a, b = cloth.spring_pairs.T.astype(np.int64)
    k, bending = cloth.spring_stiffness, cloth.bending
    w, i = bending.weights, bending.particles.astype(np.int64)
    stiffness = -bending.stiffness[:, None, None] * _damped(cloth, dt)
    return (
        np.concatenate([a, b, a, b, np.repeat(i, 4, axis=1).ravel()]),
        np.concatenate([b, a, a, b, np.tile(i, 4).ravel()]),
        np.concatenate([k, k, -k, -k, (stiffness * w[:, :, None] * w[:, None]).ravel()]),
    )


def _damped(cloth: Cloth, dt: float) -> float:
    return 1 + cloth.bending.damping / dt


def dense_filter(cloth: Cloth, dt: float) -> Array:
    """W [N, N], for any cloth."""
    count = len(cloth.inv_mass)
    H = np.zeros((count, count))
    rows, columns, values = hessian(cloth, dt)
    np.add.at(H, (rows, columns), values)
    return _inverse(np.eye(count) - dt**2 * cloth.inv_mass[:, None] * H)


def band_filter(cloth: Cloth, dt: float) -> BandFilter:
    """W for a cloth of any topology and size."""
    from scipy.sparse import coo_array

    free = np.flatnonzero(cloth.inv_mass > 0)
    number = np.full(len(cloth.inv_mass), -1)
    number[free] = np.arange(len(free))
    rows, columns, values = hessian(cloth, dt)
    inside = (number[rows] >= 0) & (number[columns] >= 0)
    rows, columns, values = number[rows[inside]], number[columns[inside]], values[inside]
    graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(len(free),) * 2).tocsr()
    order = _breadth_first(graph)
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


def _breadth_first(graph: Any) -> NDArray[np.int64]:
    """Vertices in an order that keeps neighbours near, for a narrow band (Cuthill and McKee, 1969).

    Each part of the graph begins at its first vertex of the least degree. SciPy's
    `reverse_cuthill_mckee` finds that with an unstable sort, so by the kind of processor.
    """
    from scipy.sparse.csgraph import breadth_first_order, connected_components

    by_degree = np.argsort(np.diff(graph.indptr), kind="stable")
    part = connected_components(graph, directed=False)[1][by_degree]
    starts = by_degree[np.unique(part, return_index=True)[1]]
    orders = [
        breadth_first_order(graph, start, False, return_predecessors=False) for start in starts
    ]
    return np.concatenate([np.empty(0, np.int64), *orders])


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
                # Subtract factors[j] times the column, down to the diagonal, from row `row`.
                padded[row, back - j : back + 1] -= factors[j] * below[: j + 1]
    return lower, pivots


def separable_filter(cloth: Cloth, dt: float) -> Filter:
    """W of a regular grid as small products along its rows and columns.

    Springs that would cross an edge of the grid are mirrored there. Then the eigenvectors of H are
    products of the eigenvectors of two 1-D Laplacians: cosines, or sines for columns below a pinned
    row. With 1-D eigenvalues r and c, structural springs have the eigenvalues r + c, shear springs
    rc + 2r + 2c, flexion springs r² + 4r + c² + 4c, and bending stencils -r², -c² and -rc. So each
    row is transformed into waves, each wave is filtered along its column, and the rows are
    transformed back.
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
    """Eigenvalues of W, [R, C], from the 1-D eigenvalues of the rows [R] and columns [C]."""
    r, c = rows[:, None], columns[None]
    k = [_stiffness(cloth, kind) for kind in range(3)]
    H = k[0] * (r + c) + k[1] * (r * c + 2 * r + 2 * c) + k[2] * (r * r + 4 * r + c * c + 4 * c)
    across, down, twist = _bending(cloth, dt)
    H = H - (across * c * c + down * r * r + twist * r * c)
    spectrum: Array = 1 / (1 - dt**2 * cloth.inv_mass.max() * H)
    return spectrum


def sheet_filter(cloth: Cloth, dt: float, width: int) -> SheetFilter:
    """The filter of `separable_filter`, with a band matrix to solve for the column of each wave.

    Along a column the Laplacian has bandwidth 1 and its square bandwidth 2.
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
    across, down, twist = _bending(cloth, dt)
    linear = k[0] + k[1] * (c + 2) + 4 * k[2] - twist * c
    constant = (k[0] + 2 * k[1]) * c + k[2] * (c + 4) * c - across * c * c
    bands = [
        (offset == 0) * (1 - a * constant)
        - a * np.diagonal(L, -offset)[:, None] * linear
        - a * np.diagonal(square, -offset)[:, None] * (k[2] - down)
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
    """The last axis filled up to `width`."""
    wide = np.full((*values.shape[:-1], width), filling)
    wide[..., : values.shape[-1]] = values
    return wide


def _products(V: Array, U: Array, spectrum: Array, first: int) -> tuple[Array, NDArray[np.int64]]:
    """The matrices and products: rows into waves, the filter of each wave's column, and back."""
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
    """-W[:, pins] W[pins, pins]⁻¹, [N, P]: the effect of the forces that hold the pins."""
    columns = [np.zeros((len(V) * len(U), 0))]
    if hangs:
        return np.zeros(((len(V) + 1) * len(U), 0))
    for pin in pins:
        row, column = divmod(int(pin), len(U))
        waves = spectrum * V[row][:, None] * U[column]
        down = (V[:, :, None] * waves[None]).sum(1)
        columns.append((down[:, None] * U[None]).sum(-1).reshape(-1, 1))
    W = np.concatenate(columns, axis=1)
    release: Array = -(W[:, :, None] * _inverse(W[pins])[None]).sum(1)
    return release


def is_regular(cloth: Cloth) -> bool:
    """Whether the free particles of a grid have one mass, and springs of a kind one stiffness."""
    free = cloth.inv_mass[cloth.inv_mass > 0]
    kinds = [cloth.spring_stiffness[cloth.spring_kind == kind] for kind in range(3)]
    uniform = [free, *kinds, *_bending_groups(cloth)]
    return cloth.grid_shape is not None and all(
        values.size == 0 or np.ptp(values) <= 1e-12 * values.max() for values in uniform
    )


def _bending_groups(cloth: Cloth) -> list[Array]:
    """Stiffness of the stencils along rows, down columns and across cells of a grid [N/m]."""
    bending = cloth.bending
    step = bending.particles[:, 1] - bending.particles[:, 0]
    cells = bending.weights[:, 3] != 0
    columns = cloth.grid_shape[1] if cloth.grid_shape else 0
    chosen = [~cells & (step == 1), ~cells & (step == columns), cells]
    return [bending.stiffness[group] for group in chosen]


def _bending(cloth: Cloth, dt: float) -> tuple[float, float, float]:
    """The same as three numbers, damping included."""
    across, down, twist = (float(k.max(initial=0.0)) for k in _bending_groups(cloth))
    factor = _damped(cloth, dt)
    return factor * across, factor * down, factor * twist


def _stiffness(cloth: Cloth, kind: int) -> float:
    return float(cloth.spring_stiffness[cloth.spring_kind == kind].max(initial=0.0))


def _free(count: int) -> tuple[Array, Array]:
    """Eigenvectors (in columns) and eigenvalues of the Laplacian of a path graph: cosines."""
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


def _inverse(A: Array) -> Array:
    """Inverse of a diagonally dominant matrix [N, N], by Gauss-Jordan without pivoting.

    It has the same bits on every machine; LAPACK's kernels depend on the processor.
    """
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
