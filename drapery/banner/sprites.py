"""A banner's sheets: their regions, and the exact colours of dyed sprites laid over each other.

Colours are 8-bit integers throughout; a layer's texel is round(texel * dye / 255) per channel and
is laid over what is below by its alpha a: round((a * src + (255 - a) * dst) / 255). Neither
rounding ever meets a tie: x / 255 = k + 1/2 would make the even 2x equal to the odd 255 (2k + 1).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import lcm
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from drapery.banner.design import Banner
from drapery.banner.dyes import DYES
from drapery.banner.packs import Packs
from drapery.banner.packs.png import Texels

Tint = tuple[int, int, int]
Tinted = tuple[Texels, Tint]
"""A sheet and the colour it is multiplied by."""

WHITE: Tint = (255, 255, 255)
UNITS = 64
"""Regions are given in 64ths of the sheet's side, whatever its size."""

MAX_COMPOSITE = 2048


@dataclass(frozen=True)
class Region:
    """A rectangle of a sheet, in 64ths of its side; v grows downwards."""

    left: int
    top: int
    right: int
    bottom: int

    def uv(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom as fractions of the sheet."""
        return self.left / UNITS, self.top / UNITS, self.right / UNITS, self.bottom / UNITS

    def crop(self, sheet: Texels) -> Texels:
        """The region's texels, where needed magnified by whole numbers until units are whole."""
        size = lcm(sheet.shape[0], UNITS)
        unit = size // UNITS
        rows = np.arange(self.top * unit, self.bottom * unit) * sheet.shape[0] // size
        columns = np.arange(self.left * unit, self.right * unit) * sheet.shape[1] // size
        return np.ascontiguousarray(sheet[rows[:, None], columns])


FRONT = Region(1, 1, 21, 41)
BACK = Region(22, 1, 42, 41)
TOP_EDGE = Region(1, 0, 21, 1)
BOTTOM_EDGE = Region(21, 0, 41, 1)
LEFT_EDGE = Region(0, 1, 1, 41)
"""The edge at the left of someone who faces the front."""
RIGHT_EDGE = Region(21, 1, 22, 41)

FLAG_REGIONS: dict[str, Region] = {
    "front": FRONT,
    "back": BACK,
    "top": TOP_EDGE,
    "bottom": BOTTOM_EDGE,
    "left": LEFT_EDGE,
    "right": RIGHT_EDGE,
}

SHIELD_REGIONS: dict[str, Region] = {
    "front": Region(1, 1, 13, 23),
    "back": Region(14, 1, 26, 23),
    "top": Region(1, 0, 13, 1),
    "bottom": Region(13, 0, 25, 1),
    "left": Region(0, 1, 1, 23),
    "right": Region(13, 1, 14, 23),
}
"""The plate of a shield."""


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


def composite(layers: Sequence[Tinted]) -> Texels:
    """One opaque sheet for a stack of square sheets and their tints, lowest first.

    Its side is the least common multiple of theirs, so nearest sampling of it equals nearest
    sampling of each at its own size. Above 2048 px it is the greatest multiple of the largest
    sheet that fits, and equals it only to the nearest of its own texels. The lowest sheet counts
    as opaque, as in the game's solid layer.
    """
    side = _common_side({len(texels) for texels, _ in layers})
    texels, rgb = layers[0]
    # Tinted before it grows: the small sheet has fewer texels.
    result = resize(tint(texels, rgb), side)
    result[..., 3] = 255
    for texels, rgb in layers[1:]:
        result = lay_over(result, resize(tint(texels, rgb), side))
    return result


def resize(texels: Texels, side: int) -> Texels:
    """A square sheet at another size, by nearest sampling at the new texels' middles."""
    if len(texels) == side:
        return texels.copy()
    index = (2 * np.arange(side) + 1) * len(texels) // (2 * side)
    return texels[index[:, None], index]


def flag_layers(banner: Banner, packs: Packs, time: float = 0.0) -> tuple[Tinted, ...]:
    """The sheets of a flag with their tints, lowest first, as the game stacks them.

    time: for animated textures [s]. Raises PackError.
    """
    dyed = [("base", banner.base), *((layer.pattern, layer.dye) for layer in banner.layers)]
    sheets = [(packs.sheet(pattern, time=time), DYES[dye].rgb) for pattern, dye in dyed]
    return (packs.base_sheet(time), WHITE), *sheets


def shield_layers(banner: Banner | None, packs: Packs, time: float = 0.0) -> tuple[Tinted, ...]:
    """The sheets of a shield with their tints, lowest first; None is the shield without design.

    time: for animated textures [s]. Raises PackError.
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


def _common_side(sides: set[int]) -> int:
    side = lcm(*sides)
    largest = max(sides)
    return side if side <= MAX_COMPOSITE else max(1, MAX_COMPOSITE // largest) * largest
