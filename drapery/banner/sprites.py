"""A banner's sheets: their regions, and the exact colours of dyed sprites over each other.

Colours are 8-bit integers; a layer's texel is round(texel * dye / 255) per channel and is blended
over the layers below by its alpha a: round((a * src + (255 - a) * dst) / 255). Neither rounding
ever has a tie: x / 255 = k + 1/2 would make the even 2x equal to the odd 255 (2k + 1).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import lcm
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Texels
from drapery.banner.design import Banner
from drapery.banner.dyes import DYES
from drapery.banner.packs import Packs
from drapery.banner.packs.resampling import MAX_COMPOSITE, common_side, nearest_texels

Tint = tuple[int, int, int]
Tinted = tuple[Texels, Tint]
"""A sheet, uint8 [H, H, 4], and the sRGB colour that multiplies it, three of 0..255."""

WHITE: Tint = (255, 255, 255)
UNITS = 64
"""Regions are given in 64ths of the sheet's side, whatever its size."""

_BAND = 128
"""Rows that are composited at once, which bounds the memory for intermediate results."""


@dataclass(frozen=True)
class SheetRegion:
    """A rectangle of a sheet, in 64ths of its side; v grows downwards.

    left: u of the left edge.
    top: v of the upper edge.
    right: u of the right edge.
    bottom: v of the lower edge.
    """

    left: int
    top: int
    right: int
    bottom: int

    def uv(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom as fractions of the sheet."""
        return self.left / UNITS, self.top / UNITS, self.right / UNITS, self.bottom / UNITS

    def crop(self, sheet: Texels) -> Texels:
        """The region's texels, shape [rows, columns, 4].

        A sheet whose side is not a multiple of UNITS is magnified first: to the least common
        multiple, or, where that is over MAX_COMPOSITE, to the next multiple of UNITS.
        """
        side = len(sheet)
        size = lcm(side, UNITS)
        if size > MAX_COMPOSITE:
            size = -(-side // UNITS) * UNITS
        unit, index = size // UNITS, nearest_texels(side, size)
        rows = index[self.top * unit : self.bottom * unit]
        columns = index[self.left * unit : self.right * unit]
        return np.ascontiguousarray(sheet[rows[:, None], columns])

    def sample(self, sheet: Texels, scale: int) -> Texels:
        """The pixels of the region, shape [scale * rows, scale * columns, 4].

        Each pixel is the nearest texel to its centre, so pictures of all packs have one size.

        sheet: square, shape [H, H, 4].
        scale: pixels a unit.
        """
        texels = self.crop(sheet)
        rows = nearest_texels(len(texels), (self.bottom - self.top) * scale)
        columns = nearest_texels(texels.shape[1], (self.right - self.left) * scale)
        return np.ascontiguousarray(texels[rows[:, None], columns])


FRONT = SheetRegion(1, 1, 21, 41)
BACK = SheetRegion(22, 1, 42, 41)
TOP_EDGE = SheetRegion(1, 0, 21, 1)
BOTTOM_EDGE = SheetRegion(21, 0, 41, 1)
LEFT_EDGE = SheetRegion(0, 1, 1, 41)
"""The edge at the left for a viewer of the front."""
RIGHT_EDGE = SheetRegion(21, 1, 22, 41)

FLAG_REGIONS: dict[str, SheetRegion] = {
    "front": FRONT,
    "back": BACK,
    "top": TOP_EDGE,
    "bottom": BOTTOM_EDGE,
    "left": LEFT_EDGE,
    "right": RIGHT_EDGE,
}
"""The six sides of a flag on its sheet, by name; left and right as a viewer of the front has them.

From the game's model: a box of 20 x 40 x 1 units whose texture starts at (0, 0).
"""

SHIELD_REGIONS: dict[str, SheetRegion] = {
    "front": SheetRegion(1, 1, 13, 23),
    "back": SheetRegion(14, 1, 26, 23),
    "top": SheetRegion(1, 0, 13, 1),
    "bottom": SheetRegion(13, 0, 25, 1),
    "left": SheetRegion(0, 1, 1, 23),
    "right": SheetRegion(13, 1, 14, 23),
}
"""The six sides of a shield's plate, 12 x 22 units, on its sheet, by name."""


def tint(texels: Texels, rgb: Tint) -> Texels:
    """Dyed texels: round(texel * rgb / 255) per channel, alpha kept. Shape [..., 4]."""
    dye = np.array((*rgb, 255), np.uint16)
    return _divide_by_255(texels * dye)


def lay_over(below: Texels, above: Texels) -> Texels:
    """`above` over `below` by its alpha a: round((a * above + (255 - a) * below) / 255).

    Exact where `below` is opaque, and then opaque. Shapes [..., 4], alike.
    """
    alpha = above[..., 3:].astype(np.uint16)
    source = above.astype(np.uint16)
    source[..., 3] = 255
    return _divide_by_255(alpha * source + (255 - alpha) * below)


def composite(layers: Sequence[Tinted], side: int | None = None) -> Texels:
    """One opaque sheet for a stack of square sheets and their tints, shape [side, side, 4].

    layers: as `flag_layers` gives them, lowest first; the lowest counts as opaque, as in the
        game's solid layer.
    side: of the sheet [px]; each layer is sampled to its nearest texels. None is the least common
        multiple of the layers' sides, where that loses nothing, or, if that is over 2048 px, the
        greatest multiple of the largest side within it.

    Channels are 8-bit integers: round(texel * dye / 255) for the tint, and
    round((a * source + (255 - a) * below) / 255) for a layer of alpha a over those below.
    """
    if side is None:
        side = common_side(len(texels) for texels, _ in layers)
    sheet = np.empty((side, side, 4), np.uint8)
    for top in range(0, side, _BAND):
        rows = slice(top, min(top + _BAND, side))
        band = _tinted_rows(*layers[0], side, rows)
        band[..., 3] = 255
        for texels, rgb in layers[1:]:
            band = lay_over(band, _tinted_rows(texels, rgb, side, rows))
        sheet[rows] = band
    return sheet


def _tinted_rows(texels: Texels, rgb: Tint, side: int, rows: slice) -> Texels:
    """Some rows of a sheet that is resized to a side and tinted, shape [rows, side, 4]."""
    if len(texels) == side:
        return tint(texels[rows], rgb)
    index = nearest_texels(len(texels), side)
    # Tinted before its columns are repeated: there are fewer texels.
    return tint(texels[index[rows]], rgb)[:, index]


def flag_layers(banner: Banner, packs: Packs, time: float = 0.0) -> tuple[Tinted, ...]:
    """The sheets of a flag with their tints, lowest first, as the game stacks them.

    banner: the design.
    packs: resource packs, see `drapery.packs.open_packs`.
    time: of animated textures [s].

    Raises PackError for a texture that cannot be used.
    """
    dyed = [("base", banner.base), *((layer.pattern, layer.dye) for layer in banner.layers)]
    sheets = [(packs.sheet(pattern, time=time), DYES[dye].rgb) for pattern, dye in dyed]
    return (packs.base_sheet(time), WHITE), *sheets


def shield_layers(banner: Banner | None, packs: Packs, time: float = 0.0) -> tuple[Tinted, ...]:
    """The sheets of a shield with their tints, lowest first.

    banner: the design; None is the shield without one.
    packs: resource packs, see `drapery.packs.open_packs`.
    time: of animated textures [s].

    Raises PackError for a texture that cannot be used.
    """
    if banner is None:
        return ((packs.base("shield_base_nopattern", time), WHITE),)
    dyed = [("base", banner.base), *((layer.pattern, layer.dye) for layer in banner.layers)]
    sheets = [(packs.sheet(pattern, "shield", time), DYES[dye].rgb) for pattern, dye in dyed]
    return (packs.base("shield_base", time), WHITE), *sheets


def face(
    banner: Banner, packs: Packs, side: Literal["front", "back"] = "front", time: float = 0.0
) -> Texels:
    """The plain opaque face of a banner, shape [40 n, 20 n, 4], n = 1 for sheets of 64 px.

    Raises PackError.
    """
    return FLAG_REGIONS[side].crop(composite(flag_layers(banner, packs, time)))


def _divide_by_255(values: NDArray[np.uint16]) -> Texels:
    # round(x / 255) for 0 <= x <= 255², all in 16 bits; Blinn, "Three wrongs make a right",
    # IEEE Computer Graphics and Applications 15(6), 1995.
    values += 128
    values += values >> 8
    values >>= 8
    return values.astype(np.uint8)
