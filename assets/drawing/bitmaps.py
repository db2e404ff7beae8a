"""Converts drawings written as text to shades and coverage."""

import numpy as np

from assets.drawing.canvas import Grey

SHADES = {"#": 255, "o": 218}
"""Brightness of a drawn texel, out of 255."""


def rows_of(drawing: str) -> list[str]:
    """The rows of a drawing. Raises ValueError unless they are equally long and of known signs."""
    rows = drawing.split()
    if len({len(row) for row in rows}) != 1 or set(drawing) - set(".\n") - set(SHADES):
        raise ValueError(f"not a drawing: {drawing!r}")
    return rows


def shades(drawing: str) -> Grey:
    """The drawing's shades, 0 where it is open, shape [rows, columns]."""
    values = [[SHADES.get(sign, 0) for sign in row] for row in rows_of(drawing)]
    return np.array(values, np.uint8)


def charge(drawing: str, width: int, height: int) -> tuple[Grey, Grey]:
    """Coverage and shade of a drawing in the middle of a face, shape [height, width] each."""
    shade = centred(shades(drawing), width, height)
    return np.where(shade > 0, 255, 0).astype(np.uint8), shade


def centred(drawing: Grey, width: int, height: int) -> Grey:
    """The drawing in the middle of a face, open all around, shape [height, width]."""
    rows, columns = drawing.shape
    top, left = (height - rows) // 2, (width - columns) // 2
    face = np.zeros((height, width), np.uint8)
    face[top : top + rows, left : left + columns] = drawing
    return face
