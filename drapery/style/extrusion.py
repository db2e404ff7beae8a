"""Thickness: a sheet becomes a closed shell of two sheets and a rim.

Every vertex moves half the thickness forwards and backwards along the average of its faces'
normals, so the two sheets keep the sheet's UVs and never open a gap; the boundary is closed by a
rim of quads.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Integers, Pairs, Triangles, UVs, Vectors
from drapery.mesh import Array, Mesh, faces_around, normals_around
from drapery.style.uv_mapping import SHEET_MAPPING, UVMapping

THINNEST = 2e-4
"""The least distance between the two sheets [m]: from each side the nearer one must be seen."""


def boundary_edges(triangles: Triangles) -> Pairs:
    """The edges of only one triangle, shape [E, 2], in the direction of that triangle.

    triangles: vertex indices, shape [T, 3].
    """
    edges = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    _, first, count = np.unique(
        np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True
    )
    open_edges: NDArray[np.int32] = edges[np.sort(first[count == 1])]
    return open_edges


@dataclass(frozen=True, eq=False)
class Shell:
    """The constant part of a thick cloth: how its vertices follow from those of the thin one.

    The vertices are the front sheet, the back sheet, then four for each edge of the rim.
    count: vertices of the thin sheet.
    sheet: triangles of the thin sheet, shape [T, 3].
    rim: boundary edges of the thin sheet, shape [E, 2].
    uvs: texture coordinates of all vertices, shape [2 N + 4 E, 2].
    sheet_uvs: texture coordinates of the thin sheet 0..1, shape [N, 2].
    uv_mapping: how `uvs` follow from them.
    grid: (rows, columns) where the thin sheet is a whole grid, vertex = row * columns + column;
        None for other sheets.
    """

    count: int
    sheet: Triangles
    rim: Pairs
    uvs: UVs
    sheet_uvs: UVs
    uv_mapping: UVMapping = SHEET_MAPPING
    grid: tuple[int, int] | None = None

    @cached_property
    def triangles(self) -> Triangles:
        """Triangles of the closed shell, seen from outside counter-clockwise."""
        first = 2 * self.count + 4 * np.arange(len(self.rim), dtype=np.int32)[:, None]
        # Corners of a rim quad: start and end on the front sheet, then on the back sheet.
        quads = first + np.array([[0, 2, 3], [0, 3, 1]], np.int32).reshape(1, 6)
        parts = [self.sheet, self.sheet[:, ::-1] + self.count, quads.reshape(-1, 3)]
        return np.ascontiguousarray(np.concatenate(parts), np.int32)

    @cached_property
    def _around(self) -> NDArray[np.intp]:
        """The triangles at each vertex of the thin sheet; see `faces_around`."""
        return faces_around(self.sheet, self.count)

    @cached_property
    def runs_around(self) -> tuple[Integers, Integers]:
        """starts [N + 1] and triangles [3 T]: those at vertex i are starts[i] to starts[i + 1]."""
        corners = self.sheet.T.reshape(-1)
        order = np.argsort(corners, kind="stable")
        starts = np.concatenate([[0], np.cumsum(np.bincount(corners, minlength=self.count))])
        return starts, order % max(1, len(self.sheet))

    def normals(self, positions: Vectors) -> Vectors:
        """The averaged normals of thin sheets [m], both of shape [..., N, 3]."""
        return normals_around(positions, self.sheet, self._around)

    def cover(self, positions: Vectors, normals: Vectors, thickness: float) -> Mesh:
        """The shells around thin sheets: each vertex moves half the thickness along its normal.

        positions: [m], shape [..., N, 3].
        normals: unit vectors, shape [..., N, 3].
        thickness: distance between the two sheets [m]; at least THINNEST is drawn.
        """
        half = positions.dtype.type(max(thickness, THINNEST) / 2.0)
        front, back = positions + half * normals, positions - half * normals
        start, end = self.rim[:, 0], self.rim[:, 1]
        corners = [front[..., start, :], front[..., end, :], back[..., start, :], back[..., end, :]]
        outward = _unit(
            np.cross(
                positions[..., end, :] - positions[..., start, :],
                normals[..., start, :] + normals[..., end, :],
            )
        )
        return Mesh(
            np.concatenate([front, back, _interleave(corners)], axis=-2),
            np.concatenate([normals, -normals, _interleave([outward] * 4)], axis=-2),
            self.triangles,
            self.uvs,
        )


def make_shell(
    triangles: Triangles,
    uvs: UVs,
    uv_mapping: UVMapping = SHEET_MAPPING,
    grid: tuple[int, int] | None = None,
) -> Shell:
    """The constant part of thick cloths that share their triangles and texture coordinates.

    `Shell.cover` makes the mesh at each moment.

    triangles: of the thin sheet, shape [T, 3].
    uvs: its texture coordinates 0..1, shape [N, 2].
    uv_mapping: where its front, back and rim lie on the texture; the same picture on both sides
        unless given.
    grid: (rows, columns) of a sheet that is a whole grid, which styles can change.
    """
    rim = boundary_edges(triangles)
    sheets = [uv_mapping.front(uvs), uv_mapping.back(uvs)]
    every = np.concatenate([*sheets, uv_mapping.rim(uvs, rim)])
    return Shell(len(uvs), triangles, rim, every, uvs, uv_mapping, grid)


def thicken(shell: Shell, sheet: Array, thickness: float) -> Mesh:
    """The shells around thin sheets, along the averaged normals of their own faces.

    sheet: positions [m], shape [..., N, 3]. thickness: distance between the two sheets [m].
    """
    return shell.cover(sheet, shell.normals(sheet), thickness)


def extrude(mesh: Mesh, thickness: float, uv_mapping: UVMapping = SHEET_MAPPING) -> Mesh:
    """Give a thin mesh a thickness: front and back sheets and a closed rim.

    For moving cloth, make the shell once with `make_shell`, and `cover` each moment.

    mesh: its normals point forwards; give averaged ones (`drapery.render.vertex_normals`).
    thickness: distance between the two sheets [m].
    uv_mapping: where front, back and rim lie on the texture, see `make_shell`.
    """
    shell = make_shell(mesh.triangles, mesh.uvs, uv_mapping)
    return shell.cover(mesh.positions, mesh.normals, thickness)


def _interleave(corners: Sequence[Array]) -> Array:
    """[..., E, 3] for each of four corners -> [..., 4 E, 3], an edge's corners together."""
    stacked = np.stack(corners, axis=-2)
    *batch, edges, count, _ = stacked.shape
    return stacked.reshape(*batch, edges * count, 3)


def _unit(vectors: Array) -> Array:
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    unit: Array = vectors / np.maximum(lengths, np.finfo(vectors.dtype).tiny)
    return unit
