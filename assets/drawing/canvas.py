"""Texture sheets, and the places of a box's six sides on them.

Sheets are uint8 arrays [rows, columns, RGBA] with straight alpha; faces are arrays of the same kind
for one side of a box. A box of width w, height h and depth d at texture offset (u, v) is unfolded
as in the game: left, front, right and back side by side below v + d, and the top and bottom caps
above the front and the right side.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Texels = NDArray[np.uint8]
"""RGBA texels [rows, columns, 4]."""

Grey = NDArray[np.uint8]
"""One channel [rows, columns]: a shade of cloth or a coverage, 0 to 255."""

SHEET_SIZE = 64


@dataclass(frozen=True)
class TexelRect:
    """A rectangle of texels on a sheet: left, top, width, height."""

    x: int
    y: int
    width: int
    height: int

    @property
    def slices(self) -> tuple[slice, slice]:
        """The rows and columns that the region takes of a sheet."""
        return slice(self.y, self.y + self.height), slice(self.x, self.x + self.width)


@dataclass(frozen=True)
class TextureBox:
    """A box of the game's models: its texture offset (u, v) and its size, all in texels."""

    u: int
    v: int
    width: int
    height: int
    depth: int

    @property
    def left(self) -> TexelRect:
        return TexelRect(self.u, self.v + self.depth, self.depth, self.height)

    @property
    def front(self) -> TexelRect:
        return TexelRect(self.u + self.depth, self.v + self.depth, self.width, self.height)

    @property
    def right(self) -> TexelRect:
        return TexelRect(
            self.u + self.depth + self.width, self.v + self.depth, self.depth, self.height
        )

    @property
    def back(self) -> TexelRect:
        return TexelRect(
            self.u + 2 * self.depth + self.width, self.v + self.depth, self.width, self.height
        )

    @property
    def top(self) -> TexelRect:
        return TexelRect(self.u + self.depth, self.v, self.width, self.depth)

    @property
    def bottom(self) -> TexelRect:
        return TexelRect(self.u + self.depth + self.width, self.v, self.width, self.depth)

    @property
    def sides(self) -> TexelRect:
        """Left, front, right and back as one strip around the box."""
        return TexelRect(self.u, self.v + self.depth, 2 * (self.width + self.depth), self.height)


FLAG = TextureBox(0, 0, 20, 40, 1)
POLE = TextureBox(44, 0, 2, 42, 2)
BAR = TextureBox(0, 42, 20, 2, 2)
PLATE = TextureBox(0, 0, 12, 22, 1)
HANDLE = TextureBox(26, 0, 2, 6, 6)


def blank(size: int = SHEET_SIZE) -> Texels:
    """A fully transparent sheet, shape [size, size, 4]."""
    return np.zeros((size, size, 4), np.uint8)


def put(sheet: Texels, region: TexelRect, texels: Texels) -> None:
    """Paint `texels` over a region of `sheet`; a single row or column is stretched to fill it."""
    sheet[region.slices] = texels


def wrap(sheet: Texels, box: TextureBox, face: Texels) -> None:
    """Put one face around a box: front, mirrored back, and edges that continue the border texels.

    Front and back are one cloth, so the back shows the mirror image of the design. Each edge
    repeats the row or column of the front beside it; the caps have the same direction as the front.
    """
    put(sheet, box.front, face)
    put(sheet, box.back, face[:, ::-1])
    put(sheet, box.left, face[:, :1])
    put(sheet, box.right, face[:, -1:])
    put(sheet, box.top, face[:1])
    put(sheet, box.bottom, face[-1:])


def grey_texels(shade: Grey, alpha: Grey) -> Texels:
    """Grey texels from a shade and an alpha; the colour is 0 where alpha is 0."""
    seen = np.where(alpha > 0, shade, 0).astype(np.uint8)
    return np.dstack([seen, seen, seen, alpha])
