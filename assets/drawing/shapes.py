"""The geometric patterns as coverage over the flag's face or the shield's field.

Extents are the game's, in texels, soft edge included. Most shapes are given by their depth: how
many texels of the shape lie from here to its edge, this one included. A depth of 1 is the edge,
which lets a quarter of the cloth below through, and 0 or less is open.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assets.drawing.canvas import Grey

Mask = NDArray[np.bool_]
Axis = NDArray[np.int64]

SOFT = 191
"""Coverage of a soft edge."""

HALF = 128
"""Coverage of the soft edge that a half has beyond the middle of the face."""


@dataclass(frozen=True)
class Scallop:
    """The open field of the curly border: a rectangle and round bites, all lengths in texels.

    The rectangle lies `inset` from each side. The bites along the sides have their middles on its
    edge, `spacing` apart, the ones at the top and bottom `crown` from the end of the face. `bite`
    and `arch` are their diameters squared.
    """

    inset: int
    spacing: int
    bite: int
    crown: int
    arch: int


@dataclass(frozen=True)
class Face:
    """A face and the extents of its patterns, in texels."""

    width: int
    height: int
    ends: int
    """Rows of the stripes at the top and the bottom."""
    sides: int
    """Columns of the stripes at the left and the right."""
    middle: int
    """Width of the stripes in the middle."""
    corner: tuple[int, int]
    """Width and height of the squares."""
    limb: int
    """Width of the straight cross's limbs."""
    frame: int
    """Depth of the border."""
    bend: int
    """Columns of a diagonal stripe on each side of its middle one."""
    saltire: int
    """Columns of a diagonal cross's limb on each side of its middle one."""
    pales: tuple[int, int, int]
    """First column, width and period of the small stripes."""
    tooth: int
    """Half the width of each triangle in a row."""
    brick: tuple[int, int]
    """Length and height of a brick; joints are one texel."""
    brick_start: int
    """Row and column where the first course begins."""
    scallop: Scallop
    fine: bool
    """Whether shapes thinner than four texels, and halves, have soft edges too."""

    @property
    def columns(self) -> Axis:
        """The number of each column, shape [1, width]."""
        return np.arange(self.width)[None, :]

    @property
    def rows(self) -> Axis:
        """The number of each row, shape [height, 1]."""
        return np.arange(self.height)[:, None]

    @property
    def across(self) -> Axis:
        """Columns from the middle two, which are 0, shape [1, width]."""
        return self.width // 2 - 1 - np.minimum(self.columns, self.columns[:, ::-1])

    @property
    def along(self) -> Axis:
        """Rows from the middle two, which are 0, shape [height, 1]."""
        return self.height // 2 - 1 - np.minimum(self.rows, self.rows[::-1])


BANNER_FACE = Face(
    width=20,
    height=40,
    ends=14,
    sides=7,
    middle=6,
    corner=(10, 14),
    limb=4,
    frame=3,
    bend=3,
    saltire=2,
    pales=(1, 3, 5),
    tooth=3,
    brick=(5, 3),
    brick_start=0,
    scallop=Scallop(inset=5, spacing=10, bite=55, crown=6, arch=86),
    fine=True,
)
SHIELD_FACE = Face(
    width=10,
    height=20,
    ends=8,
    sides=4,
    middle=4,
    corner=(5, 7),
    limb=2,
    frame=1,
    bend=1,
    saltire=0,
    pales=(1, 1, 2),
    tooth=1,
    brick=(3, 2),
    brick_start=1,
    scallop=Scallop(inset=3, spacing=6, bite=14, crown=3, arch=24),
    fine=False,
)

Shape = Callable[[Face], Grey]
"""Coverage 0 to 255 of a face, shape [height, width]."""


def _coverage(depth: Axis, face: Face, soft: bool = True) -> Grey:
    """Coverage from depths; without `soft` the edge is as full as the rest."""
    alpha = np.select([depth > 1, depth == 1], [255, SOFT if soft else 255], 0)
    return np.broadcast_to(alpha, (face.height, face.width)).astype(np.uint8)


