"""The flag in a photo: its four corners found, and its texels sampled through them.

A square is mapped to four corners as in Heckbert, "Fundamentals of Texture Mapping and Image
Warping" (1989), section 2.2.3. A polynomial bends the map where cloth is not flat.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError
from drapery.match.art import HEIGHT, WIDTH

Reals = NDArray[np.float64]
Corner = tuple[float, float]
"""Pixels to the right and down from the picture's upper left corner."""

BENDS = 10
"""Numbers of a bend along one axis: the factors of the polynomial's terms."""

MIN_SIDE = 8.0
"""The shortest side of a flag in a photo [pixels]."""

_SAMPLES = 4
"""Samples of a texel along each axis; none lies in its outermost 15 %."""
_APART = 14.0
"""The least distance of a flag's colours from the background's, in 8-bit levels."""
_FILLED = 0.85
"""The least part of the quadrilateral that a flag fills."""


@dataclass(frozen=True, eq=False)
class PhotoView:
    """A photo [H, W, 3] and the corners of the flag: upper left, upper right, lower right, lower
    left, as one sees it."""

    picture: NDArray[np.uint8]
    corners: tuple[Corner, ...]

    def __post_init__(self) -> None:
        points = np.array(self.corners, np.float64)
        if points.shape != (4, 2) or not np.isfinite(points).all():
            raise OptionError(
                "give four corners: x,y of the upper left, upper right, lower right, and lower left"
            )
        sides = np.roll(points, -1, axis=0) - points
        turns = sides[:, 0] * np.roll(sides[:, 1], -1) - sides[:, 1] * np.roll(sides[:, 0], -1)
        if (turns <= 0).any() or np.hypot(*sides.T).min() < MIN_SIDE:
            raise OptionError(
                "the corners do not span a flag; give upper left, upper right, lower right, lower"
                f" left, at least {MIN_SIDE:g} pixels apart"
            )

    @cached_property
    def _map(self) -> Reals:
        """From the unit square to the photo, in homogeneous coordinates, [3, 3]."""
        (x0, y0), (x1, y1), (x2, y2), (x3, y3) = self.corners
        across, down = (x1 - x2, y1 - y2), (x3 - x2, y3 - y2)
        rest = (x0 - x1 + x2 - x3, y0 - y1 + y2 - y3)
        area = across[0] * down[1] - down[0] * across[1]
        g = (rest[0] * down[1] - down[0] * rest[1]) / area
        h = (across[0] * rest[1] - rest[0] * across[1]) / area
        return np.array(
            [
                [x1 - x0 + g * x1, x3 - x0 + h * x3, x0],
                [y1 - y0 + g * y1, y3 - y0 + h * y3, y0],
                [g, h, 1.0],
            ]
        )

    def face(self, bend: Reals | None = None) -> Reals:
        """The mean colour of each texel, [HEIGHT * WIDTH, 3].

        bend: how far the texels lie from where the corners put them [texels], [2, BENDS].
        """
        from scipy.ndimage import map_coordinates

        u, v = _SAMPLE_GRID
        if bend is not None:
            shift = (bend[:, :, None, None] * _SAMPLE_TERMS).sum(axis=1)
            u, v = u + shift[0] / WIDTH, v + shift[1] / HEIGHT
        x, y, scale = (row[0] * u + row[1] * v + row[2] for row in self._map)
        places = np.stack([y / scale - 0.5, x / scale - 0.5])
        channels = [
            map_coordinates(
                self.picture[..., channel].astype(np.float64), places, order=1, mode="nearest"
            )
            for channel in range(3)
        ]
        shape = (HEIGHT, _SAMPLES, WIDTH, _SAMPLES)
        means = [channel.reshape(shape).mean(axis=(1, 3)) for channel in channels]
        return np.stack(means, axis=-1).reshape(-1, 3)


def bend_terms(u: Reals, v: Reals) -> Reals:
    """The terms of a bend's polynomial at places of the unit square, [BENDS, ...]."""
    x, y = u - 0.5, v - 0.5
    return np.stack(
        [np.ones_like(x), x, y, x * y, x * x, y * y, x * x * y, x * y * y, y**3, x * y**3]
    )


def _grid(samples: int, margin: float) -> tuple[Reals, Reals]:
    inside = margin + (np.arange(samples) + 0.5) / samples * (1 - 2 * margin)
    u = ((np.arange(WIDTH)[:, None] + inside) / WIDTH).ravel()
    v = ((np.arange(HEIGHT)[:, None] + inside) / HEIGHT).ravel()
    across, down = np.meshgrid(u, v)
    return across, down


_SAMPLE_GRID = _grid(_SAMPLES, 0.15)
_SAMPLE_TERMS = bend_terms(*_SAMPLE_GRID)
TEXEL_TERMS = bend_terms(*_grid(1, 0.0)).reshape(BENDS, -1)
"""The terms at the middle of each texel, [BENDS, HEIGHT * WIDTH]."""


