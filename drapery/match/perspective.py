"""The flag in a photo: its four corners found, and its texels sampled through them.

A square is mapped to four corners as in Heckbert, "Fundamentals of Texture Mapping and Image
Warping" (1989), section 2.2.3. Where cloth is not flat, the map is bent in the ways in which
simulated cloth bends: the principal components of many bends (`python -m benchmarks.bends`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Pixels
from drapery.errors import OptionError
from drapery.match.art import HEIGHT, WIDTH
from drapery.match.smooth import Reals, least_squares, products, row_sums

Corner = tuple[float, float]
"""Pixels to the right and down from the picture's upper left corner."""

BEND_ORDERS = 6, 5
"""The highest orders of the polynomials that say how cloth bends, across and down."""
_CORNER = 1.8
"""How far the true corner usually is from where it was given or found [texels]."""

MIN_SIDE = 8.0
"""The shortest side of a flag in a photo [pixels]."""

_AROUND = 0.3
"""How far around the corners the outline of a flag is searched for, as a share of its sides."""
_SAMPLES = 4
"""Samples of a texel along each axis; none lies in its outermost 15 %."""
_APART = 14.0
"""The least distance of a flag's colours from the background's, in 8-bit levels."""
_OUTLINED = 0.65
"""The least overlap of what is seen with the flag, over their union, for finding its edges."""
_EVERY = 5
"""Every fifth place of an edge that is seen counts."""
_EDGE = 0.1
"""The weight of each place of an edge that is seen."""
_EDGE_NOISE = 1.0
"""How far an edge is usually seen from where it is [texels]."""
_SLACK, _FAR = 1.0, 6.0
"""A place of an edge that lies further out than a bend tells counts from and up to [texels]."""
_OUTLINE_FITS = 3
_SURE = 1000.0
"""The weight of a place that is given."""
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
    def to_photo(self) -> Reals:
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

        bend: how far the cloth bends in each of the usual ways, [BENDS]; see `bend_shifts`.
        """
        u, v = _SAMPLE_GRID
        if bend is not None:
            across, down = (bend[:, None, None, None] * _sample_shifts()).sum(axis=0)
            u, v = u + across / WIDTH, v + down / HEIGHT
        samples = self.colours(u, v).reshape(HEIGHT, _SAMPLES, WIDTH, _SAMPLES, 3)
        ordered = np.sort(samples.swapaxes(1, 2).reshape(HEIGHT * WIDTH, _SAMPLES**2, 3), axis=1)
        # The outermost values are those of neighbours, where the cloth is not quite aligned.
        quarter = _SAMPLES**2 // 4
        return np.asarray(ordered[:, quarter:-quarter].mean(axis=1))

    def colours(self, u: Reals, v: Reals) -> Reals:
        """The colours at places of the unit square [...], between pixels, [..., 3]."""
        height, width = self.picture.shape[:2]
        x, y, scale = (row[0] * u + row[1] * v + row[2] for row in self.to_photo)
        x = np.clip(x / scale - 0.5, 0, width - 1.001)
        y = np.clip(y / scale - 0.5, 0, height - 1.001)
        left, top = x.astype(np.intp), y.astype(np.intp)
        right, down = (x - left)[..., None], (y - top)[..., None]
        pixels, first = self._pixels, top * width + left
        upper = pixels[first] * (1 - right) + pixels[first + 1] * right
        lower = pixels[first + width] * (1 - right) + pixels[first + width + 1] * right
        return np.asarray(upper * (1 - down) + lower * down)

    @cached_property
    def _pixels(self) -> NDArray[np.uint8]:
        return self.picture.reshape(-1, 3)

    def outline_bend(self, lowered: float = 0.0) -> Reals:
        """The likeliest bend by the outline alone, [BENDS]: 0 where no outline is seen.

        lowered: how much lower than that the middle of the flag is seen [texels].
        """
        bend = np.zeros(bend_count())
        shifts, apart, _ = self.outline
        for _ in range(_OUTLINE_FITS):
            weights = self.outline_weights(bend)
            bend = least_squares(shifts, apart, weights, np.ones(len(bend)))
        if lowered:
            middle = bend_shifts(np.array([0.5]), np.array([0.5]))[:, 1]
            place = row_sums(middle.T, bend) + lowered
            shifts, apart = np.append(shifts, middle, axis=1), np.append(apart, place)
            weights = np.append(self.outline_weights(bend), _SURE)
            bend = least_squares(shifts, apart, weights, np.ones(len(bend)))
        return bend

    def outline_weights(self, bend: Reals) -> Reals:
        """How much each place of the outline counts: less where it is far from a bend's, [m]."""
        return np.asarray(_EDGE / (1 + (self._outline_rest(bend) / _EDGE_NOISE) ** 2))

    def bend_cost(self, bend: Reals) -> float:
        """How unlikely a bend is: by its size, and by its distance from the outline."""
        away = np.log1p((self._outline_rest(bend) / _EDGE_NOISE) ** 2).sum()
        return float((bend**2).sum() + _EDGE * _EDGE_NOISE**2 * away)

    def left_out(self, bend: Reals) -> float:
        """How much of the flag that is seen lies outside the face that a bend reads [texels]."""
        _, _, outwards = self.outline
        out = np.sign(outwards) * self._outline_rest(bend) - _SLACK
        return float((np.abs(outwards) * np.clip(out, 0, _FAR)).sum())

    def _outline_rest(self, bend: Reals) -> Reals:
        shifts, apart, _ = self.outline
        return np.asarray(apart - row_sums(shifts.T, bend))

    @cached_property
    def outline(self) -> tuple[Reals, Reals, Reals]:
        """Places along the flag's edges: their `bend_shifts` across the edge [BENDS, m], how far
        from the straight edge each is seen [texels], [m], and how far it is to the next place
        [texels], [m], below 0 where the flag lies in the positive direction.

        There are none where no flag before a background of one colour is seen between the corners.
        """
        part = flag_part(self.picture)
        nothing = np.zeros((bend_count(), 0)), np.zeros(0), np.zeros(0)
        if part is None:
            return nothing
        u = np.linspace(-_AROUND, 1 + _AROUND, int(20 * (1 + 2 * _AROUND) * WIDTH))
        v = np.linspace(-_AROUND, 1 + _AROUND, int(10 * (1 + 2 * _AROUND) * HEIGHT))
        across, down = np.meshgrid(u, v)
        x, y, scale = (row[0] * across + row[1] * down + row[2] for row in self.to_photo)
        column = np.clip(x / scale, 0, part.shape[1] - 1).astype(np.intp)
        line = np.clip(y / scale, 0, part.shape[0] - 1).astype(np.intp)
        seen = part[line, column]
        inside = (np.abs(across - 0.5) < 0.5) & (np.abs(down - 0.5) < 0.5)
        if (seen & inside).sum() < _OUTLINED * (seen | inside).sum():
            return nothing
        rows = np.flatnonzero((v > 0.05) & (v < 0.95) & seen.any(axis=1))[::_EVERY]
        columns = np.flatnonzero((u > 0.1) & (u < 0.9) & seen.any(axis=0))[::_EVERY]
        left = u[seen[rows].argmax(axis=1)]
        right = u[len(u) - 1 - seen[rows][:, ::-1].argmax(axis=1)] - 1
        low = v[len(v) - 1 - seen[:, columns][::-1].argmax(axis=0)] - 1
        # The upper edge hangs on a bar, which is not told from the flag; it is taken as straight.
        sides = bend_shifts(np.repeat([0.0, 1.0], len(rows)), np.tile(v[rows], 2))[:, 0]
        ends = bend_shifts(np.tile(u[columns], 2), np.repeat([0.0, 1.0], len(columns)))[:, 1]
        straight = np.zeros(len(columns))
        apart = np.concatenate([left * WIDTH, right * WIDTH, straight, low * HEIGHT])
        steps = _EVERY * (v[1] - v[0]) * HEIGHT, _EVERY * (u[1] - u[0]) * WIDTH
        places = (len(rows), len(rows), len(columns), len(columns))
        outwards = np.repeat([-steps[0], steps[0], -steps[1], steps[1]], places)
        return np.concatenate([sides, ends], axis=1), apart, outwards


