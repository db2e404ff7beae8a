"""Thick, textured cloth of any cut."""

from drapery.banner.dyes import DYES
from drapery.errors import OptionError
from drapery.mesh import Array, vertex_normals
from drapery.render.scene import Coat, Look, Model, Texels
from drapery.style.extrusion import Shell


def garment(shell: Shell, sheet: Array, thickness: float, look: Look) -> Model:
    """A cloth as it is worn: its thin sheet [..., N, 3] made `thickness` [m] thick."""
    normals = vertex_normals(sheet, shell.sheet)
    return Model(shell.cover(sheet, normals, thickness), (look,))


def dyed(texels: Texels, dye: str) -> Look:
    """A light texture in the colour of a dye. Raises OptionError."""
    if dye not in DYES:
        raise OptionError(f"dye {dye!r} is not known; use one of: {', '.join(DYES)}")
    return Look((Coat(texels, DYES[dye].rgb),))
