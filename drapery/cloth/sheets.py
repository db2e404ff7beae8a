"""One fine grid as a plane of lanes.

A batch fills the lanes of `kernels` with cloths; one cloth alone would leave most lanes empty. So
the particles of a fine grid become the lanes, [3, lanes]: lane r · width + c is the particle in
row r and column c, and rows are padded to whole registers. A constraint between particles some
rows and columns apart joins lanes that are a constant shift apart. One loop solves a batch of
constraints that share no particle: every second constraint of the whole plane or, down the columns,
one row after the other, which is exact Gauss-Seidel along a hanging cloth. Lanes beside the grid
stay at the origin. `python -m benchmarks.sheets` measures the gain in speed.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.attachments import attachment_groups
from drapery.cloth.bending import Bending
from drapery.cloth.cloth import Cloth
from drapery.cloth.faces import Faces
from drapery.mesh import Array

MIN_COLUMNS = 16
"""The fewest columns of a grid that is faster as a plane of lanes."""
MAX_PINS = 4
"""The most pins of a grid whose pins are not its top row."""
REGISTER = 8
"""Rows are padded to a multiple of this, a register of 256 bits."""
RELAXATION = 0.75
"""Part of the corrections that is applied along rows, where all are computed at once."""
LANES = 16
"""Loops run to a multiple of this: the largest number of values that `simd` loads at once."""


class SheetLayout(NamedTuple):
    """The lanes of a grid's particles.

    rows, columns: of the grid. width: lanes a row. size: lanes of the grid. plane: lanes of the
    grid and empty lanes for the longest shift; planes of anchors follow it. anchors: the pin whose
    position fills each such plane, [K], or -1 for the pin of each column. pins: particles, [P].
    free: 1 for particles that move, [size]. inv_mass: [1/kg], [size]. controls: wind samples, [S].
    above: the first of the two sample lines around each row, [R]; low: the weight of the second,
    [R]. across: weights of sample columns, [C', at least width].
    """

    rows: int
    columns: int
    width: int
    size: int
    plane: int
    anchors: NDArray[np.int64]
    pins: NDArray[np.int64]
    free: Array
    inv_mass: Array
    controls: NDArray[np.int32]
    above: NDArray[np.int64]
    low: Array
    across: Array


class ConstraintBatches(NamedTuple):
    """Batches of constraints in order; entry e joins lanes a[e] + n and b[e] + n, n < lanes[e].

    a, b, lanes, start: [E]; the values of entry e begin at start[e]. held: whether the particles at
    a are fixed, [E]. crossing: whether a lane may be at both ends, [E]. values: [3, V]; length [m],
    then the parts of the difference that each end takes: 0 for no constraint and between entries.
    """

    a: NDArray[np.int64]
    b: NDArray[np.int64]
    lanes: NDArray[np.int64]
    start: NDArray[np.int64]
    held: NDArray[np.bool_]
    crossing: NDArray[np.bool_]
    values: Array


class SheetBending(NamedTuple):
    """Bending stencils in groups of equal shape; one of group g starts at each lane.

    shifts: from the first particle's lane to those of all four, [G, 4]. weights: [G, 4].
    stiffness: of each lane's stencil [N/m], 0 where there is none, [G, lanes]. inv_mass: [1/kg],
    [1, lanes]. damping: [s], [1].
    """

    shifts: NDArray[np.int64]
    weights: Array
    stiffness: Array
    inv_mass: Array
    damping: Array


class Pairs(NamedTuple):
    """Pairs of particles [K, 2] with their lengths [m] and parts, [K] each."""

    pairs: NDArray[np.int32]
    length: Array
    part_i: Array
    part_j: Array


class ConstraintBatch(NamedTuple):
    """One entry of `ConstraintBatches`: its lanes, and values [3, count]."""

    a: int
    b: int
    values: Array

    @property
    def crosses(self) -> bool:
        return abs(self.b - self.a) < int(self.values.shape[1])


def is_sheet(cloth: Cloth) -> bool:
    """Whether a cloth is faster as a plane of lanes."""
    if cloth.grid_shape is None or cloth.grid_shape[1] < MIN_COLUMNS:
        return False
    if cloth.bending.rest.any() or (np.diff(cloth.bending.particles[:, :3], axis=1) <= 0).any():
        return False
    return hangs(cloth) or int((cloth.inv_mass == 0).sum()) <= MAX_PINS


def hangs(cloth: Cloth) -> bool:
    """Whether a grid's pins are its top row."""
    columns = cloth.grid_shape[1] if cloth.grid_shape else 0
    return np.array_equal(np.flatnonzero(cloth.inv_mass == 0), np.arange(columns))


def sheet_of(cloth: Cloth, faces: Faces, controls: NDArray[np.int32]) -> SheetLayout:
    """The layout of a grid."""
    assert cloth.grid_shape is not None
    rows, columns = cloth.grid_shape
    width = -(-columns // REGISTER) * REGISTER
    size = rows * width
    inv_mass = np.zeros((rows, _whole(width)))
    inv_mass[:, :columns] = cloth.inv_mass.reshape(rows, columns)
    samples = len(set((controls % columns).tolist()))  # np.unique would import numpy.ma
    across = np.zeros((samples, _whole(width)))
    for corner in range(4):
        sample = faces.controls[:columns, corner] % samples
        np.add.at(across, (sample, np.arange(columns)), faces.weights[:columns, corner])
    pins = np.flatnonzero(cloth.inv_mass == 0)
    return SheetLayout(
        rows=rows,
        columns=columns,
        width=width,
        size=size,
        plane=_whole(2 * size) + 4 * LANES,
        anchors=np.array([-1]) if hangs(cloth) else pins,
        pins=pins,
        free=np.pad((inv_mass[:, :width] > 0).astype(float).ravel(), (0, _whole(size) - size))[
            None
        ],
        inv_mass=inv_mass,
        controls=controls,
        above=(faces.controls[::columns, 0] // samples).astype(np.int64),
        low=faces.weights[::columns, 2:].sum(axis=1),
        across=across,
    )


def constraint_batches(batches: Sequence[ConstraintBatch]) -> ConstraintBatches:
    """Batches in order; batches with equal values share them."""
    starts: dict[bytes, int] = {}
    overlap = max((abs(p.b - p.a) for p in batches if p.crosses), default=0)
    gap = no_constraints(_whole(overlap + LANES))
    values, size, at = [gap], gap.shape[1], []
    for batch in batches:
        key = batch.values.tobytes()
        if key not in starts:
            starts[key] = size
            more = no_constraints(_whole(batch.values.shape[1]) + gap.shape[1])
            more[:, : batch.values.shape[1]] = batch.values
            size += more.shape[1]
            values.append(more)
        at.append(starts[key])
    lanes = [(batch.a, batch.b, _whole(batch.values.shape[1])) for batch in batches]
    a, b, count = np.array(lanes, np.int64).reshape(-1, 3).T.copy()
    start = np.array(at, np.int64)
    held = np.array([not p.values[1].any() for p in batches], bool)
    crossing = np.array([p.crosses for p in batches], bool)
    return ConstraintBatches(a, b, count, start, held, crossing, np.concatenate(values, axis=1))


def anchored(sheet: SheetLayout, pairs: Pairs) -> Iterator[ConstraintBatch]:
    """Pairs of a pin and a particle: one batch for each plane of anchors."""
    for number, anchor in enumerate(sheet.anchors):
        mine = slice(None) if anchor < 0 else pairs.pairs[:, 0] == anchor
        values = no_constraints(sheet.size)
        _put(values, sheet, pairs.pairs[mine, 1], *(part[mine] for part in pairs[1:]))
        yield ConstraintBatch((number + 1) * sheet.plane, 0, values)


def limits(sheet: SheetLayout, cloth: Cloth, limit: float, sweeps: int) -> ConstraintBatches:
    """`attachment_groups` in their order; those along rows are corrected at once, in part."""
    groups = [Pairs(*group) for group in attachment_groups(cloth, limit, sweeps)]
    batches: list[ConstraintBatch] = []
    for group in groups:
        held = group is groups[0] or group is groups[-1]
        batches += anchored(sheet, group) if held else in_turn(sheet, group, RELAXATION)
    return constraint_batches(batches)


def sheet_bending(sheet: SheetLayout, bending: Bending) -> SheetBending:
    """The stencils of a grid that is flat at rest."""
    row, column = np.divmod(bending.particles.astype(np.int64), sheet.columns)
    lanes = row * sheet.width + column
    kinds = np.concatenate([lanes - lanes[:, :1], bending.weights], axis=1)
    groups, number = np.unique(kinds, axis=0, return_inverse=True)
    values = np.zeros((len(groups), _whole(sheet.size) + LANES))
    values[number.ravel(), lanes[:, 0]] = bending.stiffness
    masses = np.zeros((sheet.rows, sheet.width))
    masses[:, : sheet.columns] = sheet.inv_mass[:, : sheet.columns]
    inv_mass = np.zeros((1, _whole(sheet.size) + LANES))
    inv_mass[0, : sheet.size] = masses.ravel()
    shifts, weights = groups[:, :4].astype(np.int64), groups[:, 4:].copy()
    return SheetBending(shifts, weights, values, inv_mass, np.array([bending.damping]))


def spring_batches(sheet: SheetLayout, cloth: Cloth, time: float) -> ConstraintBatches:
    """The springs of a grid, with parts that make velocities of forces in a time [s]."""
    pairs = cloth.spring_pairs
    part_i, part_j = (time * cloth.spring_stiffness[:, None] * cloth.inv_mass[pairs]).T
    springs = Pairs(pairs, cloth.spring_length, part_i, part_j)
    return constraint_batches(list(together(sheet, springs)))


def together(sheet: SheetLayout, pairs: Pairs) -> Iterator[ConstraintBatch]:
    """Pairs of particles, a batch for each direction; for sums, whose order does not matter."""
    for shift, values in _by_shift(sheet, pairs):
        yield ConstraintBatch(0, shift, values)


def in_turn(sheet: SheetLayout, pairs: Pairs, part: float = 1.0) -> Iterator[ConstraintBatch]:
    """Pairs of particles in batches of which none uses a particle twice.

    Down the columns these are rows from the top; in other directions every second pair. With a part
    below 1, pairs in other directions are corrected at once, each by that part of its correction:
    the whole correction would not damp the shortest waves.
    """
    row, column = np.divmod(np.arange(sheet.size), sheet.width)
    for shift, values in _by_shift(sheet, pairs):
        rows, columns = _rows_and_columns(sheet, shift)
        if columns == 0:
            yield from _row_by_row(sheet, rows, values)
        elif part < 1:
            yield ConstraintBatch(0, shift, values * np.array([[1.0], [part], [part]]))
        else:
            turn = row // rows % 2 if rows else column // columns % 2
            for colour in (0, 1):
                chosen = values.copy()
                chosen[1:, turn != colour] = 0.0
                if chosen[1:].any():
                    yield ConstraintBatch(0, shift, chosen)


def _row_by_row(sheet: SheetLayout, rows: int, values: Array) -> Iterator[ConstraintBatch]:
    """Pairs straight down some rows: as many rows at once as share no particle, from the top."""
    for top in range(0, sheet.rows - rows, rows):
        first, last = top * sheet.width, min(top + rows, sheet.rows - rows) * sheet.width
        yield ConstraintBatch(first, first + rows * sheet.width, values[:, first:last])


def _by_shift(sheet: SheetLayout, pairs: Pairs) -> Iterator[tuple[int, Array]]:
    """For each shift of lanes, in the order of first use, the values of its pairs."""
    row, column = np.divmod(pairs.pairs.astype(np.int64), sheet.columns)
    lanes = row * sheet.width + column
    shifts = lanes[:, 1] - lanes[:, 0]
    _, first = np.unique(np.abs(shifts), return_index=True)
    for shift in np.abs(shifts[np.sort(first)]):
        values = no_constraints(sheet.size)
        for sign, start, end in ((1, 0, 1), (-1, 1, 0)):
            mine = shifts == sign * shift
            parts = pairs.part_i[mine], pairs.part_j[mine]
            chosen = pairs.pairs[mine, start]
            _put(values, sheet, chosen, pairs.length[mine], parts[start], parts[end])
        yield int(shift), values


def _rows_and_columns(sheet: SheetLayout, shift: int) -> tuple[int, int]:
    """A shift of lanes as rows down and columns to the right (below 0: to the left)."""
    rows = (shift + sheet.width // 2) // sheet.width if shift >= sheet.columns else 0
    return rows, shift - rows * sheet.width


def _whole(count: int) -> int:
    return -(-count // LANES) * LANES


def no_constraints(count: int) -> Array:
    """Values without constraints: length 1 m, parts 0."""
    values = np.zeros((3, count))
    values[0] = 1.0
    return values


def _put(values: Array, sheet: SheetLayout, particles: NDArray[np.integer], *parts: Array) -> None:
    row, column = np.divmod(particles.astype(np.int64), sheet.columns)
    for line, part in zip(values, parts, strict=True):
        line[row * sheet.width + column] = part
