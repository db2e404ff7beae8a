"""Thin cloth between simulation and picture, from which the thick one is made."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError
from drapery.mesh import Array, Mesh, Triangles
from drapery.style.extrusion import Shell, make_shell, thicken
from drapery.style.refinement import cover_curves
from drapery.style.uv_mapping import UVMapping


@dataclass(frozen=True, eq=False)
class Sheet:
    """Cloth before it gets its thickness: what the motion and shape steps of a style change.

    positions: of the particles [m], shape [N, 3] row by row from the top left, or [F, N, 3] for the
        F moments of a motion, or for F equal cloths; y is up and the front looks to +z at rest.
    shell: its triangles, its texture coordinates and the surface around it.
    thickness: of the cloth [m].
    texel: the edge of a texel [m].
    size: width and height [m].
    facets: whether edges are sharp.
    finer: the shell around curves through the particles of a whole grid, which is drawn; None
        where `shell` is, as in all that shape steps get.
    """

    positions: Array
    shell: Shell
    thickness: float
    texel: float
    size: tuple[float, float]
    facets: bool = False
    finer: Shell | None = None

    @property
    def grid_shape(self) -> tuple[int, int]:
        """Rows and columns of particles. Raises OptionError for a sheet with cells cut out."""
        if self.shell.grid is None:
            raise OptionError("this step needs a whole sheet; put it before the step that cuts it")
        return self.shell.grid

    @property
    def grid(self) -> Array:
        """The positions as rows and columns, shape [..., rows, columns, 3].

        Raises OptionError for a sheet with cells cut out.
        """
        return self.positions.reshape(*self.positions.shape[:-2], *self.grid_shape, 3)

    def without_cells(self, kept: NDArray[np.bool_], uv_mapping: UVMapping) -> "Sheet":
        """The sheet with only the cells that are kept, shape [rows - 1, columns - 1].

        uv_mapping: where its front, back and new rim lie on the texture.
        Raises OptionError for a sheet with cells cut out.
        """
        (rows, columns), whole = self.grid_shape, self.shell
        middles = whole.sheet_uvs[whole.sheet].mean(axis=1)
        column = (middles[:, 0] * (columns - 1)).astype(np.int32)
        row = (middles[:, 1] * (rows - 1)).astype(np.int32)
        cut = make_shell(whole.sheet[kept[row, column]], whole.sheet_uvs, uv_mapping)
        return replace(self, shell=cut)

    def mesh(self) -> Mesh:
        """The closed mesh: two sheets and a rim, along the averaged normals or with sharp edges."""
        if self.finer is not None:
            normals = self.shell.normals(self.positions)
            shape = self.grid_shape
            return cover_curves(self.finer, shape, self.positions, normals, self.thickness)
        thick = thicken(self.shell, self.positions, self.thickness)
        return faceted(thick, _corners(self.shell)) if self.facets else thick


def faceted(mesh: Mesh, flat: "FlatCorners") -> Mesh:
    """The same surface, each triangle with vertices and a normal of its own."""
    points = mesh.positions[flat.corners]
    a, b, c = points[0::3], points[1::3], points[2::3]
    across = np.cross(b - a, c - a)
    length = np.sqrt((across * across).sum(axis=-1, keepdims=True))
    normals = np.repeat(across / np.maximum(length, 1e-12), 3, axis=0)
    return Mesh(points, normals, flat.triangles, flat.uvs)


@dataclass(frozen=True, eq=False)
class FlatCorners:
    """The constant part of a surface of facets: the vertex of each corner, shape [3 T]."""

    corners: NDArray[np.int32]
    triangles: Triangles
    uvs: Array


@lru_cache(maxsize=64)
def _corners(shell: Shell) -> FlatCorners:
    corners = shell.triangles.reshape(-1)
    triangles = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    return FlatCorners(corners, triangles, shell.uvs[corners])
