"""The thick cloth that a page plays without Python: the vertices of `thicken`, by a kernel."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.jit import entry_point
from drapery.mesh import Array, Triangles
from drapery.render.light import Light
from drapery.style.crowds import cover_sheets, faces_around, least_lengths
from drapery.style.extrusion import THINNEST, Shell

__all__ = ["LiveShell", "cover", "make_live_shell"]


class LiveShell(NamedTuple):
    """A shell, where it lies, and its V vertices as `cover` writes them.

    triangles, starts, faces, rim: of the thin sheet; see `cover_sheets`. half: half the thickness
    [m]. flat, tiny: see `least_lengths`. place: of the panel [m], [3]. turn, middle: rotation of
    the body, [3, 3], and the point about which it turns [m], [3]. lights: unit vectors, [L, 3].
    levels: ambient and diffuse light, [2]. sheet, points, units: scratch for the sheet [1, N, 3]
    and its shell [1, V, 3] before it is turned.
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
    vertices: Array
    normals: Array
    light: Array


def make_live_shell(
    shell: Shell, place: Array, thickness: float, light: Light, turn: Array, middle: Array
) -> LiveShell:
    """The shell of a panel. thickness: [m]; for the others see `LiveShell`."""
    count = len(shell.uvs)
    flat, tiny = least_lengths(np.float64)
    return LiveShell(
        np.ascontiguousarray(shell.sheet),
        *faces_around(shell),
        np.ascontiguousarray(shell.rim),
        max(thickness, THINNEST) / 2.0,
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
    cover_sheets(
        0,
        1,
        shell.sheet,
        shell.triangles,
        shell.starts,
        shell.faces,
        shell.rim,
        shell.half,
        (shell.flat, shell.tiny),
        shell.points,
        shell.units,
    )
    for v in range(shell.vertices.shape[0]):
        x = shell.points[0, v, 0] - shell.middle[0]
        y = shell.points[0, v, 1] - shell.middle[1]
        z = shell.points[0, v, 2] - shell.middle[2]
        for axis in range(3):
            a, b, c = shell.turn[axis, 0], shell.turn[axis, 1], shell.turn[axis, 2]
            shell.vertices[v, axis] = a * x + b * y + c * z + shell.middle[axis]
            u, w = shell.units[0, v, 0], shell.units[0, v, 2]
            shell.normals[v, axis] = a * u + b * shell.units[0, v, 1] + c * w
        level = shell.levels[0]
        for light in range(shell.lights.shape[0]):
            facing = 0.0
            for axis in range(3):
                facing += shell.normals[v, axis] * shell.lights[light, axis]
            level += shell.levels[1] * max(facing, 0.0)
        shell.light[v] = min(level, 1.0)
    return 0
