"""Picture steps for pixel art: large pixels, few colours, and edges that do not creep."""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Annotated, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from drapery.arrays import Words
from drapery.render.buffers import Buffers
from drapery.styles.canvas import VISIBLE, Canvas
from drapery.styles.colours import as_pixels
from drapery.styles.step import costs, over_time

COLOUR = np.uint32(0xFFFFFF)
"""The part of a word that is not alpha."""
MOST_COLOURS = 256
"""How many colours, the most frequent ones, enter the search of `limit`."""
GREY = 9
"""The square of the distance of two greys that are a level apart; see `_distances`."""
PASSES = 4
"""How often `steady` goes around a loop before it stops waiting for the end to meet the start."""

Item = TypeVar("Item", bound=np.generic)

AROUND = [(row, column) for row in (-1, 0, 1) for column in (-1, 0, 1) if row or column]
"""Offsets of the eight pixels around one."""


@costs(4)
def pixels(
    canvas: Canvas,
    *,
    size: Annotated[
        int, Field(ge=0, le=64, description="side of a large pixel [pixels]; 0: by the picture")
    ] = 0,
) -> Canvas:
    """Large pixels, each of one colour: the most typical of nine places in it.

    It shows what most of these places show. Steps after this one work on the large pixels. By the
    picture, 85 of them are as high as it is: a little less than a texel of a banner that fills it.
    Pixels that are large already stay so.
    """
    return canvas if canvas.pixel > 1 and not size else canvas.coarse(size)


@costs(2)
def opacity(
    canvas: Canvas,
    *,
    levels: Annotated[int, Field(ge=1, le=16, description="over invisible")] = 4,
) -> Canvas:
    """Few levels of opacity: a soft shadow becomes as many clear tones, with edges."""
    drawn = canvas.pixels.copy()
    steps = (drawn[..., 3].astype(np.int32) * (2 * levels) + 255) // 510
    drawn[..., 3] = steps * 255 // levels
    return canvas.painted(drawn)


@costs(16)
@over_time
def limit(
    canvases: Sequence[Canvas],
    *,
    colours: Annotated[int, Field(ge=2, le=256, description="the most colours")] = 16,
    apart: Annotated[int, Field(ge=0, le=255, description="least distance of two [levels]")] = 0,
    models: Annotated[bool, Field(description="whether each model has a palette")] = False,
) -> list[Canvas]:
    """Few colours in the whole loop: the pair that is alike and rare becomes one, again and again.

    Of two colours the rarer one becomes the other. Their cost is the count of its pixels times the
    square of their distance. Pairs that are less than `apart` levels of grey from each other become
    one first, also if there are few. With `models` the cloth does not share its palette with its
    pole or with the ground.
    """
    drawn = [canvas.words() for canvas in canvases]
    parts = [np.where(words >= VISIBLE, 0, -1) for words in drawn]
    if models:
        parts = [
            np.where(part < 0, -1, canvas.buffers.model + 1)
            for part, canvas in zip(parts, canvases, strict=True)
        ]
    for number in sorted({int(each) for part in parts for each in np.unique(part)} - {-1}):
        _limit_part(drawn, [part == number for part in parts], colours, apart)
    return _painted(canvases, drawn)


def _limit_part(
    drawn: Sequence[Words], parts: Sequence[NDArray[np.bool_]], colours: int, apart: int
) -> None:
    """Few colours in one part of each picture, in place. parts: shape [H, W] each."""
    shown = [words[part] & COLOUR for words, part in zip(drawn, parts, strict=True)]
    names, counts = np.unique(np.concatenate(shown), return_counts=True)
    if len(names) <= colours and not apart:
        return
    table = _merged(names, counts, colours, apart)
    for words, part, own in zip(drawn, parts, shown, strict=True):
        words[part] = words[part] & ~COLOUR | table[np.searchsorted(names, own)]


@costs(12)
def clean(canvas: Canvas) -> Canvas:
    """No orphans: a pixel unlike all eight around it gets the most frequent colour of those.

    Of the eight only those that show the same model count, if there are any.
    """
    words = canvas.words()
    words[words < VISIBLE] = 0
    framed = np.pad(words, 1, mode="edge")
    height, width = words.shape
    alike, outside = np.zeros(words.shape, np.bool_), np.pad(words, 1)
    for row, column in AROUND:
        alike |= outside[1 + row : 1 + row + height, 1 + column : 1 + column + width] == words
    y, x = np.nonzero(~alike & (words != 0))
    near = np.stack([framed[1 + y + row, 1 + x + column] for row, column in AROUND], axis=-1)
    models = np.pad(canvas.buffers.model, 1, mode="edge")
    model = np.stack([models[1 + y + row, 1 + x + column] for row, column in AROUND], axis=-1)
    own = model == canvas.buffers.model[y, x][:, None]
    # The most frequent one; of several the one with the least number.
    counts = (near[:, :, None] == near[:, None]).sum(axis=-1) + 9 * own
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

    They are at most a quarter of a loop: cloth that swings would stand still in a short one.
    """
    words = np.stack([canvas.words() for canvas in canvases])
    words[words < VISIBLE] = 0
    sources = _steady_sources(words, frames)
    return [_taken(canvases, source) for source in sources]


def _steady_sources(words: Words, frames: int) -> NDArray[np.intp]:
    """The frame whose colour each pixel shows. words and result: shape [F, H, W]."""
    count, rows = len(words), np.indices(words.shape[1:])
    frames = min(frames, max(1, count // 4))
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


def _merged(names: Words, counts: NDArray[np.intp], most: int, apart: int) -> Words:
    """What each colour becomes so that at most `most` remain, all so far apart [levels].

    names: without alpha.
    """
    rgb = (names[:, None] >> np.array([0, 8, 16], np.uint32) & np.uint32(255)).astype(np.int64)
    kept = np.argsort(-counts, kind="stable")[:MOST_COLOURS]
    weight, never = counts[kept].astype(np.int64), np.iinfo(np.int64).max
    far = _distances(rgb[kept], rgb[kept])
    cost = far * np.minimum(weight[:, None], weight[None, :])
    np.fill_diagonal(cost, never)
    near = far < GREY * apart * apart
    while True:
        pairs = np.where(near, cost, never)
        if pairs.min() == never:
            if np.count_nonzero(weight) <= most:
                break
            pairs = cost
        one, other = divmod(int(np.argmin(pairs)), len(kept))
        if weight[one] < weight[other]:
            one, other = other, one
        weight[one] += weight[other]
        weight[other] = 0
        row = far[one] * np.minimum(weight[one], weight)
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
