"""The shield's sheets: two bases of boards and iron, and one sheet a pattern.

The plate is a box of 12 x 22 x 1 texels with an iron rim of one. Patterns are painted on the boards
within the rim, 10 x 20, only on the front: the back of a shield is unpainted wood.
"""

import numpy as np

from assets.drawing.bitmaps import centred, charge
from assets.drawing.canvas import (
    HANDLE,
    PLATE,
    Grey,
    TexelRect,
    Texels,
    TextureBox,
    blank,
    grey_texels,
    put,
)
from assets.drawing.noise import Field, speckle
from assets.drawing.shading import times
from assets.drawing.shapes import SHAPES, SHIELD_FACE
from assets.drawing.shield_charges import SHIELD_CHARGES
from assets.drawing.tile import Palette, paint
from assets.drawing.timber import SPRUCE
from assets.drawing.wood import grain

FIELD = TexelRect(PLATE.front.x + 1, PLATE.front.y + 1, PLATE.width - 2, PLATE.height - 2)
"""The painted boards within the rim."""

IRON: Palette = ((70, 72, 76), (92, 95, 99), (116, 119, 123), (140, 143, 146), (168, 171, 173))

BOARD_ENDS = (2, 6)
"""Columns of the field where one board ends and the next begins."""


def boards(width: int, height: int) -> Grey:
    """Shade of painted boards: joints a little darker, the lower end and the right in shadow."""
    shade = np.full((height, width), 255, np.uint8)
    shade[:, 1::2] -= 4
    shade[:, BOARD_ENDS] = 232
    shade[:, -1] = 238
    shade[-1] = 226
    return shade


def field_figure(pattern: str) -> tuple[Grey, Grey]:
    """Coverage and own shade of a pattern on the field, shape [20, 10] each."""
    if pattern in SHIELD_CHARGES:
        return charge(SHIELD_CHARGES[pattern], FIELD.width, FIELD.height)
    coverage = SHAPES[pattern](SHIELD_FACE)
    return coverage, np.full_like(coverage, 255)


def field_face(pattern: str) -> Texels:
    """The pattern's texels on the field, shape [20, 10, 4]."""
    coverage, shade = field_figure(pattern)
    return grey_texels(times(boards(FIELD.width, FIELD.height), shade), coverage)


def shield_sheet(pattern: str) -> Texels:
    """The whole sheet of a pattern, shape [64, 64, 4]."""
    sheet = blank()
    put(sheet, FIELD, field_face(pattern))
    return sheet


def _iron(width: int, height: int, seed: int) -> Field:
    """Hammered iron."""
    return 1 + speckle(width, height, seed) * 2 // 65536


def _rim(width: int, height: int) -> Field:
    """An iron face, light along its upper and left edges and dark along the others."""
    tones = _iron(width, height, 131)
    tones[0], tones[:, 0] = tones[0] + 2, tones[:, 0] + 2
    tones[-1], tones[:, -1] = tones[-1] - 1, tones[:, -1] - 1
    return tones


def _raw_boards(width: int, height: int, seed: int) -> Texels:
    """Upright boards of bare wood, dark at their joints and ends."""
    tones = 1 + grain(width, height, seed)
    tones[:, BOARD_ENDS] = 0
    tones[-1] = np.maximum(tones[-1] - 1, 0)
    return paint(tones, SPRUCE)


def _paint_plate(sheet: Texels, field: Texels) -> None:
    """Iron all around, the given field in front, bare boards behind."""
    for region in (PLATE.left, PLATE.right, PLATE.top, PLATE.bottom):
        put(sheet, region, paint(_iron(region.width, region.height, 132), IRON))
    for region in (PLATE.front, PLATE.back):
        put(sheet, region, paint(_rim(region.width, region.height), IRON))
    put(sheet, FIELD, field)
    behind = TexelRect(PLATE.back.x + 1, FIELD.y, FIELD.width, FIELD.height)
    put(sheet, behind, _raw_boards(FIELD.width, FIELD.height, 141))


GRIP: Palette = ((78, 50, 34), (108, 72, 48), (136, 94, 64), (162, 116, 82))
"""Leather around the part of the handle that a hand holds."""

HOLLOW = (33, 25, 19, 255)
"""The shadow between the handle and the plate."""


def _bracket(handle: TextureBox) -> Texels:
    """The handle from its side: two wooden arms, and a wrapped grip in the first two columns."""
    face = paint(1 + grain(handle.height, handle.depth, 151).T, SPRUCE)
    face[1:-1, 2:] = HOLLOW
    face[1:-1, :2] = _wrapped(2, handle.height - 2)
    return face


def _wrapped(width: int, height: int) -> Texels:
    """Turns of a leather strap, each row darker towards its right end."""
    turns = 2 + np.arange(height)[:, None] % 2 - np.arange(width)[None, :]
    return paint(turns, GRIP)


def _paint_handle(sheet: Texels, handle: TextureBox = HANDLE) -> None:
    """A grip of wood and leather on two arms, which stand on the back of the plate."""
    side, front, back = _bracket(handle), handle.front, handle.back
    put(sheet, handle.left, side)
    put(sheet, handle.right, side[:, ::-1])
    put(sheet, front, paint(grain(front.width, front.height, 153), SPRUCE))
    put(sheet, back, paint(1 + grain(back.width, back.height, 152), SPRUCE))
    inner = TexelRect(back.x, back.y + 1, back.width, back.height - 2)
    put(sheet, inner, _wrapped(inner.width, inner.height))
    for cap in (handle.top, handle.bottom):
        put(sheet, cap, paint(1 + grain(cap.width, cap.height, 152), SPRUCE))


def base_sheet() -> Texels:
    """`shield_base`: the shield under its patterns, its field painted white."""
    sheet = blank()
    shade = boards(FIELD.width, FIELD.height)
    _paint_plate(sheet, grey_texels(shade, np.full_like(shade, 255)))
    _paint_handle(sheet)
    return sheet


def plain_sheet() -> Texels:
    """`shield_base_nopattern`: a shield of bare boards with an iron boss."""
    sheet = blank()
    field = _raw_boards(FIELD.width, FIELD.height, 142)
    boss = centred(np.ones((4, 4), np.uint8), FIELD.width, FIELD.height) > 0
    field[boss] = paint(_rim(4, 4), IRON).reshape(-1, 4)
    _paint_plate(sheet, field)
    _paint_handle(sheet)
    return sheet
