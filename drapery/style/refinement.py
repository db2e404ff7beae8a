"""Finer grids of points on a simulated one, so that large pictures show curves and not its cells.

The curves are those of Catmull and Rom, "A class of local interpolating splines" (1974): they go
through the particles, so a finer surface moves as the simulated one does. Beyond the ends of a row
the first and last piece go on straight.
"""

import math
from typing import Any

import numpy as np

from drapery.errors import OptionError
from drapery.jit import entry_point, kernel
from drapery.mesh import Array, Mesh
from drapery.style.crowds import cover_sheet, least_lengths
from drapery.style.extrusion import THINNEST, Shell

FROM_SIDE = 640
"""Smaller pictures show the simulated grid, whose cells are few pixels wide."""
EDGE = 8.0
"""The longest edge of a cell in a picture [pixels], for cloth as high as the picture. In silk at
25 m/s such an edge lies less than half a pixel beside its curve."""
MAX_SIDE = 257
"""The most points along one side of a finer grid."""


def cells_per_cell(size: tuple[int, int], shape: tuple[int, int], share: float = 1.0) -> int:
    """How many cells a picture shows along each cell of a simulated grid.

    size: width and height of the picture [pixels]. shape: rows and columns of the grid.
    share: the height of the cloth over the height of all that the picture shows.
    """
    if max(size) < FROM_SIDE:
        return 1
    width, height = size
    rows, columns = shape
    cell = share * min(height / (rows - 1), width / (columns - 1))
    most = (MAX_SIDE - 1) // (max(shape) - 1)
    return max(1, min(math.ceil(cell / EDGE), most))


def finer_shape(shape: tuple[int, int], times: int) -> tuple[int, int]:
    """Rows and columns of a grid with `times` cells along each cell."""
    rows, columns = ((side - 1) * times + 1 for side in shape)
    return rows, columns


def on_curves(points: Array, shape: tuple[int, int], to: tuple[int, int]) -> Array:
    """Evenly spaced points of a grid, on curves through it.

    points: shape [..., N, 3], row by row. shape, to: rows and columns of the grid and of the new
    one, at least 2. Returns shape [..., M, 3].
    """
    batch = points.shape[:-2]
    grids = np.ascontiguousarray(points, np.float64).reshape(-1, *shape, 3)
    between, found = np.empty((to[0], shape[1], 3)), np.empty((len(grids), *to, 3))
    for grid, fine in zip(grids, found, strict=True):
        refine(grid, between, fine)
    return found.reshape(*batch, to[0] * to[1], 3)


def cover_curves(
    finer: Shell, shape: tuple[int, int], positions: Array, normals: Array, thickness: float
) -> Mesh:
    """The shell around curves through the particles of a grid, as `Shell.cover` makes it.

    Its normals, too, lie on curves through those of the particles (Vlachos et al., "Curved PN
    triangles", 2001, section 3.3): the normals of its own triangles would show where the curves
    bend unevenly.
    finer: the shell, of a whole grid. shape: rows and columns of the particles.
    positions, normals: of the particles [m] and unit, shape [N, 3].
    thickness: distance between the two sheets [m]; at least THINNEST is drawn.
    Raises OptionError for a shell that is no whole grid.
    """
    if finer.grid is None:
        raise OptionError("curves need the shell of a whole grid; this one has cells cut out")
    count = len(finer.uvs)
    points, units = np.empty((count, 3)), np.empty((count, 3))
    half, least = max(thickness, THINNEST) / 2.0, tuple(map(float, least_lengths(np.float64)))
    sheet, along = (np.ascontiguousarray(each, np.float64) for each in (positions, normals))
    cover_finer(sheet, along, shape, finer.grid, finer.rim, half, least, points, units)
    return Mesh(points, units, finer.triangles, finer.uvs)


@entry_point
def cover_finer(
    sheet: Any,
    normals: Any,
    shape: Any,
    to: Any,
    rim: Any,
    half: Any,
    least: Any,
    points: Any,
    units: Any,
) -> None:
    """Write the shell around curves through a sheet; see `cover_curves`.

    sheet, normals: [N, 3]. shape, to: rows and columns of the sheet and of the curves.
    rim: of the shell, [E, 2]. half: half the thickness [m]. least: see `least_lengths`.
    points, units: vertices of the shell [m] and their normals, [V, 3].
    """
    (rows, columns), (fine_rows, fine_columns) = shape, to
    flat, tiny = least
    grid = np.empty((rows, columns, 6))
    for row in range(rows):
        for column in range(columns):
            for axis in range(3):
                grid[row, column, axis] = sheet[row * columns + column, axis]
                grid[row, column, axis + 3] = normals[row * columns + column, axis]
    between = np.empty((fine_rows, columns, 6))
    fine = np.empty((fine_rows, fine_columns, 6))
    refine(grid, between, fine)
    curved = np.empty((fine_rows * fine_columns, 3))
    for row in range(fine_rows):
        for column in range(fine_columns):
            v = row * fine_columns + column
            x, y, z = fine[row, column, 3], fine[row, column, 4], fine[row, column, 5]
            length = np.sqrt(x * x + y * y + z * z)
            if length < flat:
                x, y, z, length = 0.0, 0.0, 1.0, 1.0
            units[v, 0], units[v, 1], units[v, 2] = x / length, y / length, z / length
            for axis in range(3):
                curved[v, axis] = fine[row, column, axis]
    cover_sheet(curved, rim, half, tiny, points, units)


@entry_point
def refine(grid: Any, between: Any, fine: Any) -> None:
    """Write evenly spaced points on curves through a grid, first down, then across.

    grid: shape [R, C, K]. between: scratch of shape [rows, C, K]. fine: shape [rows, columns, K].
    """
    given, made = grid.shape[0], between.shape[0]
    for row in range(made):
        at = row * (given - 1) / (made - 1)
        low = min(int(at), given - 2)
        for column in range(grid.shape[1]):
            for k in range(grid.shape[2]):
                start, end = grid[low, column, k], grid[low + 1, column, k]
                before, after = 2 * start - end, 2 * end - start
                if low > 0:
                    before = grid[low - 1, column, k]
                if low < given - 2:
                    after = grid[low + 2, column, k]
                between[row, column, k] = _curve(before, start, end, after, at - low)
    given, made = grid.shape[1], fine.shape[1]
    for column in range(made):
        at = column * (given - 1) / (made - 1)
        low = min(int(at), given - 2)
        for row in range(fine.shape[0]):
            for k in range(grid.shape[2]):
                start, end = between[row, low, k], between[row, low + 1, k]
                before, after = 2 * start - end, 2 * end - start
                if low > 0:
                    before = between[row, low - 1, k]
                if low < given - 2:
                    after = between[row, low + 2, k]
                fine[row, column, k] = _curve(before, start, end, after, at - low)


@kernel
def _curve(before: Any, start: Any, end: Any, after: Any, t: Any) -> Any:
    """The curve between two points at t in 0..1."""
    third = 3 * (start - end) + after - before
    return start + 0.5 * t * (
        end - before + t * (2 * before - 5 * start + 4 * end - after + t * third)
    )
