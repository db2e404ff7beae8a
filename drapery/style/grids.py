"""Shells of whole grids of particles, and of curves through them."""

from functools import lru_cache

from drapery.mesh import grid_surface
from drapery.style.extrusion import Shell, make_shell
from drapery.style.refinement import finer_shape
from drapery.style.uv_mapping import SHEET_MAPPING, UVMapping


@lru_cache(maxsize=64)
def grid_shell(rows: int, columns: int, uv_mapping: UVMapping = SHEET_MAPPING) -> Shell:
    """The shell of a whole grid with the triangles of a cloth: one object for the same numbers,
    which renderers recognise by identity.
    """
    triangles, uvs = grid_surface(rows, columns)
    return make_shell(triangles, uvs, uv_mapping, (rows, columns))


def finer_shell(shell: Shell, times: int) -> Shell | None:
    """The shell of curves through the particles of a grid, with `times` cells along each cell.

    None where there are none: for one cell, and for a shell with cells cut out.
    """
    if times == 1 or shell.grid is None:
        return None
    return grid_shell(*finer_shape(shell.grid, times), shell.uv_mapping)
