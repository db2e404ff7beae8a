"""Garments of the package as scenes vary them: with other numbers, and in another material."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from drapery.garments import Garment, GridPiece, SewnCloth, find_garment
from drapery.packs import open_packs
from drapery.render import Material
from drapery.stage.dressing import Dressed
from drapery.style import UVMapping, make_shell


def varied(
    name: str,
    *,
    piece: Mapping[str, Any] | None = None,
    fabric: Mapping[str, Any] | None = None,
    **own: Any,
) -> Garment:
    """A garment of the package with other values, in texels.

    piece: fields of all its pieces.
    fabric: fields of its fabric.
    own: fields of the garment itself.
    """
    found = find_garment(name)
    pieces = tuple(each.model_copy(update=piece) for each in found.piece)
    changed = {"piece": pieces, "fabric": replace(found.fabric, **(fabric or {})), **own}
    return found.model_copy(update=changed)


def with_side(garment: Garment, side: float) -> Garment:
    """A garment whose level grids are squares of another side [texels] about the same middle."""
    pieces = tuple(
        _with_side(piece, side) if isinstance(piece, GridPiece) else piece
        for piece in garment.piece
    )
    return garment.model_copy(update={"piece": pieces})


def dressed(garment: Garment) -> Dressed:
    """A garment in its own settings. Raises OptionError or PackError."""
    return Dressed(garment, open_packs(()), garment.settings())


def in_material(
    sewn: SewnCloth, material: Material, uv_mapping: UVMapping | None = None
) -> SewnCloth:
    """A cloth of one piece in another material.

    uv_mapping: where its front, back and rim lie on the texture; as before unless given.
    """
    (piece,) = sewn.pieces
    shell = piece.shell
    if uv_mapping is not None:
        shell = make_shell(shell.sheet, shell.sheet_uvs, uv_mapping, shell.grid)
    return replace(sewn, pieces=(replace(piece, shell=shell, material_at=lambda time: material),))


def _with_side(piece: GridPiece, side: float) -> GridPiece:
    further, turn = (side - piece.size[1]) / 2, math.radians(piece.turn[1])
    x, y, z = piece.place
    place = (x - further * math.sin(turn), y, z - further * math.cos(turn))
    return piece.model_copy(update={"size": (side, side), "place": place})
