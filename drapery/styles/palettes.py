"""Palettes: the nearest of a few colours, for pictures and for textures, and the dither between."""

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from drapery.arrays import Words
from drapery.mesh import Array
from drapery.styles.colours import COLOUR_PATTERN, rgb_of
from drapery.styles.palette_files import MAX_COLOURS
from drapery.styles.void_and_cluster import blue_noise

Colour = Annotated[str, Field(pattern=COLOUR_PATTERN)]
"""A parameter of a step that is a colour."""

PaletteColours = Annotated[
    tuple[Colour, ...],
    Field(min_length=2, max_length=MAX_COLOURS, description="the colours to use"),
]
DitherStrength = Annotated[float, Field(ge=0, le=1, description="strength of the dither")]
DitherPattern = Annotated[Literal["bayer", "blue-noise"], Field(description="of the dither")]

DARK_AND_LIGHT = ("#1a1620", "#f4f0e8")
"""The colours of a palette that names none."""
SPREAD = 48
"""How far the strongest dither raises or lowers a level together."""

BAYER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]])
"""Order of the thresholds of a 4 x 4 ordered dither (Bayer 1973)."""


def use_palette(
    words: Words, colours: tuple[str, ...], dither: float, pattern: DitherPattern
) -> None:
    """Replace each visible pixel by the nearest of some colours, by a weighted distance in sRGB."""
    from drapery.styles.kernels import nearest

    table = np.array([rgb_of(colour) for colour in colours], np.float64)
    offsets, tile = thresholds(dither, pattern)
    nearest(words, table, np.asarray(dither * SPREAD * offsets, np.float64), tile)


def thresholds(dither: float, pattern: DitherPattern) -> tuple[Array, NDArray[np.int32]]:
    """Offsets of a dither, -0.5..0.5, and the tile of their indices; without it one 0."""
    if not dither:
        return np.zeros(1), np.zeros((1, 1), np.int32)
    tile = BAYER.astype(np.int32) if pattern == "bayer" else blue_noise().copy()
    count = int(tile.max()) + 1
    return (np.arange(count) + 0.5) / count - 0.5, tile
