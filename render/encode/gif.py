"""GIF: 255 colours, one bit of alpha, whole centiseconds (GIF89a specification, 1990).

Pillow compresses the frames; this module makes one palette and joins them. The palette depends on
all frames, so a first pass stores each pixel's colour during rendering, and a second pass writes.
"""

import struct
import zlib
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import GifImagePlugin, Image

from drapery.arrays import HasPixels
from drapery.file_formats import frame_delays
from drapery.render.encode.ahead import encode_ahead
from drapery.render.encode.changes import (
    FramePatch,
    bounding_box,
    changed_patch,
    cut,
    with_previous,
)
from drapery.render.encode.palette import MAX_COLOURS, Colours, ColourTable, Matte, Places, reduced

KEEP, CLEAR = 1, 2  # GIF's disposal methods: how a viewer treats a frame before the next one
LOOP_FOREVER = b"!\xff\x0bNETSCAPE2.0\x03\x01\0\0\0"


class CompressedFrame(NamedTuple):
    """The colour indices of one frame, of the type `kind`, compressed to save memory."""

    size: tuple[int, int]
    colours: int
    kind: str
    data: bytes


class IndexedImage(NamedTuple):
    """A palette, colour 0 being the transparent one, and indices into it [h, w]."""

    palette: Colours
    indices: NDArray[np.uint8]


def write_gif(
    path: Path, frames: Iterable[HasPixels], fps: float | None, matte: Matte | None
) -> None:
    """An animation that loops forever, or a still where there is one frame.

    fps: at most 50 frames/s; faster ones are shown at 10 frames/s. Up to 255 colours in all, or in
    each frame, are exact.
    """
    with path.open("wb") as file:
        for data in _blocks(frames, fps or 1, matte):
            file.write(data)


def _blocks(frames: Iterable[HasPixels], fps: float, matte: Matte | None) -> Iterator[bytes]:
    table = ColourTable()
    compressed = list(encode_ahead(frames, partial(_compress, table, matte), workers=1))
    paint, shared = _painter(table, max(frame.colours for frame in compressed))
    clear = bool(table.counts[0])
    times = frame_delays(fps, 100) if len(compressed) > 1 else iter([0])
    pages = zip(_patches(compressed, clear), times, strict=False)
    yield _header(compressed[0].size, shared) + (LOOP_FOREVER if len(compressed) > 1 else b"")
    yield from encode_ahead(pages, lambda page: _frame_data(*page, paint, shared is None, clear))
    yield b";"


def _compress(table: ColourTable, matte: Matte | None, frame: HasPixels) -> CompressedFrame:
    places = table.places(frame.pixels, matte)
    colours = np.count_nonzero(np.bincount(places.ravel())[1:])
    # Half as many bytes take half the time, and few animations have over 65,536 colours.
    kind = "<u2" if table.counts.size <= 1 << 16 else "<i4"
    data = zlib.compress(places.astype(kind).tobytes(), 1)
    return CompressedFrame(frame.pixels.shape[:2], int(colours), kind, data)


def _painter(
    table: ColourTable, most_in_frame: int
) -> tuple[Callable[[Places], IndexedImage], Colours | None]:
    """The function from places to indices, and the palette that all frames share, if any."""
    colours = table.colours()
    if len(colours) > 1 + MAX_COLOURS and most_in_frame <= MAX_COLOURS:
        return partial(_own_palette, colours), None
    palette, index_of = reduced(colours, table.counts)
    return lambda places: IndexedImage(palette, index_of[places]), palette


def _own_palette(colours: Colours, places: Places) -> IndexedImage:
    used = np.union1d(0, places)
    return IndexedImage(colours[used], np.searchsorted(used, places).astype(np.uint8))


def _patches(compressed: Iterable[CompressedFrame], clear: bool) -> Iterator[FramePatch]:
    """The patch of each frame: its visible part if frames are cleared, else the changes."""
    frames = (
        np.frombuffer(zlib.decompress(frame.data), frame.kind).reshape(frame.size).astype(np.int32)
        for frame in compressed
    )
    if clear:
        return (cut(places, bounding_box(places != 0)) for places in frames)
    return (changed_patch(*pair) for pair in with_previous(frames))


def _header(size: tuple[int, int], palette: Colours | None) -> bytes:
    height, width = size
    if palette is None:
        return b"GIF89a" + struct.pack("<2H3B", width, height, 0, 0, 0)
    bits = max(1, (len(palette) - 1).bit_length())
    entries = palette.tobytes().ljust(3 << bits, b"\0")
    return b"GIF89a" + struct.pack("<2H3B", width, height, 0xF0 | bits - 1, 0, 0) + entries


def _frame_data(
    patch: FramePatch,
    delay: int,
    paint: Callable[[Places], IndexedImage],
    own_palette: bool,
    clear: bool,
) -> bytes:
    indexed = paint(patch.pixels)
    image = Image.fromarray(indexed.indices)
    image.putpalette(indexed.palette.tobytes())
    options = {"transparency": 0} if clear else {}
    blocks = GifImagePlugin.getdata(
        image,
        (patch.left, patch.top),
        duration=10 * delay,
        disposal=CLEAR if clear else KEEP,
        include_color_table=own_palette,
        **options,
    )
    return b"".join(blocks)
