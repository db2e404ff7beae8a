"""The place of each large pixel whose colour it shows."""

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Mask, Pixels

PLACES = 3
"""Places across a large pixel, and down it, of which it shows one."""
CLEAR = 9 * 24**2
"""The square of the distance of colours that are clearly apart: greys of 24 levels."""

Item = TypeVar("Item", bound=np.generic)
Colours = NDArray[np.int32]
Numbers = NDArray[np.intp]


def typical_places(pixels: Pixels, step: int) -> tuple[Numbers, Numbers]:
    """Row and column of the place that each square of `step` x `step` pixels shows.

    Of a line as thin as a square it is a place in the square that has the line's middle, so that
    the line is one square wide all along. Elsewhere most places in a square show as much, and are
    least apart in colour from the others. Single squares do not stick out of the outline.

    pixels: [H, W, 4].
    """
    each = min(PLACES, step)
    rows, columns = (_places(side, step, each) for side in pixels.shape[:2])
    found = pixels[np.ix_(rows.reshape(-1), columns.reshape(-1))].astype(np.int32)
    found[..., :3] *= found[..., 3:] > 0
    cells = _by_square(found, each)
    best = np.full(len(cells), each * each // 2)
    (mixed,) = np.nonzero((cells != cells[:, :1]).any(axis=(1, 2)))
    marks = [
        [
            _by_square(each_mark[..., None], each)[mixed, :, 0]
            for each_mark in _thin(found, axis, each)
        ]
        for axis in (0, 1)
    ]
    best[mixed] = _most_typical(cells[mixed], marks)
    alpha, shape = cells[..., 3], (len(rows), len(columns))
    shown = alpha[np.arange(len(cells)), best].reshape(shape) > 0
    alone = _sticks_out(shown).reshape(-1)
    best[alone] = np.argmin(alpha[alone], axis=-1)
    row, column = (best // each).reshape(shape), (best % each).reshape(shape)
    return rows[np.arange(shape[0])[:, None], row], columns[np.arange(shape[1])[None], column]


def _most_typical(cells: Colours, marks: list[list[Mask]]) -> Numbers:
    """The number of a place in each square. cells: shape [N, P, 4].

    marks: which places are in the middle of thin lines, and which beside it, shape [N, P], for
        lines across and for upright ones.
    """
    squares = _distances(cells[:, :, None], cells[:, None])
    alike, count = squares < CLEAR, cells.shape[1]
    lines, beside = np.zeros((2, *cells.shape[:2]), np.int64)
    for inside, outside in marks:
        lines = np.maximum(lines, inside * (alike & inside[:, None]).sum(axis=-1))
        beside |= outside
    # Whole 256ths of levels, which add up to the same in any order; the middle wins if equal.
    apart = np.sqrt(squares * 65536.0).astype(np.int64) * (1 - beside)[:, None]
    costs = apart.sum(axis=-1) + (beside << 32)
    costs[:, count // 2] -= 1
    lined = 2 * lines.max(axis=-1) > int(count**0.5)
    best: Numbers = np.where(lined, np.argmax(lines, axis=-1), np.argmin(costs, axis=-1))
    return best


def _by_square(values: NDArray[Item], each: int) -> NDArray[Item]:
    """The places of each square, shape [N, each * each, C]. values: shape [H, W, C]."""
    height, width, count = values.shape
    parts = values.reshape(height // each, each, width // each, each, count).swapaxes(1, 2)
    return parts.reshape(-1, each * each, count)


def _places(side: int, step: int, each: int) -> Numbers:
    """`each` places along every `step` pixels of a side, evenly, shape [squares, each]."""
    first = np.arange(-(-side // step), dtype=np.intp)[:, None] * step
    inside: Numbers = (2 * np.arange(each, dtype=np.intp) + 1) * step // (2 * each)
    places: Numbers = np.minimum(first + inside, side - 1)
    return places


def _distances(ones: Colours, others: Colours) -> Colours:
    """Squares of the distances of colours, weighted by how bright a channel is."""
    apart = ones - others
    squares: Colours = (apart * apart * np.array([2, 4, 3, 9], np.int32)).sum(axis=-1)
    return squares


def _thin(found: Colours, axis: int, each: int) -> tuple[Mask, Mask]:
    """The middles of lines that are thin along an axis, and what of them is in other squares.

    found: places, `each` along a side of a square, shape [H, W, 4]. A line is at most half as wide
    again as a square, and is clearly apart from what is visible at both sides of it.
    """
    places = np.moveaxis(found, axis, 0)
    count = len(places)
    at = np.arange(count)[:, None]
    ends = _distances(places[1:], places[:-1]) >= CLEAR
    edge = np.ones((1, places.shape[1]), np.bool_)
    first = np.maximum.accumulate(np.where(np.concatenate([edge, ends]), at, 0), axis=0)
    last = np.where(np.concatenate([ends, edge]), at, count)[::-1]
    last = np.minimum.accumulate(last, axis=0)[::-1]
    shown = places[..., 3] > 0
    before = np.take_along_axis(shown, np.maximum(first - 1, 0), axis=0) & (first > 0)
    after = np.take_along_axis(shown, np.minimum(last + 1, count - 1), axis=0) & (last + 1 < count)
    thin = (last - first < each + each // 2) & shown & before & after
    middle = (first + last) // 2
    inside, outside = thin & (at == middle), thin & (at // each != middle // each)
    return np.moveaxis(inside, 0, axis), np.moveaxis(outside, 0, axis)


def _sticks_out(shown: Mask) -> Mask:
    """Single squares that stick out of a straight edge, shape [H, W]: a corner of a fold does."""
    found = np.zeros(shown.shape, np.bool_)
    for turn in range(4):
        turned, result = np.rot90(np.pad(shown, 1, mode="edge"), turn), np.rot90(found, turn)
        above, level, below = turned[:-2], turned[1:-1], turned[2:]
        alone = level[:, 1:-1] & ~level[:, :-2] & ~level[:, 2:] & ~above[:, 1:-1]
        result |= alone & below[:, 1:-1] & (below[:, :-2] | below[:, 2:])
    return found
