"""Whether anything can be seen of a texture where it is used."""

from collections.abc import Iterable

import numpy as np

from drapery.arrays import Texels
from drapery.style.uv_mapping import Rect

LEAST_ALPHA = 128
"""Texels of less alpha are holes."""


def is_invisible(texels: Texels, areas: Iterable[Rect]) -> bool:
    """Whether all parts of a texture [H, W, 4] are holes. areas: as fractions of it."""
    height, width = texels.shape[:2]
    scale = np.array([width, height, width, height])
    for area in areas:
        places = np.array(area) * scale
        low = np.floor(np.minimum(places[:2], places[2:]) + 1e-6).astype(int)
        high = np.ceil(np.maximum(places[:2], places[2:]) - 1e-6).astype(int)
        (left, top), (right, bottom) = np.maximum(low, 0), np.maximum(high, 1)
        # Beside the texture its last texels are repeated.
        part = texels[min(top, height - 1) : bottom, min(left, width - 1) : right, 3]
        if (part >= LEAST_ALPHA).any():
            return False
    return True
