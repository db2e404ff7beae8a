"""At most 255 colours for an animation, exact wherever that is possible."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from drapery.arrays import Pixels

Places = NDArray[np.int32]
Colours = NDArray[np.uint8]
Matte = tuple[int, int, int]

MAX_COLOURS = 255  # one of a GIF's 256 is the transparent one
MAX_SAMPLES = 1 << 18
MANY_COLOURS = 1 << 16


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
    entries are found by median cut (Heckbert 1982). Place 0 stays place 0.
    """
    if len(colours) <= 1 + MAX_COLOURS:
        return colours, np.arange(len(colours), dtype=np.uint8)
    exact = 1 + np.flatnonzero(counts[1:] * MAX_COLOURS >= counts[1:].sum())
    exact = exact[:MAX_COLOURS]
    rest = np.setdiff1d(np.arange(1, len(colours)), exact)
    cut = median_cut(colours[rest], counts[rest], MAX_COLOURS - exact.size)
    palette = np.concatenate([colours[:1], colours[exact], cut])
    places = 1 + nearest(colours, palette[1:])
    places[0] = 0
    return palette, places.astype(np.uint8)


def median_cut(colours: Colours, counts: NDArray[np.int64], size: int) -> Colours:
    """At most `size` colours that represent weighted ones, shape [size, 3]."""
    if size == 0:
        return np.zeros((0, 3), np.uint8)
    if len(colours) > MANY_COLOURS:
        colours, counts = _merged(colours, counts)
    weights = -(-counts * MAX_SAMPLES // max(int(counts.sum()), MAX_SAMPLES))
    samples = np.repeat(colours, weights, axis=0)
    image = Image.fromarray(samples[None])
    few = image.quantize(size, Image.Quantize.MEDIANCUT, kmeans=1, dither=Image.Dither.NONE)
    entries = few.getpalette() or []
    return np.array(entries[: 3 * size], np.uint8).reshape(-1, 3)


def _merged(colours: Colours, counts: NDArray[np.int64]) -> tuple[Colours, NDArray[np.int64]]:
    """Colours rounded to the middles of cells of 4 x 4 x 4, with their counts summed.

    This leaves about a tenth of the colours, and changes none by more than two levels.
    """
    cells, cell = np.unique(colours >> 2, axis=0, return_inverse=True)
    summed = np.bincount(cell.reshape(-1), weights=counts, minlength=len(cells))
    return (cells << 2) + np.uint8(2), summed.astype(np.int64)


def nearest(colours: Colours, palette: Colours) -> NDArray[np.intp]:
    """For each colour the index of the closest palette entry; of equally close ones the first.

    |c - p|² = |c|² + (|p|² - 2 c·p): whole numbers under 2^24, so that a product of matrices is
    exact in single precision, in whatever order it is summed.
    """
    parts = np.array_split(colours.astype(np.float32), len(colours) // 4096 + 1)
    wide = palette.astype(np.float32)
    squares = (wide * wide).sum(axis=1)
    return np.concatenate([(squares - 2 * (part @ wide.T)).argmin(axis=1) for part in parts])