def find_corners(picture: NDArray[np.uint8]) -> tuple[Corner, ...]:
    """The corners of a flag before a background of one colour: the edges of what is largest there.

    picture: [H, W, 3]. The flag must stand upright, and wholly in the picture.
    Raises OptionError if nothing there has the shape of a flag.
    """
    from scipy.ndimage import binary_fill_holes, binary_opening, label

    edge = np.concatenate([picture[0], picture[-1], picture[:, 0], picture[:, -1]])
    background = np.median(edge.astype(np.float64), axis=0)
    apart = np.abs(picture - background).max(axis=-1) > _APART
    parts, count = label(apart)
    sizes = np.bincount(parts.ravel(), minlength=count + 1)
    sizes[0] = 0
    part = binary_fill_holes(parts == sizes.argmax())
    # What is narrower than a sixth of the flag goes: the pole below it.
    width = int(np.median(part.sum(axis=1)[part.any(axis=1)])) if count else 0
    if width >= MIN_SIDE:
        part = binary_opening(part, np.ones((1, max(width // 6, 1)), bool))
    corners = _quadrilateral(part) if part.sum() > MIN_SIDE**2 else None
    if corners is None:
        raise OptionError(
            "no flag was found before a background of one colour; give its corners with --corners"
        )
    return corners


def _quadrilateral(part: NDArray[np.bool_]) -> tuple[Corner, ...] | None:
    """The corners where straight lines along a part's four edges meet; None if it is no flag."""
    lines = [*_edge_lines(part), *_edge_lines(part.T)]
    (left, right), (top, bottom) = lines[:2], lines[2:]
    corners = tuple(
        _meeting(side, end)
        for side, end in ((left, top), (right, top), (right, bottom), (left, bottom))
    )
    points = np.array(corners)
    after = np.roll(points, -1, axis=0)
    area = (points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0]).sum() / 2
    tall = np.hypot(*(points[3] - points[0])) / max(np.hypot(*(points[1] - points[0])), 1e-9)
    if not np.isfinite(points).all() or not _FILLED < part.sum() / max(area, 1) < 1 / _FILLED:
        return None
    return corners if 1 < tall < 8 else None


def _edge_lines(part: NDArray[np.bool_]) -> list[tuple[float, float]]:
    """The lines x = a + b y along the first and the last pixels of each row."""
    rows = np.flatnonzero(part.any(axis=1))
    cut = len(rows) // 10
    rows = rows[cut : len(rows) - cut]
    first = part[rows].argmax(axis=1).astype(np.float64)
    last = part.shape[1] - part[rows, ::-1].argmax(axis=1).astype(np.float64)
    middles = rows.astype(np.float64) + 0.5
    return [_line(middles, first), _line(middles, last)]


def _line(y: Reals, x: Reals) -> tuple[float, float]:
    """The line x = a + b y of least absolute distances, by weights that are made anew ten times."""
    weights = np.ones(len(y))
    for _ in range(10):
        total = weights.sum()
        mean_y, mean_x = (weights * y).sum() / total, (weights * x).sum() / total
        spread = (weights * (y - mean_y) ** 2).sum()
        slope = (weights * (y - mean_y) * (x - mean_x)).sum() / max(spread, 1e-9)
        weights = 1 / np.maximum(np.abs(x - mean_x - slope * (y - mean_y)), 0.5)
    return float(mean_x - slope * mean_y), float(slope)


def _meeting(side: tuple[float, float], end: tuple[float, float]) -> Corner:
    """Where x = a + b y meets y = c + d x."""
    (a, b), (c, d) = side, end
    y = (c + d * a) / (1 - d * b)
    return a + b * y, y


def flat_face(picture: NDArray[np.uint8], corners: Sequence[Corner]) -> NDArray[np.uint8]:
    """The flag of a photo [H, W, 3] set upright, uint8 [40, 20, 3].

    corners: upper left, upper right, lower right, lower left. Raises OptionError.
    """
    face = PhotoView(checked_picture(picture), as_corners(corners)).face()
    return np.rint(face).astype(np.uint8).reshape(HEIGHT, WIDTH, 3)


def checked_picture(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The colours [H, W, 3] of a picture with or without alpha. Raises OptionError for others."""
    array = np.asarray(picture)
    if array.ndim != 3 or array.shape[2] not in (3, 4) or array.dtype != np.uint8:
        raise OptionError(f"the photo is {array.dtype} {list(array.shape)}; give uint8 [H, W, 3]")
    if min(array.shape[:2]) < MIN_SIDE:
        raise OptionError(f"the photo is {array.shape[1]}x{array.shape[0]}; give a larger one")
    return array[..., :3]


def as_corners(points: Sequence[Corner]) -> tuple[Corner, ...]:
    """Corners as pairs of floats."""
    return tuple((float(x), float(y)) for x, y in points)
