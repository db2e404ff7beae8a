"""Thickness for many cloths at once: what `Shell.cover` does, in one pass over the memory.

For the cloths of a picture it would not be worth its compilation; for thousands, or for one that is
shown again and again, it is several times faster, and the numbers are the same.
"""

from typing import Any

import numpy as np

from drapery.arrays import Vectors
from drapery.jit import entry_point, kernel
from drapery.mesh import Mesh
from drapery.render.workers import run_parts, worker_count
from drapery.style.extrusion import THINNEST, Shell


def cover_crowd(shell: Shell, positions: Vectors, thickness: float) -> Mesh:
    """Shells around thin sheets, along the averaged normals of their faces.

    shell: the constant part of each.
    positions: [m], shape [B, N, 3], of single or double precision, which the shells have too.
    thickness: distance between the two sheets [m]; at least THINNEST is drawn.
    """
    sheets = np.require(positions, positions.dtype, ["C", "W"])
    count, real = len(sheets), positions.dtype.type
    shape = count, len(shell.uvs), 3
    points, normals = np.empty(shape, real), np.empty(shape, real)
    starts, faces = shell.runs_around
    half = real(max(thickness, THINNEST) / 2.0)
    parts = min(count, 8 * worker_count())

    def run(part: int) -> None:
        first, last = (count * (part + step) // parts for step in range(2))
        cover_sheets(
            first,
            last,
            sheets,
            shell.sheet,
            starts,
            faces,
            shell.rim,
            half,
            least_lengths(real),
            points,
            normals,
        )

    run_parts(run, parts, worker_count())
    return Mesh(points, normals, shell.triangles, shell.uvs)


def least_lengths(dtype: type[np.floating[Any]]) -> tuple[Any, Any]:
    """Shorter sums of normals give a vertex (0, 0, 1); the least length of a rim's normal."""
    tiny = np.finfo(dtype).tiny
    return dtype(tiny**0.5), dtype(tiny)


@kernel
def _cross(ux: Any, uy: Any, uz: Any, vx: Any, vy: Any, vz: Any) -> Any:
    return uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx


@entry_point
def cover_sheets(
    first: Any,
    last: Any,
    sheets: Any,
    triangles: Any,
    starts: Any,
    faces: Any,
    rim: Any,
    half: Any,
    least: Any,
    points: Any,
    normals: Any,
) -> None:
    """Write the shells of sheets first..last - 1; arrays as in `cover_crowd` and `Shell`.

    least: see `least_lengths`. All are of one floating-point type.
    """
    across = np.empty((len(triangles), 3), sheets.dtype)
    flat, tiny = least
    for b in range(first, last):
        average_normals(sheets[b], triangles, starts, faces, flat, across, normals[b])
        cover_sheet(sheets[b], rim, half, tiny, points[b], normals[b])


@kernel
def average_normals(
    sheet: Any, triangles: Any, starts: Any, faces: Any, flat: Any, across: Any, normals: Any
) -> None:
    """Write the unit normal at each particle of a sheet: the average of those of its faces.

    across: scratch for the normals of the faces, shape [T, 3]; for the others see `cover_sheets`.
    """
    F = sheet.dtype.type
    for t in range(len(triangles)):
        i, j, k = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        x, y, z = sheet[i, 0], sheet[i, 1], sheet[i, 2]
        across[t, 0], across[t, 1], across[t, 2] = _cross(
            sheet[j, 0] - x,
            sheet[j, 1] - y,
            sheet[j, 2] - z,
            sheet[k, 0] - x,
            sheet[k, 1] - y,
            sheet[k, 2] - z,
        )
    for v in range(sheet.shape[0]):
        nx = ny = nz = F(0)
        for at in range(starts[v], starts[v + 1]):
            face = faces[at]
            nx, ny, nz = nx + across[face, 0], ny + across[face, 1], nz + across[face, 2]
        length = np.sqrt(nx * nx + ny * ny + nz * nz)
        if length < flat:
            nx, ny, nz = F(0), F(0), F(1)
        else:
            nx, ny, nz = nx / length, ny / length, nz / length
        normals[v, 0], normals[v, 1], normals[v, 2] = nx, ny, nz


@kernel
def cover_sheet(sheet: Any, rim: Any, half: Any, tiny: Any, points: Any, normals: Any) -> None:
    """Write the shell of a sheet. normals: those of the sheet are its first rows."""
    count = sheet.shape[0]
    for v in range(count):
        for axis in range(3):
            n = normals[v, axis]
            normals[count + v, axis] = -n
            points[v, axis] = sheet[v, axis] + half * n
            points[count + v, axis] = sheet[v, axis] - half * n
    for e in range(len(rim)):
        i, j = rim[e, 0], rim[e, 1]
        ox, oy, oz = _cross(
            sheet[j, 0] - sheet[i, 0],
            sheet[j, 1] - sheet[i, 1],
            sheet[j, 2] - sheet[i, 2],
            normals[i, 0] + normals[j, 0],
            normals[i, 1] + normals[j, 1],
            normals[i, 2] + normals[j, 2],
        )
        length = max(np.sqrt(ox * ox + oy * oy + oz * oz), tiny)
        corner = 2 * count + 4 * e
        for c in range(4):
            normals[corner + c, 0] = ox / length
            normals[corner + c, 1] = oy / length
            normals[corner + c, 2] = oz / length
        for axis in range(3):
            points[corner, axis] = points[i, axis]
            points[corner + 1, axis] = points[j, axis]
            points[corner + 2, axis] = points[count + i, axis]
            points[corner + 3, axis] = points[count + j, axis]
