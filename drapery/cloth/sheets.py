"""One fine grid as rows of lanes: its columns.

A batch fills the lanes of `kernels` with cloths. One cloth alone would leave them empty, so a fine
grid is laid out with its columns as lanes, [3R, W]: row 3r + axis. Springs are taken a row at a
time: all those between two rows, or along one, at once. Between rows they share no particle, and
that is exact Gauss-Seidel from row to row. Along a row they do, and are solved together (Jacobi)
with a part of each correction, `TOGETHER`. Lanes past the last column stay at rest at the origin.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.cloth.faces import Faces
from drapery.mesh import Array

LEAST_COLUMNS = 16
"""Grids with fewer columns leave too many lanes empty."""
MOST_PINS = 4
"""Most pins beside a whole top row."""
TOGETHER = 0.75
"""Part of the corrections along a row: with all, the shortest waves would never settle."""
VECTOR = 16
"""Lanes are filled up to a multiple of this, whole registers of any processor."""


class Rows(NamedTuple):
    """Pulls between lanes l of row i and l + shift of row j, in order.

    i, j: rows, [E]; from R on they are the pins' own, with the pin in every lane. shift: [E].
    lanes: how many, filled up, [E]. lengths, parts_i, parts_j: lines of the tables, [E].
    length: [m], [K, W]. part: of the difference that an end moves, [M, W]; 0 where there is none.
    """

    i: NDArray[np.int64]
    j: NDArray[np.int64]
    shift: NDArray[np.int64]
    lanes: NDArray[np.int64]
    lengths: NDArray[np.int64]
    parts_i: NDArray[np.int64]
    parts_j: NDArray[np.int64]
    length: Array
    part: Array


class Sheet(NamedTuple):
    """Where a grid's particles are among the lanes.

    rows, columns: of the grid. lanes: the columns, filled up; width: with room beside them.
    extra: rows of pins. pins: particles, [P]; free: 1 for those
    that move, [R, W]; inv_mass: [1/kg], [R, W].
    controls: wind samples, [S]; above: the first of the two sample lines around each row, [R];
    low: how far the row is towards the second, [R]; across: weights of sample columns, [C', W].
    """

    rows: int
    columns: int
    lanes: int
    width: int
    extra: int
    pins: NDArray[np.int64]
    free: Array
    inv_mass: Array
    controls: NDArray[np.int32]
    above: NDArray[np.int64]
    low: Array
    across: Array


def is_sheet(cloth: Cloth) -> bool:
    """Whether a cloth is better stepped with its columns as lanes."""
    if cloth.grid_shape is None or cloth.grid_shape[1] < LEAST_COLUMNS:
        return False
    return _hangs(cloth) or int((cloth.inv_mass == 0).sum()) <= MOST_PINS


def _hangs(cloth: Cloth) -> bool:
    """Whether a grid's pins are its top row."""
    columns = cloth.grid_shape[1] if cloth.grid_shape else 0
    return np.array_equal(np.flatnonzero(cloth.inv_mass == 0), np.arange(columns))


def sheet_of(cloth: Cloth, faces: Faces, controls: NDArray[np.int32], width: int) -> Sheet:
    """The layout, in `width` lanes."""
    assert cloth.grid_shape is not None
    rows, columns = cloth.grid_shape
    inv_mass = np.zeros((rows, width))
    inv_mass[:, :columns] = cloth.inv_mass.reshape(rows, columns)
    samples = len(np.unique(controls % columns))
    across = np.zeros((samples, width))
    for corner in range(4):
        sample = faces.controls[:columns, corner] % samples
        np.add.at(across, (sample, np.arange(columns)), faces.weights[:columns, corner])
    return Sheet(
        rows,
        columns,
        filled(columns),
        width,
        0 if _hangs(cloth) else int((cloth.inv_mass == 0).sum()),
        np.flatnonzero(cloth.inv_mass == 0),
        (inv_mass > 0).astype(float),
        inv_mass,
        controls,
        (faces.controls[::columns, 0] // samples).astype(np.int64),
        faces.weights[::columns, 2:].sum(axis=1),
        across,
    )


def sheet_width(cloth: Cloth, *pairs: NDArray[np.int32]) -> int:
    """Lanes for the columns, and beyond them for the longest way along a row."""
    assert cloth.grid_shape is not None
    columns = cloth.grid_shape[1]
    along = [np.abs(np.diff(pair % columns, axis=1)).max(initial=0) for pair in pairs]
    return filled(columns) + filled(int(max(along)))


def filled(lanes: int) -> int:
    """Lanes up to whole registers."""
    return -(-lanes // VECTOR) * VECTOR


def rows_of(
    cloth: Cloth,
    width: int,
    pairs: NDArray[np.int32],
    length: Array,
    part_i: Array,
    part_j: Array,
    together: float = TOGETHER,
) -> Rows:
    """Pairs [K, 2] in order as rows: those that follow each other between the same rows at once.

    length: [K]; part_i, part_j: [K]; together: part of the corrections along a row. Pairs with a
    pin that follow those with the same pin are taken as between the pin's own row and the
    particles.
    """
    assert cloth.grid_shape is not None
    columns = cloth.grid_shape[1]
    places = _places(cloth, pairs)
    swap = places[:, 2] < 0
    i = np.where(swap, places[:, 1], places[:, 0])
    j = np.where(swap, places[:, 0], places[:, 1])
    lane = places[:, 3] + np.where(swap, places[:, 2], 0)
    shift = np.abs(places[:, 2])
    first, second = np.where(swap, part_j, part_i), np.where(swap, part_i, part_j)
    keys = np.stack([i, j, shift], axis=1)
    starts = np.flatnonzero(np.r_[True, (keys[1:] != keys[:-1]).any(axis=1)][: len(keys)])
    entry = np.zeros(len(keys), np.int64)
    entry[starts[1:]] = 1
    entry = np.cumsum(entry)
    count = len(starts)
    lengths = np.ones((count, width))
    parts = np.zeros((2, count, width))
    lengths[entry, lane] = length
    along = np.where((i == j) & (shift > 0), together, 1.0)
    parts[0, entry, lane], parts[1, entry, lane] = first * along, second * along
    length_table, length_lines = _table(lengths)
    part_table, part_lines = _table(parts.reshape(2 * count, width))
    last = np.zeros(count, np.int64)
    np.maximum.at(last, entry, lane)
    return Rows(
        i[starts],
        j[starts],
        shift[starts],
        np.minimum(-(-(last + 1) // VECTOR) * VECTOR, filled(columns)),
        length_lines,
        part_lines[:count],
        part_lines[count:],
        length_table,
        part_table,
    )


def _places(cloth: Cloth, pairs: NDArray[np.int32]) -> NDArray[np.int64]:
    """Row of a and of b, shift from a to b, lane of a, [K, 4]."""
    assert cloth.grid_shape is not None
    rows, columns = cloth.grid_shape
    row, lane = np.divmod(pairs.astype(np.int64), columns)
    pins = np.flatnonzero(cloth.inv_mass == 0)
    shift, at = lane[:, 1] - lane[:, 0], lane[:, 0].copy()
    if not _hangs(cloth):
        for number, pin in enumerate(pins):
            held = pairs[:, 0] == pin
            row[held, 0], shift[held], at[held] = rows + number, 0, lane[held, 1]
    return np.stack([row[:, 0], row[:, 1], shift, at], axis=1)


def _table(lines: Array) -> tuple[Array, NDArray[np.int64]]:
    """Each different line once, and which each was."""
    if not len(lines):
        return np.ones((1, lines.shape[1])), np.zeros(0, np.int64)
    table, number = np.unique(lines, axis=0, return_inverse=True)
    return table, number.ravel().astype(np.int64)
