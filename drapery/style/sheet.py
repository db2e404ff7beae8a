"""Cloth between simulation and picture: what the motion and shape steps of a style change."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from drapery.cloth import grid
from drapery.errors import OptionError
from drapery.mesh import Array, Mesh, Triangles
from drapery.style.extrusion import Shell, make_shell, thicken
from drapery.style.uv_mapping import UVMapping


@dataclass(frozen=True, eq=False)
class Lattice:
    """The constant part of a sheet: a grid of particles, of which some cells may be cut out.

    rows, columns: of particles. triangles: [T, 3]. uvs: of the particles, 0..1 over the face from
    its top left, shape [N, 2]. cut: whether cells are missing.
    """

    rows: int
    columns: int
    triangles: Triangles
    uvs: Array
    cut: bool = False


@lru_cache(maxsize=64)
def grid_lattice(rows: int, columns: int) -> Lattice:
    """A whole grid with the triangles of a cloth; the same object for the same numbers."""
    cloth = grid(columns, rows, 1.0, 1.0, pins="none")
    return Lattice(rows, columns, cloth.triangles, cloth.uvs)


def without_cells(lattice: Lattice, kept: NDArray[np.bool_]) -> Lattice:
    """The lattice with only the cells that are kept, shape [rows - 1, columns - 1]."""
    middles = lattice.uvs[lattice.triangles].mean(axis=1)
    column = (middles[:, 0] * (lattice.columns - 1)).astype(np.int32)
    row = (middles[:, 1] * (lattice.rows - 1)).astype(np.int32)
    return replace(lattice, triangles=lattice.triangles[kept[row, column]], cut=True)


@dataclass(frozen=True, eq=False)
class Sheet:
    """One panel of cloth as a thin grid, before it gets its thickness.

    positions: of the particles [m], shape [N, 3] row by row from the top left, or [F, N, 3] for the
        F moments of a motion; y is up and the front looks to +z at rest.
    lattice: its triangles and texture coordinates.
    thickness: of the cloth [m]. texel: the edge of a texel [m]. size: width and height [m].
    uv_mapping: where front, back and rim lie on the texture. facets: whether edges are sharp.
    """

    positions: Array
    lattice: Lattice
    thickness: float
    texel: float
    size: tuple[float, float]
    uv_mapping: UVMapping
    facets: bool = False

    @property
    def grid(self) -> Array:
        """The positions as rows and columns, shape [..., rows, columns, 3].

        Raises OptionError for a sheet with cells cut out.
        """
        if self.lattice.cut:
            raise OptionError("this step needs a whole sheet; put it before the step that cuts it")
        rows, columns = self.lattice.rows, self.lattice.columns
        return self.positions.reshape(*self.positions.shape[:-2], rows, columns, 3)

    def mesh(self) -> Mesh:
        """The closed mesh: two sheets and a rim, along the averaged normals or with sharp edges."""
        shell = _shell(self.lattice, self.uv_mapping)
        thick = thicken(shell, self.positions, self.thickness)
        return faceted(thick, _corners(shell)) if self.facets else thick


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
def _shell(lattice: Lattice, uv_mapping: UVMapping) -> Shell:
    return make_shell(lattice.triangles, lattice.uvs, uv_mapping)


@lru_cache(maxsize=64)
def _corners(shell: Shell) -> FlatCorners:
    corners = shell.triangles.reshape(-1)
    triangles = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    return FlatCorners(corners, triangles, shell.uvs[corners])
