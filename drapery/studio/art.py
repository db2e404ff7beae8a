"""Small pictures of designs and patterns, drawn from the session's packs, as PNG files."""

from functools import lru_cache

import numpy as np

from drapery.banner.design import Banner, Layer
from drapery.banner.packs import Packs
from drapery.banner.sprites import (
    FLAG_REGIONS,
    SHIELD_REGIONS,
    Region,
    composite,
    flag_layers,
    shield_layers,
)
from drapery.pictures import face_pixels
from drapery.render.encode.png import png_bytes
from drapery.render.frame import Pixels

CELL = (20, 40)
"""Width and height of one pattern in the sheet [texels of a 64 x 64 pack]."""

FACE_SCALE = 8


def face_png(banner: Banner, packs: Packs) -> bytes:
    """The plain face, 160 x 320 pixels; of a shield 96 x 176. Raises PackError."""
    return png_bytes(_face(banner, packs))


def _face(banner: Banner, packs: Packs) -> Pixels:
    if banner.kind == "banner":
        return face_pixels(banner, packs, FACE_SCALE)
    region = SHIELD_REGIONS["front"]
    return _sampled(region, composite(shield_layers(banner, packs)), FACE_SCALE)


@lru_cache(maxsize=48)
def pattern_sheet(packs: Packs, base: str, dye: str) -> bytes:
    """All patterns of the packs side by side, in one dye on a field of another.

    Cells of 20 x 40 pixels in the order of `packs.patterns()`. Raises PackError, DesignError.
    """
    cells = [_cell(packs, Banner(base, (Layer(name, dye),))) for name in packs.patterns()]
    return png_bytes(np.concatenate(cells, axis=1))


def _cell(packs: Packs, banner: Banner) -> Pixels:
    return _sampled(FLAG_REGIONS["front"], composite(flag_layers(banner, packs)), 1)


def _sampled(region: Region, sheet: Pixels, scale: int) -> Pixels:
    """A region at `scale` pixels a unit, each the nearest texel to its middle."""
    texels = region.crop(sheet)
    height, width = (region.bottom - region.top) * scale, (region.right - region.left) * scale
    down = (np.arange(height) * 2 + 1) * texels.shape[0] // (2 * height)
    across = (np.arange(width) * 2 + 1) * texels.shape[1] // (2 * width)
    return np.ascontiguousarray(texels[down][:, across])