def _grid(samples: int, margin: float) -> tuple[Reals, Reals]:
    inside = margin + (np.arange(samples) + 0.5) / samples * (1 - 2 * margin)
    u = ((np.arange(WIDTH)[:, None] + inside) / WIDTH).ravel()
    v = ((np.arange(HEIGHT)[:, None] + inside) / HEIGHT).ravel()
    across, down = np.meshgrid(u, v)
    return across, down


_SAMPLE_GRID = _grid(_SAMPLES, 0.15)


@cache
def _bend_modes() -> Reals:
    """The polynomials of each usual way of bending [texels], [BENDS, 2, terms]."""
    text = files("drapery.match").joinpath("bends.txt").read_text("utf-8")
    rows = [line.split() for line in text.splitlines() if not line.startswith("#")]
    cloth = np.array(rows, np.float64).reshape(len(rows), 2, -1)
    corners = np.zeros((2, 2, 2, *cloth.shape[1:]))
    for axis, down, across in np.ndindex(2, 2, 2):
        corners[axis, down, across, axis, down * (BEND_ORDERS[0] + 1) + across] = _CORNER / 2
    return np.concatenate([corners.reshape(8, *cloth.shape[1:]), cloth])


def bend_count() -> int:
    """BENDS: the number of usual ways in which a flag bends."""
    return len(_bend_modes())


