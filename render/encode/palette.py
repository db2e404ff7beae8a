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
        pixels = np.dstack([over_matte(pixels, matte), alpha])
    # A pixel as one number: alpha, blue, green and red, from the highest byte on.
    words = np.ascontiguousarray(pixels).view("<u4")[..., 0]
    low = np.uint32(255)
    packed = (words & low) << np.uint32(16) | words & (low << np.uint32(8))
    packed |= words >> np.uint32(16) & low
    return packed, (alpha >= 128 if matte is None else alpha > 0)


def over_matte(pixels: Pixels, matte: Matte) -> Colours:
    """The picture over one colour: round((a * src + (255 - a) * matte) / 255), [H, W, 3]."""
    # Few pixels are half-transparent; the others are those of the picture or of the matte, and
    # whole pixels are copied several times as fast as their bytes.
    words = np.ascontiguousarray(pixels).reshape(-1, 4).view("<u4")[:, 0]
    alpha = words >> np.uint32(24)
    behind = np.array([*matte, 255], np.uint8)
    laid = np.where(alpha == 0, behind.view("<u4"), words).view(np.uint8).reshape(-1, 4)
    # Of 0 the difference is the largest number.
    soft = np.flatnonzero(alpha - np.uint32(1) < np.uint32(254))
    some = pixels.reshape(-1, 4)[soft].astype(np.uint32)
    mixed = some[:, 3:] * some[:, :3] + (255 - some[:, 3:]) * behind[:3].astype(np.uint32)
    laid[soft, :3] = (mixed + 127) // 255
    return np.ascontiguousarray(laid[:, :3]).reshape(*pixels.shape[:-1], 3)


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
