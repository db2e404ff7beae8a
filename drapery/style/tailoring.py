"""Thick, textured cloth of any shape."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from drapery.arrays import Texels
from drapery.banner.dyes import DYES
from drapery.banner.packs import Packs
from drapery.banner.sprites import tint
from drapery.errors import OptionError
from drapery.mesh import Array
from drapery.render.scene import Material, Model, TextureLayer
from drapery.style.piece import Piece

TEXEL = 1 / 16
"""The edge of a texel of a block [m]."""


@dataclass(frozen=True, eq=False)
class ClothModel(Model):
    """A model that is cloth, so that styles change it.

    thin: the piece that it is and the positions of its vertices [m], shape [N, 3], or [B, N, 3] of
        a batch; None if its shape must stay.
    """

    thin: tuple[Piece, Array] | None = None


def dyed(texels: Texels, dye: str) -> Material:
    """A light texture tinted with a dye. Raises OptionError."""
    if dye not in DYES:
        raise OptionError(f"dye {dye!r} is not known; use one of: {', '.join(DYES)}")
    return Material((TextureLayer(texels, DYES[dye].rgb),))


def dyed_texels(texels: Texels, dye: str) -> Texels:
    """Light texels multiplied with a dye. Raises OptionError."""
    return tint(texels, dyed(texels, dye).layers[0].tint)


def block_texels(name: str, packs: Packs) -> Texels:
    """The texels of a block; the name of a dye is its wool. Raises PackError."""
    if name in DYES:
        return dyed_texels(packs.texture("block/white_wool"), name)
    return packs.texture(f"block/{name}")


def squares(texels: Sequence[Texels], columns: int, rows: int) -> Material:
    """A material of squares, row by row; the given ones repeat."""
    each = [texels[number % len(texels)] for number in range(columns * rows)]
    lines = [np.hstack(each[row * columns : (row + 1) * columns]) for row in range(rows)]
    return Material((TextureLayer(np.ascontiguousarray(np.vstack(lines))),))


def checked(texels: Texels, dyes: tuple[str, str], count: int = 4) -> Material:
    """A chequered material of two dyes, `count` squares to a side. Raises OptionError."""
    pieces = [dyed_texels(texels, dye) for dye in dyes]
    rows = [np.hstack([pieces[(r + c) % 2] for c in range(count)]) for r in range(count)]
    return Material((TextureLayer(np.ascontiguousarray(np.vstack(rows))),))
