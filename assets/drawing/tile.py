"""Helpers for all block textures: their size, and texels from tone numbers and a palette."""

import numpy as np

from assets.drawing.canvas import Texels
from assets.drawing.noise import Field

SIZE = 16
"""Texels to a block's side."""

Palette = tuple[tuple[int, int, int], ...]
"""Colours in sRGB from dark to light; a tone is an index in it."""


def paint(tones: Field, palette: Palette) -> Texels:
    """Opaque texels; tones outside the palette are clamped to it."""
    colours = np.array([(*colour, 255) for colour in palette], np.uint8)
    return colours[np.clip(tones, 0, len(palette) - 1)]
