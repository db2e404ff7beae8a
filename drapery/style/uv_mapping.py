"""Where the sides of a thick cloth lie on its texture."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Pairs, UVs
from drapery.mesh import Array

Rect = tuple[float, float, float, float]
"""Left, top, right, bottom; as fractions of the sheet."""


class UVMapping(Protocol):
    """Maps a thin cloth's UVs (0..1 over its face) to those of its thick shell."""

    def front(self, uvs: UVs) -> UVs:
        """UVs of the front sheet, shape [N, 2]."""

    def back(self, uvs: UVs) -> UVs:
        """UVs of the back sheet, shape [N, 2]."""

    def rim(self, uvs: UVs, edges: Pairs) -> UVs:
        """UVs of the rim, shape [4 E, 2]: front start, front end, back start, back end.

        uvs: those of the thin sheet, shape [N, 2].
        edges: its boundary edges, shape [E, 2].
        """

    def __hash__(self) -> int:
        """Equal for equal mappings, because shells are cached by their mapping."""


class SheetMapping:
    """The same picture on both sides; the rim repeats the texels at the border. See `UVMapping`."""

    def front(self, uvs: UVs) -> UVs:
        return uvs

    def back(self, uvs: UVs) -> UVs:
        return uvs

    def rim(self, uvs: UVs, edges: Pairs) -> UVs:
        return uvs[np.tile(edges, 2).reshape(-1)]


SHEET_MAPPING = SheetMapping()
"""The default mapping of cloth."""


@dataclass(frozen=True)
class RegionMapping:
    """Front and back on a rectangle of the texture each, as fractions of it; the rim repeats the
    border of the front. From behind the back is seen the right way round. See `UVMapping`."""

    front_rect: Rect
    back_rect: Rect

    def front(self, uvs: Array) -> Array:
        return _place(uvs, self.front_rect)

    def back(self, uvs: Array) -> Array:
        return _place(np.stack([1 - uvs[:, 0], uvs[:, 1]], axis=-1), self.back_rect)

    def rim(self, uvs: Array, edges: NDArray[np.int32]) -> Array:
        return self.front(uvs)[np.tile(edges, 2).reshape(-1)]


@dataclass(frozen=True)
class BoxMapping:
    """The unfolded box of the game's models: a rectangle for each of the six sides.

    All rectangles are fractions of the texture: left, top, right, bottom. The picture continues
    around the corners.

    front_rect: of the front.
    back_rect: of the back.
    left: of the left edge, which has the front at its right border.
    right: of the right edge, which has the front at its left border.
    top: of the top edge, which has the front at its lower border.
    bottom: of the bottom edge, which has the front at its lower border.
    """

    front_rect: Rect
    back_rect: Rect
    left: Rect
    right: Rect
    top: Rect
    bottom: Rect

    def front(self, uvs: UVs) -> UVs:
        return _place(uvs, self.front_rect)

    def back(self, uvs: UVs) -> UVs:
        # Seen from behind, the right of the cloth is on the left.
        return _place(np.stack([1 - uvs[:, 0], uvs[:, 1]], axis=-1), self.back_rect)

    def rim(self, uvs: UVs, edges: Pairs) -> UVs:
        start, end = uvs[edges[:, 0]], uvs[edges[:, 1]]
        middle = (start + end) / 2
        depth = np.abs(np.stack([middle[:, 0], 1 - middle[:, 0], middle[:, 1], 1 - middle[:, 1]]))
        side = np.argmin(depth, axis=0)  # left, right, top, bottom
        # Along the edge and across it, from the strip's left or upper border.
        front_at = np.choose(side, [1.0, 0.0, 1.0, 1.0])
        corners = [
            _strip(uv, side, across) for across in (front_at, 1 - front_at) for uv in (start, end)
        ]
        rects = np.array([self.left, self.right, self.top, self.bottom])[side]
        return np.stack([_place_each(c, rects) for c in corners], axis=1).reshape(-1, 2)


def _strip(uv: Array, side: NDArray[np.intp], across: Array) -> Array:
    """A boundary point's place in its edge's strip, 0..1 in both directions."""
    upright = (side < 2)[:, None]
    return np.where(upright, np.stack([across, uv[:, 1]], -1), np.stack([uv[:, 0], across], -1))


def _place(uvs: Array, rect: Rect) -> Array:
    return _place_each(uvs, np.array(rect)[None])


def _place_each(uvs: Array, rects: Array) -> Array:
    return rects[:, :2] + uvs * (rects[:, 2:] - rects[:, :2])


def box_mapping(
    offset: tuple[float, float],
    size: tuple[float, float, float],
    sheet: tuple[float, float] = (64, 64),
) -> BoxMapping:
    """Where the sides of a box lie on its texture, as in the game's models.

    offset: the upper left corner of the unfolded box on the texture [texels].
    size: width, height and depth of the box [texels].
    sheet: width and height of the texture [texels].
    """
    x, y = offset
    width, height, depth = size

    def rect(left: float, top: float, w: float, h: float) -> Rect:
        across, down = sheet
        return left / across, top / down, (left + w) / across, (top + h) / down

    return BoxMapping(
        front_rect=rect(x + depth, y + depth, width, height),
        back_rect=rect(x + 2 * depth + width, y + depth, width, height),
        left=rect(x, y + depth, depth, height),
        right=rect(x + depth + width, y + depth, depth, height),
        top=rect(x + depth, y, width, depth),
        bottom=rect(x + depth + width, y, width, depth),
    )
