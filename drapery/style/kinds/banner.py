"""Banners: standing on a pole, on a wall, or an item in its slot."""

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.errors import OptionError
from drapery.settings import Settings
from drapery.style.block import (
    FLAG_MAPPING,
    FLAG_SIZE,
    SCALE,
    SWAY_PERIOD,
    Placement,
    flag_origin,
    solids,
    stiff_flag,
    wood,
)
from drapery.style.body import Body, Panel, Part
from drapery.style.cloth_spec import hanging_cloth
from drapery.style.grids import grid_shell
from drapery.style.layers import flag_material_at, textures_period, wood_material_at
from drapery.style.piece import Piece
from drapery.style.slot import BANNER_POSE, SLOT_LIGHT, in_slot, slot_camera

FULLNESS = 0.08
"""The flag is so much wider than its bar, on which it is gathered, so that it falls in folds."""


def body(banner: Banner | None, packs: Packs, settings: Settings) -> Body:
    """The wood and the flag. Raises OptionError without a design, and PackError."""
    if banner is None:
        raise OptionError("no design is given; write one like 'white creeper:lime border:black'")
    if settings.placement == "item":
        return _item(banner, packs, settings)
    return _block(banner, packs, settings, settings.placement)


def _block(banner: Banner, packs: Packs, settings: Settings, placement: Placement) -> Body:
    columns, rows = settings.grid
    origin = flag_origin(placement)
    piece = Piece(
        grid_shell(rows, columns, FLAG_MAPPING),
        settings.thickness * SCALE,
        SCALE,
        FLAG_SIZE,
        flag_material_at(banner, packs, settings),
        "banner/cloth",
    )
    flag = Panel(
        hanging_cloth(settings, piece, origin, solids(placement), FULLNESS),
        piece,
        origin,
        lambda phase: stiff_flag(placement, phase, settings.thickness),
        SWAY_PERIOD,
    )
    frame = Part(wood(placement), wood_material_at(packs, settings), "banner/pole")
    period = textures_period(banner, packs, "banner")
    return Body((frame,), (flag,), period)


def _item(banner: Banner, packs: Packs, settings: Settings) -> Body:
    """The item in the inventory: stiff, at phase 0 of its sway."""
    flag = stiff_flag("standing", 0.0, settings.thickness)
    parts = (
        Part(
            *(in_slot(wood("standing"), BANNER_POSE), wood_material_at(packs, settings)),
            "banner/pole",
        ),
        Part(
            *(in_slot(flag, BANNER_POSE), flag_material_at(banner, packs, settings)),
            "banner/cloth",
        ),
    )
    period = textures_period(banner, packs, "banner")
    return Body(parts, (), period, SLOT_LIGHT, slot_camera(settings.size))
