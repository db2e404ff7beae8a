"""Converts drawings written as text to shades and coverage."""

import numpy as np

from assets.drawing.canvas import Grey
from assets.drawing.shapes import SOFT

SIGNS = {"#": (255, 255), "o": (218, 255), "+": (255, SOFT), ":": (255, 64), ".": (0, 0)}
"""Brightness and coverage of a texel by its sign, each out of 255."""


def rows_of(drawing: str) -> list[str]:
    """The rows of a drawing. Raises ValueError unless they are equally long and of known signs."""
    rows = drawing.split()
    if len({len(row) for row in rows}) != 1 or set(drawing) - {"\n", *SIGNS}:
        raise ValueError(f"not a drawing: {drawing!r}")
    return rows


def charge(drawing: str, width: int, height: int) -> tuple[Grey, Grey]:
    """Coverage and shade of a drawing in the middle of a face, shape [height, width] each.

    Where the free rows or columns are odd in number, the extra one is below or to the right.
    """
    texels = np.array([[SIGNS[sign] for sign in row] for row in rows_of(drawing)], np.uint8)
    face = centred(texels, width, height)
    return face[..., 1], face[..., 0]


def centred(drawing: Grey, width: int, height: int) -> Grey:
    """The drawing [rows, columns, ...] in the middle of a face of zeros [height, width, ...]."""
    rows, columns = drawing.shape[:2]
    top, left = (height - rows) // 2, (width - columns) // 2
    face = np.zeros((height, width, *drawing.shape[2:]), np.uint8)
    face[top : top + rows, left : left + columns] = drawing
    return face
