"""A picture beside the banners that look most like it."""

from collections.abc import Sequence

import numpy as np

from drapery.arrays import Pixels
from drapery.banner.packs import Packs
from drapery.match.search import Match
from drapery.pictures import face_pixels
from drapery.sheets import PictureSheet, SheetCell

SCALE = 8
"""Pixels of a sheet for each texel of a face."""


def matches_sheet(
    face: Pixels, matches: Sequence[Match], packs: Packs, *, scale: int = SCALE
) -> PictureSheet:
    """A face and beside it the banners that were found for it.

    face: sRGB, uint8, shape [40, 20, 3].
    matches: what was found.
    packs: resource packs, see `drapery.packs.open_packs`.
    scale: pixels for each texel of a 64 x 64 pack.

    Raises PackError for a texture that cannot be used.
    """
    large = np.asarray(face).repeat(scale, axis=0).repeat(scale, axis=1)
    cells = [SheetCell("picture", np.dstack([large, np.full_like(large[..., 0], 255)]))]
    cells += [
        SheetCell(f"{number}. {100 * one.error:.1f} %", face_pixels(one.banner, packs, scale))
        for number, one in enumerate(matches, 1)
    ]
    return PictureSheet("The nearest banners", tuple(cells), min(len(cells), 8))
