"""The geometric patterns as coverage over a face of any size.

A texel is tested at its centre. Coordinates are doubled, so centres are odd integers: the face
spans 0 to 2 * width and 0 to 2 * height, y down, and every test is exact. On faces of even width
that are twice as tall as wide no centre is on a diagonal, so halves meet without gap or overlap.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from assets.drawing.canvas import Grey

Mask = NDArray[np.bool_]
Axis = NDArray[np.int64]
Shape = Callable[[int, int], Grey]
"""Coverage 0 to 255, shape [height, width], of a face of the given width and height."""


def axes(width: int, height: int) -> tuple[Axis, Axis]:
    """Doubled coordinates of the texel centres: x [1, width], y [height, 1]."""
    return 2 * np.arange(width)[None, :] + 1, 2 * np.arange(height)[:, None] + 1


def cover(mask: Mask, width: int, height: int) -> Grey:
    """Full coverage where `mask` holds, none elsewhere."""
    return np.where(np.broadcast_to(mask, (height, width)), 255, 0).astype(np.uint8)


def base(width: int, height: int) -> Grey:
    return np.full((height, width), 255, np.uint8)


def stripe_top(width: int, height: int) -> Grey:
    _, y = axes(width, height)
    return cover(3 * y < 2 * height, width, height)


def stripe_left(width: int, height: int) -> Grey:
    x, _ = axes(width, height)
    return cover(10 * x < 6 * width, width, height)


def stripe_center(width: int, height: int) -> Grey:
    x, _ = axes(width, height)
    return cover(5 * abs(x - width) < width, width, height)


def stripe_middle(width: int, height: int) -> Grey:
    """A band as high as the pale is wide, so that the two make an even cross."""
    _, y = axes(width, height)
    return cover(5 * abs(y - height) < width, width, height)


def straight_cross(width: int, height: int) -> Grey:
    return stripe_center(width, height) | stripe_middle(width, height)


def half_vertical(width: int, height: int) -> Grey:
    x, _ = axes(width, height)
    return cover(x < width, width, height)


def half_horizontal(width: int, height: int) -> Grey:
    _, y = axes(width, height)
    return cover(y < height, width, height)


def square_top_left(width: int, height: int) -> Grey:
    return half_vertical(width, height) & stripe_top(width, height)


def small_stripes(width: int, height: int) -> Grey:
    """Four pales: the texels that lie wholly in the middle three fifths of their quarter."""
    x, _ = axes(width, height)
    # In twentieths of a texel a quarter is 5 * width long and a texel reaches 10 to each side.
    across = 10 * x % (5 * width)
    return cover((width <= across - 10) & (across + 10 <= 4 * width), width, height)


def _beside_diagonal(width: int, height: int) -> Axis:
    """Distance of a centre to the right of the descending diagonal, in 1/(2 height) texels."""
    x, y = axes(width, height)
    return x * height - y * width


def stripe_downright(width: int, height: int) -> Grey:
    reach = 2 * width * height // 5
    return cover(abs(_beside_diagonal(width, height)) < reach, width, height)


def cross(width: int, height: int) -> Grey:
    """Both diagonals, narrower than the bends."""
    reach = width * height // 4
    bend = cover(abs(_beside_diagonal(width, height)) < reach, width, height)
    return bend | bend[:, ::-1]


def diagonal_right(width: int, height: int) -> Grey:
    return cover(_beside_diagonal(width, height) > 0, width, height)


def triangle_bottom(width: int, height: int) -> Grey:
    """A chevron from the lower corners to the middle of the face."""
    x, y = axes(width, height)
    return cover(abs(x - width) * height < (y - height) * width, width, height)


def triangles_bottom(width: int, height: int) -> Grey:
    """Three teeth, twice as tall as they are wide at each side of the tip."""
    x, y = axes(width, height)
    tooth = 2 * (3 * width // 10)
    from_middle = abs(x - width)
    from_tip = np.minimum(from_middle, abs(from_middle - tooth))
    return cover(2 * height - y < tooth + 4 - 2 * from_tip, width, height)


def circle(width: int, height: int) -> Grey:
    """A roundel over half the width, its radius rounded up to whole texels."""
    x, y = axes(width, height)
    diameter = 2 * ((width + 3) // 4)
    return cover((x - width) ** 2 + (y - height) ** 2 < diameter**2, width, height)


def rhombus(width: int, height: int) -> Grey:
    """A lozenge twice as tall as wide over two thirds of the width."""
    x, y = axes(width, height)
    return cover(2 * abs(x - width) + abs(y - height) < 4 * width // 3, width, height)


def border(width: int, height: int) -> Grey:
    """A frame three twentieths of the width deep."""
    x, y = axes(width, height)
    inwards = np.minimum(np.minimum(x, 2 * width - x), np.minimum(y, 2 * height - y))
    return cover(10 * inwards <= 3 * width, width, height)


def _scallop(length: int, depths: tuple[int, ...]) -> Axis:
    """Depth of a toothed frame along a side of `length` texels, whose teeth are all `depths`."""
    return np.resize(np.array(depths), length)


def curly_border(width: int, height: int) -> Grey:
    """A frame with rounded teeth of five texels on its inner edge."""
    depths = (2, 4, 5, 4, 2) if width >= 20 else (1, 2, 2, 2, 1)
    x, y = np.arange(width)[None, :], np.arange(height)[:, None]
    beside = np.minimum(x, width - 1 - x) < _scallop(height, depths)[:, None]
    above = np.minimum(y, height - 1 - y) < _scallop(width, depths)[None, :]
    return cover(beside | above, width, height)


def bricks(width: int, height: int) -> Grey:
    """Courses of bricks three texels high and one texel of joint, each moved by half a brick."""
    x, y = np.arange(width)[None, :], np.arange(height)[:, None]
    course = y // 4
    along = x + np.where(course % 2 == 0, 1, 4)
    return cover((y % 4 < 3) & (along % 6 != 0), width, height)


def gradient(width: int, height: int) -> Grey:
    """Full at the top, gone at the bottom, even steps between."""
    _, y = axes(width, height)
    left = 2 * height - y
    alpha = (255 * left + height) // (2 * height)
    return np.broadcast_to(alpha, (height, width)).astype(np.uint8)


def _upside_down(shape: Shape) -> Shape:
    return lambda width, height: shape(width, height)[::-1]


def _mirrored(shape: Shape) -> Shape:
    return lambda width, height: shape(width, height)[:, ::-1]


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
    "triangle_bottom": triangle_bottom,
    "triangle_top": _upside_down(triangle_bottom),
    "triangles_bottom": triangles_bottom,
    "triangles_top": _upside_down(triangles_bottom),
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