def bend_shifts(u: Reals, v: Reals) -> Reals:
    """How far each usual way of bending moves places of the unit square [...], in texels.

    [BENDS, 2, ...]: across and down. The first eight move the corners.
    """
    terms = products(u, v, *BEND_ORDERS)
    modes = _bend_modes().reshape(-1, len(terms), *(1 for _ in u.shape))
    return np.stack([(mode * terms).sum(axis=0) for mode in modes]).reshape(-1, 2, *u.shape)


@cache
def _sample_shifts() -> Reals:
    return bend_shifts(*_SAMPLE_GRID)


@cache
def texel_shifts() -> Reals:
    """The `bend_shifts` of the middle of each texel, [BENDS, 2, HEIGHT * WIDTH]."""
    return bend_shifts(*_grid(1, 0.0)).reshape(bend_count(), 2, -1)


def find_corners(picture: Pixels) -> tuple[Corner, ...]:
    """The corners of a flag before a background of one colour: the edges of what is largest there.

    picture: [H, W, 3]. The flag must stand upright, and wholly in the picture.
    Raises OptionError if nothing there has the shape of a flag.
    """
    part = flag_part(picture)
    corners = None if part is None else _quadrilateral(part)
    if corners is None:
        raise OptionError(
            "no flag was found before a background of one colour; give its corners with --corners"
        )
    return corners


def flag_part(picture: NDArray[np.uint8]) -> NDArray[np.bool_] | None:
    """The pixels of the largest thing before a background of one colour, without its pole.

    picture: [H, W, 3]. None if nothing there is as large as a flag.
    """
    from scipy.ndimage import binary_fill_holes, label

    edge = np.concatenate([picture[0], picture[-1], picture[:, 0], picture[:, -1]])
    background = np.median(edge.astype(np.float64), axis=0)
    apart = np.zeros(picture.shape[:2], bool)
    for channel, level in enumerate(background):  # a copy of all channels takes much memory
        apart |= np.abs(picture[..., channel] - level) > _APART
    parts, count = label(apart)
    if not count:
        return None
    sizes = np.bincount(parts.ravel())
    sizes[0] = 0
    part = binary_fill_holes(parts == sizes.argmax())
    # What is narrower than a sixth of the flag goes: the pole below it.
    width = int(np.median(part.sum(axis=1)[part.any(axis=1)]))
    if width >= MIN_SIDE:
        part = _long_runs(part, max(width // 6, 1))
    return part if part.sum() > MIN_SIDE**2 else None


def _long_runs(part: NDArray[np.bool_], least: int) -> NDArray[np.bool_]:
    """The pixels in rows of at least `least`: an opening, at any length in the same time."""
    counts = np.cumsum(np.pad(part, ((0, 0), (1, 0))), axis=1)
    whole = counts[:, least:] - counts[:, :-least] == least
    starts = np.cumsum(np.pad(whole, ((0, 0), (least, least - 1))), axis=1)
    return np.asarray(starts[:, least:] > starts[:, :-least])


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


def flat_face(picture: Pixels, corners: Sequence[Corner]) -> Pixels:
    """The flag of a photo set upright, uint8, shape [40, 20, 3].

    picture: the photo, shape [H, W, 3].
    corners: upper left, upper right, lower right, lower left.

    Raises OptionError for corners that a flag cannot have.
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
