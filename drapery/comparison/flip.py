"""LDR-FLIP, the difference that is seen when one picture replaces the other.

Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild (2020), "FLIP: a difference
evaluator for alternating images", at 67 pixels a degree, as on a 0.7 m wide 4k screen at a distance
of 0.7 m. All filters are products of a row and a column, so that they take one after another.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Colours = tuple[Floats, Floats, Floats]

_PER_DEGREE = 0.7 * 3840 / 0.7 * math.pi / 180
"""Pixels in a degree of the view."""
REACH = math.ceil(3 * math.sqrt(0.04 / (2 * math.pi**2)) * _PER_DEGREE)
"""How far away a pixel can lie that changes the error of another one [px]."""
_NOTHING = 1e-9
"""Weights below this share of the largest do not change a number of 32 bits."""
_BROAD, _LESS_BROAD = (34.1, 0.04), (13.5, 0.025)
_SEEN = ((1.0, 0.0047),), ((1.0, 0.0053),), (_BROAD, _LESS_BROAD)
"""How brightness, red to green and blue to yellow are blurred: the weights and widths of sums of
Gaussians, section 4.1.1."""
_FEATURE = 0.5 * 0.082 * _PER_DEGREE
"""The deviation of the filters that find edges and points [px], section 4.2."""
_COLOUR_POWER, _FEATURE_POWER = np.float32(0.7), np.float32(0.5)
_BEND = 0.4, 0.95
"""Up to this share of the largest difference the error grows to this value, section 4.1.3."""

_SCALE = np.array([24577794, 12288897, 73733382], np.float64)[:, None]
_RGB = np.array(
    [[10135552, 8788810, 4435075], [2613072, 8788810, 887015], [1425312, 8788810, 70074185]]
)
_TO_XYZ = _RGB / _SCALE
"""Linear sRGB to CIE XYZ."""
_WHITE = _TO_XYZ.sum(axis=1)
_TO_SEEN = (_TO_XYZ / _WHITE[:, None]).astype(np.float32)
"""Linear sRGB to XYZ as shares of white."""
_FROM_SEEN = np.linalg.inv(_TO_XYZ / _WHITE[:, None]).astype(np.float32)
_LEVELS = np.arange(256) / 255
_LINEAR = np.where(_LEVELS > 0.04045, ((_LEVELS + 0.055) / 1.055) ** 2.4, _LEVELS / 12.92).astype(
    np.float32
)


@dataclass(frozen=True)
class _Seen:
    """What is seen: colours in a uniform space, and how strong edges and points are."""

    colours: Colours
    edges: Floats
    points: Floats


def flip_errors(old: NDArray[np.uint8], new: NDArray[np.uint8]) -> Floats:
    """The FLIP error of each pixel, 0..1, shape [H, W], of pictures of sRGB, shape [H, W, 3]."""
    first, other = _seen(old), _seen(new)
    colour = _bent(_distance(first.colours, other.colours) ** _COLOUR_POWER)
    feature = np.maximum(np.abs(first.edges - other.edges), np.abs(first.points - other.points))
    feature = (feature * np.float32(math.sqrt(0.5))) ** _FEATURE_POWER
    errors: Floats = colour ** (1 - feature)
    return errors


def _seen(picture: NDArray[np.uint8]) -> _Seen:
    red, green, blue = (_LINEAR[picture[..., channel]] for channel in range(3))
    x, y, z = _product(_TO_SEEN, (red, green, blue))
    opponent = 116 * y - 16, 500 * (x - y), 200 * (y - z)
    blurred = [_blurred(part, seen) for part, seen in zip(opponent, _SEEN, strict=True)]
    return _Seen(_uniform(blurred[0], blurred[1], blurred[2]), *_features(y))


def _product(matrix: Floats, parts: Colours) -> Colours:
    """A matrix and colours, multiplied in a fixed order."""
    a, b, c = parts
    x, y, z = (row[0] * a + row[1] * b + row[2] * c for row in matrix)
    return x, y, z


def _blurred(values: Floats, seen: Sequence[tuple[float, float]]) -> Floats:
    """Values as the eye sees them; `seen` as in _SEEN."""
    offsets = np.arange(-REACH, REACH + 1) / _PER_DEGREE
    rows = [np.exp(-(math.pi**2) / width * offsets**2) for _, width in seen]
    shares = [
        weight * math.sqrt(math.pi / width) * row.sum() ** 2
        for (weight, width), row in zip(seen, rows, strict=True)
    ]
    total: Floats | None = None
    for row, share in zip(rows, shares, strict=True):
        row /= row.sum()
        part = _filtered(_filtered(values, row, 1), row, 0) * np.float32(share / sum(shares))
        total = part if total is None else total + part
    assert total is not None
    return total


def _uniform(bright: Floats, red_green: Floats, blue_yellow: Floats) -> Colours:
    """The Lab colours of opponent ones, as far as a screen shows them."""
    y = (bright + 16) / np.float32(116)
    x, z = y + red_green / np.float32(500), y - blue_yellow / np.float32(200)
    rgb = _product(_FROM_SEEN, (x, y, z))
    clipped: list[Floats] = [np.clip(part, 0, 1) for part in rgb]
    return _lab(clipped[0], clipped[1], clipped[2])


def _lab(red: Floats, green: Floats, blue: Floats) -> Colours:
    """CIE Lab of linear colours, where dark colours are less strong (section 4.1.2)."""
    x, y, z = (_cube_root(part) for part in _product(_TO_SEEN, (red, green, blue)))
    light = 116 * y - 16
    return light, 5 * (x - y) * light, 2 * (y - z) * light


def _cube_root(light: Floats) -> Floats:
    """The cube root of light, and near black a straight line."""
    edge = 6 / 29
    line = light / np.float32(3 * edge**2) + np.float32(4 / 29)
    root: Floats = np.where(light > edge**3, np.cbrt(light), line)
    return root


def _distance(a: Colours, b: Colours) -> Floats:
    """The distance of colours, section 4.1.2: of brightness and of colour, added."""
    light, first, second = (one - two for one, two in zip(a, b, strict=True))
    distance: Floats = np.abs(light) + np.sqrt(first * first + second * second)
    return distance


def _bent(difference: Floats) -> Floats:
    """The error of a difference of colours, 0..1, that spreads the small ones (section 4.1.3)."""
    share, value = _BEND
    bend = np.float32(share * _LARGEST)
    beyond = value + (difference - bend) * np.float32((1 - value) / (_LARGEST * (1 - share)))
    return np.where(difference < bend, difference * np.float32(value / bend), beyond)


def _features(brightness: Floats) -> tuple[Floats, Floats]:
    """How strong edges and points are, which are found along both axes (section 4.2)."""
    reach = math.ceil(3 * _FEATURE)
    offsets = np.arange(-reach, reach + 1)
    blur = np.exp(-(offsets**2) / (2 * _FEATURE**2))
    edge, point = -offsets * blur, ((offsets / _FEATURE) ** 2 - 1) * blur
    blur /= blur.sum()
    blurred = [_filtered(brightness, blur, axis) for axis in (0, 1)]
    found = []
    for row in (edge, point):
        shared = np.where(row > 0, row / row[row > 0].sum(), -row / row[row < 0].sum())
        across, down = (_filtered(blurred[axis], shared, 1 - axis) for axis in (0, 1))
        found.append(np.sqrt(across * across + down * down))
    return found[0], found[1]


def _filtered(values: Floats, weights: NDArray[np.float64], axis: int) -> Floats:
    """A filter along an axis; beyond the edges the outermost values go on.

    weights: an odd number, which are the same, or with the other sign, on both sides.
    """
    middle = len(weights) // 2
    sides = np.abs(weights[middle:])
    reach = int(np.flatnonzero(sides > _NOTHING * sides.max())[-1])
    room = [(0, 0), (0, 0)]
    room[axis] = reach, reach
    wide = np.pad(values, room, mode="edge")
    length = values.shape[axis]

    def moved(step: int) -> Floats:
        place = slice(reach + step, reach + step + length)
        return wide[place] if axis == 0 else wide[:, place]

    odd = weights[0] * weights[-1] < 0
    total = np.float32(weights[middle]) * values
    part = np.empty_like(total)
    for step in range(1, reach + 1):
        (np.subtract if odd else np.add)(moved(step), moved(-step), out=part)
        part *= np.float32(weights[middle + step])
        total += part
    return total


def _largest_distance() -> float:
    """The difference of green and blue, which no other colours exceed."""
    none, full = np.zeros(1, np.float32), np.ones(1, np.float32)
    ends = _lab(none, full, none), _lab(none, none, full)
    return float(_distance(*ends)[0] ** _COLOUR_POWER)


_LARGEST = _largest_distance()
