"""Measures of the difference between two pictures."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Bytes, Channels, Mask, Pixels
from drapery.comparison.difference import Difference
from drapery.comparison.limits import Box
from drapery.comparison.perceptual import perceptual_measures
from drapery.comparison.tolerance import EXACT, Tolerance
from drapery.errors import OptionError

Places = NDArray[np.intp]


SAME, WITHIN, SMOOTHED, BEYOND = range(4)
"""What a pixel of a difference map is: equal to the eye or ignored; within the tolerance of a
pixel; on a smoothed edge that does not count; beyond the tolerance."""

_BLOCK = 1 << 16
"""How many pixels are compared at a time: memory stays small, and a block in the cache."""


def errors(expected: Channels, actual: Channels) -> Channels:
    """The largest channel error of each pixel, shape [H, W], in the pictures' own units.

    The colour of transparent pixels does not count.

    expected: sRGB with straight alpha, shape [H, W, 4].
    actual: the picture to measure, of the same shape.

    Raises OptionError if the sizes differ.
    """
    old, new = _alike(expected, actual)
    difference = np.abs(seen(old).astype(np.int32) - seen(new))
    worst: Channels = difference.max(axis=-1).astype(old.dtype)
    return worst


def measure(
    expected: Channels,
    actual: Channels,
    tolerance: Tolerance = EXACT,
    *,
    ignored: Mask | None = None,
    perceptual: bool = False,
) -> Difference:
    """Measure a picture against the expected one.

    expected: sRGB with straight alpha, shape [H, W, 4], uint8 or uint16; 16 bits count where both
        pictures have them.
    actual: the picture to measure, of the same shape.
    tolerance: what counts as a difference.
    ignored: pixels that do not count, shape [H, W].
    perceptual: measures SSIM, FLIP and CIEDE2000 too; they take longer.

    Raises OptionError if the sizes differ.
    """
    old, new = _alike(expected, actual)
    found = _compared(old, new, tolerance, ignored)
    wanted: dict[str, Any] = {}
    if perceptual or tolerance.perceptual:
        wanted = perceptual_measures(eight_bits(old), eight_bits(new))
    return replace(found, **wanted, exceeded=_exceeded(tolerance, wanted))


def difference_map(
    expected: Channels,
    actual: Channels,
    tolerance: Tolerance = EXACT,
    *,
    ignored: Mask | None = None,
) -> Bytes:
    """What each pixel is: SAME, WITHIN, SMOOTHED or BEYOND, shape [H, W]; see `measure`.

    expected: sRGB with straight alpha, shape [H, W, 4].
    actual: the picture to measure, of the same shape.
    tolerance: what counts as a difference.
    ignored: pixels that do not count, shape [H, W].

    Raises OptionError if the sizes differ.
    """
    old, new = _alike(expected, actual)
    kinds = np.zeros(old.shape[:2], np.uint8)
    for part in _different_parts(old, new, ignored):
        kinds.reshape(-1)[part.places] = _kinds(old, new, part, tolerance)
    return kinds


class _Part(NamedTuple):
    """Pixels of which some bit differs: their places in the joined rows, [n], and the absolute
    errors of their channels, [n, 4]."""

    places: Places
    errors: NDArray[np.int32]


def _different_parts(
    old: Channels, new: Channels, ignored: NDArray[np.bool_] | None
) -> Iterator[_Part]:
    """The pixels that differ, block by block."""
    first, second = old.reshape(-1, 4), new.reshape(-1, 4)
    # A pixel as one number: four times fewer comparisons.
    whole = np.dtype(f"u{4 * old.dtype.itemsize}")
    a, b = first.view(whole).reshape(-1), second.view(whole).reshape(-1)
    for start in range(0, len(a), _BLOCK):
        block = slice(start, start + _BLOCK)
        other = a[block] != b[block]
        if ignored is not None:
            other &= ~ignored.reshape(-1)[block]
        places = np.flatnonzero(other) + start
        if len(places):
            change = seen(first[places]).astype(np.int32) - seen(second[places])
            yield _Part(places, np.abs(change))


def _compared(
    old: Channels, new: Channels, tolerance: Tolerance, ignored: NDArray[np.bool_] | None
) -> Difference:
    counts, largest, total = np.zeros(4, np.int64), 0, 0
    hidden, boxes = 0, {WITHIN: _NO_BOX, BEYOND: _NO_BOX}
    width = old.shape[1]
    for part in _different_parts(old, new, ignored):
        kinds = _kinds(old, new, part, tolerance)
        counts += np.bincount(kinds, minlength=4)
        largest = max(largest, int(part.errors.max()))
        total += int(part.errors.sum(dtype=np.int64))
        hidden += int(np.count_nonzero(kinds == SAME))
        for kind in boxes:
            boxes[kind] = _grown(boxes[kind], part.places[kinds >= kind], width)
    unit = 1 if old.dtype == np.uint8 else 257
    count = old.shape[0] * width
    return Difference(
        pixels=count,
        changed=int(counts[WITHIN:].sum()),
        max_error=largest // unit if largest % unit == 0 else largest / unit,
        mean_error=total / (4 * count * unit) if count else 0.0,
        beyond=int(counts[BEYOND]),
        allowed=tolerance.allowed(count),
        smoothed=int(counts[SMOOTHED]),
        ignored=0 if ignored is None else int(np.count_nonzero(ignored)),
        hidden=hidden,
        box=_box(boxes[BEYOND] if counts[BEYOND] else boxes[WITHIN]),
    )


def _kinds(old: Channels, new: Channels, part: _Part, tolerance: Tolerance) -> NDArray[np.uint8]:
    """What each pixel of a part is, [n]."""
    worst = part.errors.max(axis=1)
    unit = 1 if old.dtype == np.uint8 else 257
    kinds = np.where(worst > tolerance.channel * unit, BEYOND, WITHIN).astype(np.uint8)
    kinds[worst == 0] = SAME
    if tolerance.colour is None and tolerance.antialiasing:
        return kinds
    from drapery.comparison import antialiasing

    a, b = eight_bits(old), eight_bits(new)
    far = np.flatnonzero(kinds == BEYOND)
    if tolerance.colour is not None:
        places = part.places[far]
        rows = [picture.reshape(-1, 4)[places] for picture in (a, b)]
        near = antialiasing.perceived_difference(rows[0], rows[1], places) <= tolerance.colour
        kinds[far[near]] = WITHIN
        far = far[~near]
    if not tolerance.antialiasing:
        kinds[far[antialiasing.is_smoothed(a, b, part.places[far])]] = SMOOTHED
    return kinds


_NO_BOX = (1 << 62, 1 << 62, -1, -1)


def _grown(box: Box, places: Places, width: int) -> Box:
    """A box of left, top, right and bottom that holds the places too."""
    if not len(places):
        return box
    y, x = np.divmod(places, width)
    return (
        min(box[0], int(x.min())),
        min(box[1], int(y[0])),
        max(box[2], int(x.max())),
        max(box[3], int(y[-1])),
    )


def _box(box: Box) -> Box | None:
    left, top, right, bottom = box
    return (left, top, right - left + 1, bottom - top + 1) if right >= left else None


def _exceeded(tolerance: Tolerance, found: Mapping[str, float]) -> tuple[str, ...]:
    """Which perceptual limits the measures exceed, in words."""
    limits = {name: getattr(tolerance, name) for name in ("flip", "ssim", "ciede2000")}
    return tuple(
        f"{name} {found[name]:.4g} is {'below' if name == 'ssim' else 'above'} {limit:g}"
        for name, limit in limits.items()
        if limit is not None and (found[name] < limit if name == "ssim" else found[name] > limit)
    )


def _alike(expected: Channels, actual: Channels) -> tuple[Channels, Channels]:
    """Both pictures with the fewer bits of the two. Raises OptionError if the sizes differ."""
    if expected.shape != actual.shape:
        raise OptionError(
            f"the pictures' sizes differ: {_size(expected)} and {_size(actual)};"
            " compare pictures of one size"
        )
    if expected.dtype != actual.dtype:
        expected, actual = eight_bits(expected), eight_bits(actual)
    return np.ascontiguousarray(expected), np.ascontiguousarray(actual)


def eight_bits(pixels: Channels) -> Pixels:
    """The upper eight bits of each channel, as the game reads pictures of 16 bits."""
    return pixels if pixels.dtype == np.uint8 else (pixels >> 8).astype(np.uint8)


def seen(pixels: Channels) -> Channels:
    """Pictures with the colour of transparent pixels set to 0, shape [..., 4]."""
    seen: Channels = pixels * (pixels[..., 3:] > 0)
    return seen


def _size(pixels: Channels) -> str:
    return f"{pixels.shape[1]}x{pixels.shape[0]}"
