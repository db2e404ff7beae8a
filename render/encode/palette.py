"""At most 255 colours for an animation, exact wherever that is possible."""

from dataclasses import dataclass, field
from heapq import heappop, heappush

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Pixels

Places = NDArray[np.int32]
Colours = NDArray[np.uint8]
Matte = tuple[int, int, int]

MAX_COLOURS = 255  # one of a GIF's 256 is the transparent one
BAND = 64
"""Rows of a picture that are laid over a colour at one time."""
CHANNELS = np.uint32(0x00FF00FF)
"""Two channels of a pixel, red and blue."""


@dataclass
class ColourTable:
    """The colours found so far, in order of appearance; place 0 stands for transparent.

    known: packed 24-bit colours, in order. counts: pixels of each, by place.
    """

    known: list[NDArray[np.uint32]] = field(default_factory=list)
    counts: NDArray[np.int64] = field(default_factory=lambda: np.zeros(1, np.int64))
    # The system allocates a page of this only when a colour in it is used.
    place_of: Places = field(default_factory=lambda: np.zeros(1 << 24, np.int32))

    def places(self, pixels: Pixels, matte: Matte | None) -> Places:
        """The place of every pixel's colour, shape [H, W]; 0 where it is transparent."""
        packed, visible = opaque_colours(pixels, matte)
        shown = packed[visible]
        found = self.place_of[shown]
        unknown = np.flatnonzero(found == 0)
        if unknown.size:
            self._learn(np.unique(shown[unknown]))
            found[unknown] = self.place_of[shown[unknown]]
        self.counts += np.bincount(found, minlength=self.counts.size)
        self.counts[0] += visible.size - found.size
        places = np.zeros(visible.shape, np.int32)
        places[visible] = found
        return places

    def _learn(self, fresh: NDArray[np.uint32]) -> None:
        self.place_of[fresh] = np.arange(self.counts.size, self.counts.size + fresh.size)
        self.known.append(fresh)
        self.counts = np.concatenate([self.counts, np.zeros(fresh.size, np.int64)])

    def colours(self) -> Colours:
        """Every colour by place, shape [1 + n, 3]; place 0 is black."""
        packed = np.concatenate([np.zeros(1, np.uint32), *self.known])
        return np.stack([packed >> 16, packed >> 8 & 255, packed & 255], axis=-1).astype(np.uint8)


def opaque_colours(
    pixels: Pixels, matte: Matte | None
) -> tuple[NDArray[np.uint32], NDArray[np.bool_]]:
    """Packed 24-bit colours, and which pixels are visible in a format with one bit of alpha.

    Without a matte, pixels of at least half alpha are visible in their colour. With a matte, all
    pixels that are not fully transparent are visible, composited over the matte.
    """
    alpha = pixels[..., 3]
    if matte is not None:
        pixels = over_matte(pixels, matte)
    # A pixel as one number: alpha, blue, green and red, from the highest byte on.
    words = np.ascontiguousarray(pixels).view("<u4")[..., 0]
    low = np.uint32(255)
    packed = (words & low) << np.uint32(16) | words & (low << np.uint32(8))
    packed |= words >> np.uint32(16) & low
    return packed, (alpha >= 128 if matte is None else alpha > 0)


def over_matte(pixels: Pixels, matte: Matte) -> Pixels:
    """The picture over one colour, opaque: round((a * src + (255 - a) * matte) / 255)."""
    height, width = pixels.shape[:2]
    words = np.ascontiguousarray(pixels).view("<u4").reshape(-1)
    behind = np.array([*matte, 255], np.uint8).view("<u4")
    laid = np.empty_like(words)
    # Some rows at a time, so that what is between the steps stays in the processor's cache.
    for first in range(0, height * width, BAND * width):
        part = slice(first, first + BAND * width)
        _lay_over(words[part], behind, laid[part])
    return laid.view(np.uint8).reshape(height, width, 4)


