"""Picture steps for pixel art: large pixels, few colours, and edges that do not creep."""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Annotated, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from drapery.render.buffers import Buffers
from drapery.styles.canvas import VISIBLE, Canvas
from drapery.styles.colours import Words, as_pixels
from drapery.styles.step import costs, over_time

COLOUR = np.uint32(0xFFFFFF)
"""The part of a word that is not alpha."""
MOST_COLOURS = 256
"""Rarer colours than so many do not enter the search of `limit`."""
PASSES = 4
"""How often `steady` goes around a loop before it stops waiting for the end to meet the start."""

Item = TypeVar("Item", bound=np.generic)

AROUND = [(row, column) for row in (-1, 0, 1) for column in (-1, 0, 1) if row or column]
"""Offsets of the eight pixels around one."""


def pixels(
    canvas: Canvas,
    *,
    size: Annotated[int, Field(ge=2, le=64, description="side of a large pixel [pixels]")] = 4,
) -> Canvas:
    """Large pixels, each with the one colour in its middle. Steps after this one work on them."""
    return canvas.coarse(size)


@costs(16)
@over_time
def limit(
    canvases: Sequence[Canvas],
    *,
    colours: Annotated[int, Field(ge=2, le=256, description="the most colours")] = 16,
) -> list[Canvas]:
    """Few colours in the whole loop: the pair that is alike and rare becomes one, again and again.

    Of two colours the rarer one becomes the other. Their cost is the count of its pixels times the
    square of their distance.
    """
    drawn = [canvas.words() for canvas in canvases]
    shown = np.concatenate([words[words >= VISIBLE] & COLOUR for words in drawn])
    names, counts = np.unique(shown, return_counts=True)
    if len(names) <= colours:
        return list(canvases)
    table = _merged(names, counts, colours)
    for words in drawn:
        visible = words >= VISIBLE
        found = np.searchsorted(names, words[visible] & COLOUR)
        words[visible] = words[visible] & ~COLOUR | table[found]
    return _painted(canvases, drawn)


@costs(12)
def clean(canvas: Canvas) -> Canvas:
    """No orphans: a pixel unlike all eight around it gets the most frequent colour of those."""
    words = canvas.words()
    words[words < VISIBLE] = 0
    framed = np.pad(words, 1, mode="edge")
    height, width = words.shape
    alike, outside = np.zeros(words.shape, np.bool_), np.pad(words, 1)
    for row, column in AROUND:
        alike |= outside[1 + row : 1 + row + height, 1 + column : 1 + column + width] == words
    y, x = np.nonzero(~alike & (words != 0))
    near = np.stack([framed[1 + y + row, 1 + x + column] for row, column in AROUND], axis=-1)
    # The most frequent one; of several the one with the least number.
    counts = (near[:, :, None] == near[:, None]).sum(axis=-1)
    best = np.argmax((counts << 32) - near.astype(np.int64), axis=-1)
    words[y, x] = near[np.arange(len(near)), best]
    return canvas.painted(as_pixels(words))


@costs(6)
@over_time
def steady(
    canvases: Sequence[Canvas],
    *,
    frames: Annotated[int, Field(ge=2, le=60, description="no return to a colour before")] = 4,
) -> list[Canvas]:
    """No flicker: a pixel keeps its colour if it would come back to it within a few frames.

    So a pixel never goes from one colour to another and back within `frames` frames. Edges then
    do not creep to and fro, and thin things that only flit over a pixel are not shown. It keeps
    what lies in the pixel with the colour. Loops have no seam.
    """
    words = np.stack([canvas.words() for canvas in canvases])
    words[words < VISIBLE] = 0
    sources = _steady_sources(words, frames)
    return [_taken(canvases, source) for source in sources]


def _steady_sources(words: Words, frames: int) -> NDArray[np.intp]:
    """The frame whose colour each pixel shows. words and result: shape [F, H, W]."""
    count, rows = len(words), np.indices(words.shape[1:])
    frames = min(frames, count)
    source = np.zeros(words.shape[1:], np.intp)
    sources = np.zeros(words.shape, np.intp)
    for _ in range(PASSES):
        begin = words[(source, *rows)]
        for time in range(count):
            shown = words[(source, *rows)]
            returns = np.zeros(shown.shape, np.bool_)
            for later in range(1, frames):
                returns |= words[(time + later) % count] == shown
            source = np.where((words[time] == shown) | ~returns, time, source)
            sources[time] = source
        if np.array_equal(words[(source, *rows)], begin):
            break
    return sources


def _taken(canvases: Sequence[Canvas], source: NDArray[np.intp]) -> Canvas:
    """Each pixel, and what lies in it, from a frame of its own."""

    def make_buffers() -> Buffers:
        every = [canvas.buffers for canvas in canvases]
        names = [each.name for each in fields(Buffers)]
        return Buffers(*(_chosen([getattr(one, name) for one in every], source) for name in names))

    pixels = _chosen([canvas.pixels for canvas in canvases], source)
    return replace(canvases[0], pixels=pixels, make_buffers=make_buffers)


def _chosen(arrays: Sequence[NDArray[Item]], source: NDArray[np.intp]) -> NDArray[Item]:
    """Each pixel of the array whose number `source` gives."""
    result = arrays[0].copy()
    for frame in np.unique(source):
        result[source == frame] = arrays[frame][source == frame]
    return result


def _painted(canvases: Sequence[Canvas], drawn: Sequence[Words]) -> list[Canvas]:
    return [canvas.painted(as_pixels(words)) for canvas, words in zip(canvases, drawn, strict=True)]


def _merged(names: Words, counts: NDArray[np.intp], most: int) -> Words:
    """What each colour becomes so that at most `most` remain. names: without alpha."""
    rgb = (names[:, None] >> np.array([0, 8, 16], np.uint32) & np.uint32(255)).astype(np.int64)
    kept = np.argsort(-counts, kind="stable")[:MOST_COLOURS]
    weight, never = counts[kept].astype(np.int64), np.iinfo(np.int64).max
    apart = _distances(rgb[kept], rgb[kept])
    cost = apart * np.minimum(weight[:, None], weight[None, :])
    np.fill_diagonal(cost, never)
    for _ in range(len(kept) - most):
        one, other = divmod(int(np.argmin(cost)), len(kept))
        if weight[one] < weight[other]:
            one, other = other, one
        weight[one] += weight[other]
        weight[other] = 0
        row = apart[one] * np.minimum(weight[one], weight)
        row[(weight == 0) | (np.arange(len(kept)) == one)] = never
        cost[one], cost[:, one] = row, row
        cost[other], cost[:, other] = never, never
    kept = kept[weight > 0]
    parts = np.array_split(rgb, -(-len(rgb) // 4096))  # all distances at once would fill memory
    nearest = np.concatenate([np.argmin(_distances(part, rgb[kept]), axis=1) for part in parts])
    merged: Words = names[kept[nearest]]
    return merged


def _distances(ones: NDArray[np.int64], others: NDArray[np.int64]) -> NDArray[np.int64]:
    """Squares of distances, weighted by how bright a channel is, shape [len(ones), len(others)]."""
    apart = ones[:, None] - others[None]
    squares: NDArray[np.int64] = (apart * apart * np.array([2, 4, 3])).sum(axis=-1)
    return squares
