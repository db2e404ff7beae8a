"""The thick cloth that a page plays without Python: the vertices of `thicken`, by a kernel."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Triangles
from drapery.jit import entry_point, kernel
from drapery.mesh import Array
from drapery.render.light import Light
from drapery.style.crowds import average_normals, cover_sheet, least_lengths
from drapery.style.extrusion import THINNEST
from drapery.style.piece import Piece
from drapery.style.refinement import cover_finer

__all__ = ["LiveShell", "cover", "make_live_shell", "show"]


class LiveShell(NamedTuple):
    """A shell, where it lies, and its V vertices as `cover` writes them.

    triangles, starts, faces, rim: of the thin sheet; see `cover_sheets`. half: half the thickness
    [m]. flat, tiny: see `least_lengths`. place: of the panel [m], [3]. turn, middle: rotation of
    the body, [3, 3], and the point about which it turns [m], [3]. lights: unit vectors, [L, 3].
    levels: ambient and diffuse light, [2]. sheet, points, units: scratch for the sheet [1, N, 3]
    and its shell [1, V, 3] before it is turned. grid, finer: rows and columns of the sheet and of
    the curves through it that the shell is around, [2]; equal where it is around the sheet.
    vertices: [m], [V, 3]. normals: [V, 3]. light: 0..1, [V].
    """

    triangles: Triangles
    starts: NDArray[np.int64]
    faces: NDArray[np.int64]
    rim: NDArray[np.int32]
    half: float
    flat: float
    tiny: float
    place: Array
    turn: Array
    middle: Array
    lights: Array
    levels: Array
    sheet: Array
    points: Array
    units: Array
    grid: NDArray[np.int64]
    finer: NDArray[np.int64]
    vertices: Array
    normals: Array
    light: Array


def make_live_shell(
    piece: Piece, place: Array, light: Light, turn: Array, middle: Array
) -> LiveShell:
    """The shell of a piece at rest.

    piece: the cloth, drawn around curves through its particles if it has a `finer` shell.
    place: of its frame [m], shape [3].
    light: the light on it.
    turn: rotation of the body, shape [3, 3].
    middle: the point about which it turns [m], shape [3].
    """
    shell, drawn = piece.shell, piece.finer or piece.shell
    count = len(drawn.uvs)
    flat, tiny = least_lengths(np.float64)
    return LiveShell(
        np.ascontiguousarray(shell.sheet),
        *shell.runs_around,
        np.ascontiguousarray(drawn.rim),
        max(piece.thickness, THINNEST) / 2.0,
        float(flat),
        float(tiny),
        np.array(place, float),
        np.array(turn, float),
        np.array(middle, float),
        light.unit_directions(),
        np.array([light.ambient, light.diffuse], float),
        np.zeros((1, shell.count, 3)),
        np.zeros((1, count, 3)),
        np.zeros((1, count, 3)),
        np.array(shell.grid or (0, 0), np.int64),
        np.array(drawn.grid or (0, 0), np.int64),
        np.zeros((count, 3), np.float32),
        np.zeros((count, 3), np.float32),
        np.zeros(count, np.float32),
    )


@entry_point
def cover(positions: Any, shell: Any) -> Any:
    """Write the vertices of the shell around a thin sheet. positions: [m], [N, 3]. Returns 0."""
    for i in range(positions.shape[0]):
        for axis in range(3):
            shell.sheet[0, i, axis] = positions[i, axis] + shell.place[axis]
    sheet, points, units = shell.sheet[0], shell.points[0], shell.units[0]
    across = np.empty((len(shell.triangles), 3))
    around = shell.triangles, shell.starts, shell.faces
    if shell.grid[0] == shell.finer[0]:
        average_normals(sheet, *around, shell.flat, across, units)
        cover_sheet(sheet, shell.rim, shell.half, shell.tiny, points, units)
    else:
        normals = np.empty((sheet.shape[0], 3))
        average_normals(sheet, *around, shell.flat, across, normals)
        cover_finer(
            sheet,
            normals,
            (shell.grid[0], shell.grid[1]),
            (shell.finer[0], shell.finer[1]),
            shell.rim,
            shell.half,
            (shell.flat, shell.tiny),
            points,
            units,
        )
    for v in range(shell.vertices.shape[0]):
        show(shell, v, vector_at(shell.points[0], v), vector_at(shell.units[0], v))
    return 0


@kernel
def vector_at(rows: Any, number: Any) -> Any:
    """A row of [V, 3]."""
    return rows[number, 0], rows[number, 1], rows[number, 2]


@kernel
def show(shown: Any, v: Any, point: Any, unit: Any) -> None:
    """Write vertex v of what is shown: turned with the body, and its light.

    point: [m]; unit: its normal, both before the body is turned. shown: a `LiveShell` or the like.
    """
    x, y, z = point[0] - shown.middle[0], point[1] - shown.middle[1], point[2] - shown.middle[2]
    for axis in range(3):
        a, b, c = shown.turn[axis, 0], shown.turn[axis, 1], shown.turn[axis, 2]
        shown.vertices[v, axis] = a * x + b * y + c * z + shown.middle[axis]
        shown.normals[v, axis] = a * unit[0] + b * unit[1] + c * unit[2]
    level = shown.levels[0]
    for light in range(shown.lights.shape[0]):
        facing = 0.0
        for axis in range(3):
            facing += shown.normals[v, axis] * shown.lights[light, axis]
        level += shown.levels[1] * max(facing, 0.0)
    shown.light[v] = min(level, 1.0)