def _edged(mask: Mask, face: Face, soft: bool = True) -> Grey:
    """Coverage from a mask, whose edge is where a neighbour above, below or beside is open."""
    padded = np.pad(mask, 1, mode="edge")
    inner = padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
    return _coverage(mask.astype(np.int64) + (mask & inner), face, soft)


def base(face: Face) -> Grey:
    return np.full((face.height, face.width), 255, np.uint8)


def stripe_top(face: Face) -> Grey:
    return _coverage(face.ends - face.rows, face)


def stripe_left(face: Face) -> Grey:
    return _coverage(face.sides - face.columns, face)


def stripe_center(face: Face) -> Grey:
    return _coverage(face.middle // 2 - face.across, face)


def stripe_middle(face: Face) -> Grey:
    return _coverage(face.middle // 2 - face.along, face)


def straight_cross(face: Face) -> Grey:
    """Two stripes across each other, narrower than the stripes alone."""
    limbs = [_coverage(face.limb // 2 - off, face, face.fine) for off in (face.across, face.along)]
    return np.maximum(*limbs)


def _half(number: Axis, face: Face) -> Grey:
    """The texels numbered below the middle, and half of the next."""
    middle = number.size // 2
    alpha = np.select([number < middle, number == middle], [255, HALF if face.fine else 0], 0)
    return np.broadcast_to(alpha, (face.height, face.width)).astype(np.uint8)


def half_vertical(face: Face) -> Grey:
    return _half(face.columns, face)


def half_horizontal(face: Face) -> Grey:
    return _half(face.rows, face)


def square_top_left(face: Face) -> Grey:
    width, height = face.corner
    return _coverage(np.minimum(width - face.columns, height - face.rows), face)


def small_stripes(face: Face) -> Grey:
    """Upright stripes with even gaps."""
    first, width, period = face.pales
    within = (face.columns - first) % period
    depth = np.where(face.columns < first, 0, np.minimum(within + 1, width - within))
    return _coverage(depth, face, face.fine)


def _beside_diagonal(face: Face) -> Axis:
    """Columns to the right of the diagonal that descends two rows for each column."""
    return face.columns - face.rows // 2


def stripe_downright(face: Face) -> Grey:
    return _coverage(face.bend + 1 - abs(_beside_diagonal(face)), face, face.fine)


def cross(face: Face) -> Grey:
    """Both diagonals, narrower than the diagonal stripes."""
    limb = _coverage(face.saltire + 1 - abs(_beside_diagonal(face)), face, face.fine)
    return np.maximum(limb, limb[:, ::-1])


def diagonal_right(face: Face) -> Grey:
    return _coverage(_beside_diagonal(face) + 1, face)


def _slope(away: Axis, face: Face, reach: int) -> Grey:
    """A wedge two rows high for each column: `reach` columns to each side where `away` is 0."""
    depth = reach + 1 - face.across - (away + 1) // 2
    return _coverage(np.where(away < 2 * reach, depth, 0), face)


def triangle_top(face: Face) -> Grey:
    """A triangle from the upper corners to the middle of the face."""
    return _slope(face.rows, face, face.width // 2)


def rhombus(face: Face) -> Grey:
    """A rhombus twice as tall as wide, over three fifths of the width and of the height."""
    return _slope(face.along, face, 3 * face.width // 10)


def triangles_top(face: Face) -> Grey:
    """Three triangles in a row, the middle one in the middle, with a full row above."""
    half = face.tooth
    within = (face.columns - face.width // 2 + half) % (2 * half + 1)
    across = np.maximum(half - 1 - within, within - half)
    return _coverage(np.where(face.rows == 0, 2, half + 1 - face.rows // 2 - across), face)


def _distance(face: Face, x: int, y: int) -> Axis:
    """Twice the distance of each texel's middle from the point (x, y), squared."""
    return (2 * face.columns + 1 - 2 * x) ** 2 + (2 * face.rows + 1 - 2 * y) ** 2


def circle(face: Face) -> Grey:
    """A disc over three fifths of the width."""
    distance = _distance(face, face.width // 2, face.height // 2)
    return _edged(10 * distance < 3 * face.width**2 + 80, face, face.fine)


def border(face: Face) -> Grey:
    inwards = np.minimum(face.across[:, :1] - face.across, face.along[:1] - face.along)
    return _coverage(face.frame - inwards, face, face.fine)


def curly_border(face: Face) -> Grey:
    """A frame whose inner edge is made of arches."""
    cut, middle = face.scallop, face.height // 2
    open_field = (face.across < face.width // 2 - cut.inset) & (face.along < middle - cut.inset)
    for step in (-cut.spacing, 0, cut.spacing):
        for x in (cut.inset, face.width - cut.inset):
            open_field |= _distance(face, x, middle + step) < cut.bite
    for y in (cut.crown, face.height - cut.crown):
        open_field |= _distance(face, face.width // 2, y) < cut.arch
    return _edged(~open_field, face, face.fine)


def bricks(face: Face) -> Grey:
    """Courses of bricks, each moved by half a brick, soft along their right and lower edges."""
    length, height = face.brick
    down = (face.rows - face.brick_start) % (height + 1)
    course = (face.rows - face.brick_start) // (height + 1)
    shift = course % 2 * ((length + 1) // 2)
    along = (face.columns - face.brick_start + shift) % (length + 1)
    return _coverage(np.minimum(length - along, height - down), face)


def gradient(face: Face) -> Grey:
    """Full in the first row, gone in the last, even steps between."""
    last = face.height - 1
    alpha = (255 * (last - face.rows) + last // 2) // last
    return np.broadcast_to(alpha, (face.height, face.width)).astype(np.uint8)


def _upside_down(shape: Shape) -> Shape:
    return lambda face: shape(face)[::-1]


def _mirrored(shape: Shape) -> Shape:
    return lambda face: shape(face)[:, ::-1]


SHAPES: dict[str, Shape] = {
    "base": base,
    "square_bottom_left": _upside_down(square_top_left),
    "square_bottom_right": _upside_down(_mirrored(square_top_left)),
    "square_top_left": square_top_left,
    "square_top_right": _mirrored(square_top_left),
    "stripe_bottom": _upside_down(stripe_top),
    "stripe_top": stripe_top,
    "stripe_left": stripe_left,
    "stripe_right": _mirrored(stripe_left),
    "stripe_center": stripe_center,
    "stripe_middle": stripe_middle,
    "stripe_downright": stripe_downright,
    "stripe_downleft": _mirrored(stripe_downright),
    "small_stripes": small_stripes,
    "cross": cross,
    "straight_cross": straight_cross,
    "triangle_bottom": _upside_down(triangle_top),
    "triangle_top": triangle_top,
    "triangles_bottom": _upside_down(triangles_top),
    "triangles_top": triangles_top,
    "diagonal_left": _mirrored(diagonal_right),
    "diagonal_up_right": _upside_down(diagonal_right),
    "diagonal_up_left": _upside_down(_mirrored(diagonal_right)),
    "diagonal_right": diagonal_right,
    "circle": circle,
    "rhombus": rhombus,
    "half_vertical": half_vertical,
    "half_vertical_right": _mirrored(half_vertical),
    "half_horizontal": half_horizontal,
    "half_horizontal_bottom": _upside_down(half_horizontal),
    "border": border,
    "curly_border": curly_border,
    "gradient": gradient,
    "gradient_up": _upside_down(gradient),
    "bricks": bricks,
}
"""The patterns that are shapes, by id. The other eight are charges, drawn texel by texel."""
