"""The banner's sheets: a base of wood and plain cloth, and one sheet a pattern."""

import numpy as np

from assets.drawing.bitmaps import charge
from assets.drawing.canvas import FLAG, Grey, Texels, blank, grey_texels, wrap
from assets.drawing.charges import CHARGES
from assets.drawing.shading import cloth, times
from assets.drawing.shapes import BANNER_FACE, SHAPES
from assets.drawing.wood import paint_bar, paint_pole

UNDYED = 235
"""Shade of undyed cloth; the base pattern always covers it."""


def figure(pattern: str) -> tuple[Grey, Grey]:
    """Coverage and own shade of a pattern on the flag's face, shape [40, 20] each."""
    if pattern in CHARGES:
        return charge(CHARGES[pattern], FLAG.width, FLAG.height)
    coverage = SHAPES[pattern](BANNER_FACE)
    return coverage, np.full_like(coverage, 255)


def pattern_face(pattern: str) -> Texels:
    """The pattern's texels on the face of the flag, shape [40, 20, 4]."""
    coverage, shade = figure(pattern)
    return grey_texels(times(cloth(FLAG.width, FLAG.height), shade), coverage)


def pattern_sheet(pattern: str) -> Texels:
    """The whole sheet of a pattern, shape [64, 64, 4]."""
    sheet = blank()
    wrap(sheet, FLAG, pattern_face(pattern))
    return sheet


def base_sheet() -> Texels:
    """`banner_base`: pole, bar and undyed flag, all opaque, shape [64, 64, 4]."""
    sheet = blank()
    shade = cloth(FLAG.width, FLAG.height)
    undyed = times(shade, np.full_like(shade, UNDYED))
    wrap(sheet, FLAG, grey_texels(undyed, np.full_like(shade, 255)))
    paint_pole(sheet)
    paint_bar(sheet)
    return sheet
