"""A piece of thin cloth: what is drawn around its particles, wherever they are."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Mask, Triangles, Vectors
from drapery.errors import OptionError
from drapery.mesh import Array, Mesh
from drapery.render.scene import Material, TextureLayer
from drapery.style.extrusion import Shell, make_shell
from drapery.style.refinement import cover_curves
from drapery.style.uv_mapping import UVMapping

MaterialAt = Callable[[float], Material]
"""The material at a time [s]; the same object for as long as it looks the same."""

WHITE = Material((TextureLayer(np.full((1, 1, 4), 255, np.uint8)),))
"""The material of a piece that has none of its own."""


@dataclass(frozen=True, eq=False)
class Piece:
    """Thin cloth before it gets its thickness; what the motion and shape steps of a style change.

    A step gets it with the positions of its vertices [m], row by row from the top left: shape
    [N, 3] of one moment, [F, N, 3] of F moments; y is up and the front looks to +z at rest.

    shell: its triangles, its texture coordinates and the surface around it.
    thickness: of the cloth [m].
    texel: the edge of a texel [m].
    size: width and height at rest [m].
    material_at: its material at a time [s].
    name: in 3-D files.
    facets: whether edges are sharp.
    finer: the shell around curves through the particles of a whole grid, which is drawn; None
        where `shell` is, as in all that shape steps get.
    """

    shell: Shell
    thickness: float
    texel: float
    size: tuple[float, float]
    material_at: MaterialAt = lambda time: WHITE
    name: str = ""
    facets: bool = False
    finer: Shell | None = None

    @property
    def grid_shape(self) -> tuple[int, int]:
        """Rows and columns of vertices. Raises OptionError for a piece with cells cut out."""
        if self.shell.grid is None:
            raise OptionError("this step needs a whole sheet; put it before the step that cuts it")
        return self.shell.grid

    def rows(self, positions: Vectors) -> Vectors:
        """Positions [..., N, 3] as rows and columns, shape [..., rows, columns, 3].

        Raises OptionError for a piece with cells cut out.
        """
        return positions.reshape(*positions.shape[:-2], *self.grid_shape, 3)

    def without_cells(self, kept: Mask, uv_mapping: UVMapping) -> "Piece":
        """The piece with only some of its cells.

        kept: which cells stay, shape [rows - 1, columns - 1].
        uv_mapping: where its front, back and new rim lie on the texture.

        Raises OptionError for a piece with cells cut out.
        """
        (rows, columns), whole = self.grid_shape, self.shell
        middles = whole.sheet_uvs[whole.sheet].mean(axis=1)
        column = (middles[:, 0] * (columns - 1)).astype(np.int32)
        row = (middles[:, 1] * (rows - 1)).astype(np.int32)
        cut = make_shell(whole.sheet[kept[row, column]], whole.sheet_uvs, uv_mapping)
        return replace(self, shell=cut)

    def mesh(self, positions: Vectors, normals: Vectors | None = None) -> Mesh:
        """The closed mesh: two sheets and a rim, along the normals or with sharp edges.

        positions: of its vertices [m], shape [..., N, 3].
        normals: of them, shape [..., N, 3]; the averaged ones of its own triangles unless given.
        """
        if normals is None:
            normals = self.shell.normals(positions)
        if self.finer is not None:
            return cover_curves(self.finer, self.grid_shape, positions, normals, self.thickness)
        thick = self.shell.cover(positions, normals, self.thickness)
        return _faceted(thick, self.shell) if self.facets else thick


def _faceted(mesh: Mesh, shell: Shell) -> Mesh:
    """The same surface, each triangle with vertices and a normal of its own."""
    corners, triangles, uvs = _corners(shell)
    points = mesh.positions[corners]
    a, b, c = points[0::3], points[1::3], points[2::3]
    across = np.cross(b - a, c - a)
    length = np.sqrt((across * across).sum(axis=-1, keepdims=True))
    normals = np.repeat(across / np.maximum(length, 1e-12), 3, axis=0)
    return Mesh(points, normals, triangles, uvs)


@lru_cache(maxsize=64)
def _corners(shell: Shell) -> tuple[NDArray[np.int32], Triangles, Array]:
    """The vertex of each corner of a shell, [3 T], and the triangles and UVs of its facets."""
    corners = shell.triangles.reshape(-1)
    triangles = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    return corners, triangles, shell.uvs[corners]
