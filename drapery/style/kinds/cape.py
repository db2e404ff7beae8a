"""Capes: 10 x 16 texels of cloth, pinned at the shoulders, their outer side to the front."""

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.mesh import Mesh
from drapery.render.scene import Material, TextureLayer
from drapery.settings import Settings
from drapery.style.board import moved, stiff_board, tilted
from drapery.style.body import Body, Panel
from drapery.style.cloth_spec import Solid, half_space, hanging_cloth
from drapery.style.figure import CAPE_SIZE, PARTS, TEXEL, cape_mapping
from drapery.style.grids import grid_shell
from drapery.style.kinds.back import SHEET, SHOULDERS, back_texture
from drapery.style.piece import Piece

CAPE_MAPPING = cape_mapping(SHEET)
BACK = 2.6
"""Distance of the cape from the middle of its wearer [texels]; half the body is 2 deep."""
FULLNESS = 0.2
"""The cape is so much wider than the shoulders, on which it is gathered to fall in folds."""
LEAN = 6.0
"""Angle between the game's stiff cape and the back of a player who stands still [degrees]."""


def body(design: Banner | None, packs: Packs, settings: Settings) -> Body:
    """The cape, with a hole where its texture is transparent. Raises OptionError or PackError."""
    material = Material((TextureLayer(back_texture(settings, packs, CAPE_MAPPING)),), "cutout")
    columns, rows = settings.grid
    piece = Piece(
        grid_shell(rows, columns, CAPE_MAPPING),
        settings.thickness * TEXEL,
        TEXEL,
        CAPE_SIZE,
        lambda time: material,
        "cape/cloth",
    )
    shoulders = np.array(SHOULDERS)
    cloth = hanging_cloth(settings, piece, shoulders, _wearer(), FULLNESS)
    cape = Panel(cloth, piece, shoulders, lambda phase: _stiff(settings.thickness))
    return Body((), (cape,))


def _wearer() -> tuple[Solid, ...]:
    """The player behind the cape, who looks away from the viewer, and the ground."""
    x, _, z = SHOULDERS
    origin = (x, 0.0, z - BACK * TEXEL)
    return *(Solid(*part.box.bounds(TEXEL, origin)) for part in PARTS.values()), half_space(1, 0.0)


def _stiff(thickness: float) -> Mesh:
    leaning = tilted(stiff_board(CAPE_SIZE, thickness * TEXEL, CAPE_MAPPING), -np.radians(LEAN))
    return moved(leaning, np.array(SHOULDERS))