def _lay_over(
    words: NDArray[np.uint32], behind: NDArray[np.uint32], laid: NDArray[np.uint32]
) -> None:
    """Lay pixels, each one number with alpha as its highest byte, over one that is opaque."""
    opaque = words >= np.uint32(0xFF000000)
    laid[:] = behind
    np.copyto(laid, words, where=opaque)
    soft = np.flatnonzero(~opaque & (words > np.uint32(0xFFFFFF)))
    if not soft.size:
        return
    some = words[soft]
    alpha = some >> np.uint32(24)
    mixed = np.full_like(some, 0xFF000000)
    for shift in (np.uint32(0), np.uint32(8)):
        # Two channels at once, 16 bits each, divided by 255 with rounding.
        top, below = some >> shift & CHANNELS, behind >> shift & CHANNELS
        sums = top * alpha + below * (np.uint32(255) - alpha) + np.uint32(0x00800080)
        sums += sums >> np.uint32(8) & CHANNELS
        mixed |= (sums >> np.uint32(8) & CHANNELS) << shift
    laid[soft] = mixed


def reduced(colours: Colours, counts: NDArray[np.int64]) -> tuple[Colours, NDArray[np.uint8]]:
    """A palette of at most 1 + 255 colours, and for each place of `colours` its place in it.

    A colour of at least 1/255 of the pixels gets an entry to itself, so it stays exact. The other
    entries are found by cuts of the variance. Place 0 stays place 0.
    """
    if len(colours) <= 1 + MAX_COLOURS:
        return colours, np.arange(len(colours), dtype=np.uint8)
    exact = 1 + np.flatnonzero(counts[1:] * MAX_COLOURS >= counts[1:].sum())
    exact = exact[:MAX_COLOURS]
    rest = np.setdiff1d(np.arange(1, len(colours)), exact)
    cut = variance_cut(colours[rest], counts[rest], MAX_COLOURS - exact.size)
    palette = np.concatenate([colours[:1], colours[exact], cut])
    places = 1 + nearest(colours, palette[1:])
    places[0] = 0
    return palette, places.astype(np.uint8)


def variance_cut(colours: Colours, counts: NDArray[np.int64], size: int) -> Colours:
    """At most `size` colours that represent weighted ones, shape [size, 3].

    The group with the largest sum of squared errors is cut in two, again and again, in its worst
    channel and where the least error is left (Wu 1991). Each group becomes its mean.
    """
    weights = counts.astype(np.float64)
    # Of equal errors the group of the first colour is cut.
    groups = [(*_cut(colours, weights), 0, np.arange(len(colours)))]
    while len(groups) < size and groups[0][0] < 0:
        _, channel, level, _, group = heappop(groups)
        below = colours[group, channel] <= level
        for part in (group[below], group[~below]):
            heappush(groups, (*_cut(colours[part], weights[part]), int(part[0]), part))
    parts = [part for *_, part in groups]
    sums = [(weights[part, None] * colours[part]).sum(axis=0) for part in parts]
    means = [each / weights[part].sum() for each, part in zip(sums, parts, strict=True)]
    return np.floor(np.array(means[:size]) + 0.5).astype(np.uint8).reshape(-1, 3)


def _cut(colours: Colours, weights: NDArray[np.float64]) -> tuple[float, int, int]:
    """The sum of squared errors of a group, negative, and the channel and level of its best cut.

    All sums are of whole numbers below 2^53: the same in any order.
    """
    levels = np.arange(256.0)
    counts = np.stack([np.bincount(channel, weights, 256) for channel in colours.T])
    total, sums = int(weights.sum()), [int(each) for each in (counts * levels).sum(axis=1)]
    squares = [int(each) for each in (counts * levels**2).sum(axis=1)]
    # Exact, as products are Python's whole numbers: 0 for colours that are alike.
    errors = [each * total - one * one for each, one in zip(squares, sums, strict=True)]
    channel = errors.index(max(errors))
    below, reached = np.cumsum(counts[channel]), np.cumsum(counts[channel] * levels)
    apart = np.maximum(below * (total - below), 1)
    gains = np.square(reached * total - sums[channel] * below) / apart
    return -sum(errors) / total, channel, int(np.argmax(gains))


def nearest(colours: Colours, palette: Colours) -> NDArray[np.intp]:
    """For each colour the index of the closest palette entry; of equally close ones the first.

    |c - p|² = |c|² + (|p|² - 2 c·p): whole numbers under 2^24, so that a product of matrices is
    exact in single precision, in whatever order it is summed.
    """
    parts = np.array_split(colours.astype(np.float32), len(colours) // 4096 + 1)
    wide = palette.astype(np.float32)
    squares = (wide * wide).sum(axis=1)
    return np.concatenate([(squares - 2 * (part @ wide.T)).argmin(axis=1) for part in parts])
