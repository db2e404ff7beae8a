"""PNG stills and APNG animations: exact, with straight alpha.

Pillow compresses each frame, several in parallel; this module joins the frames as in
"PNG Specification (Third Edition)", W3C 2025, section 11.3.6.
"""

import struct
import zlib
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from io import BytesIO
from typing import BinaryIO

import numpy as np
from PIL import Image

from drapery.render.encode.ahead import encode_ahead
from drapery.render.encode.changes import FramePatch, changed_patch, with_previous
from drapery.render.pixels import HasPixels, Pixels

STILL_LEVEL = 6
FRAME_LEVEL = 3  # two thirds of the time of level 6, for a file that is half as big again

_UP = 2
"""The filter that stores differences from the row above."""
_BAND = 128
"""How many rows are compressed at a time."""

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def png_bytes(pixels: Pixels, level: int = STILL_LEVEL) -> bytes:
    """A PNG file; the same pixels and level give the same bytes."""
    file = BytesIO()
    file.name = "pixels.png"  # given a format, newer Pillow would import five
    Image.fromarray(pixels).save(file, compress_level=level)
    return file.getvalue()


def quick_png_bytes(pixels: Pixels) -> bytes:
    """A PNG file of a large picture, in a fifth of the time of `png_bytes`, and larger.

    Each row is stored as its difference from the row above, without a search for a better filter,
    and bands of rows are compressed in parallel. The same pixels give the same bytes.
    """
    height, width = pixels.shape[:2]
    check, parts = zlib.adler32(b""), []
    bands = (slice(top, min(top + _BAND, height)) for top in range(0, height, _BAND))
    for rows, packed in encode_ahead(bands, lambda band: _packed_band(pixels, band)):
        check = zlib.adler32(rows, check)
        parts.append(packed)
    # An empty last block ends the stream, of which zlib writes neither head nor checksum here.
    data = b"\x78\x01" + b"".join(parts) + b"\x03\0" + struct.pack(">I", check)
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", data), (b"IEND", b""))
    return SIGNATURE + b"".join(_chunk(kind, body) for kind, body in chunks)


def _packed_band(pixels: Pixels, band: slice) -> tuple[bytes, bytes]:
    """Rows of a picture as differences from those above, and the same compressed."""
    inner = np.ascontiguousarray(pixels[max(0, band.start - 1) : band.stop])
    rows = inner.reshape(len(inner), -1)
    filtered = np.full((band.stop - band.start, 1 + rows.shape[1]), _UP, np.uint8)
    if band.start == 0:
        filtered[0, 1:] = rows[0]
        np.subtract(rows[1:], rows[:-1], out=filtered[1:, 1:])
    else:
        np.subtract(rows[1:], rows[:-1], out=filtered[:, 1:])
    packer = zlib.compressobj(1, zlib.DEFLATED, -zlib.MAX_WBITS)
    plain = filtered.tobytes()
    return plain, packer.compress(plain) + packer.flush(zlib.Z_FULL_FLUSH)


def apng_bytes(
    frames: Iterable[HasPixels], fps: float = 0, *, delays: Sequence[float] = (), plays: int = 0
) -> bytes:
    """An APNG file, lossless; the same frames give the same bytes.

    frames: at least one, of one size. fps: frames/s, above 0. delays: how long each frame is shown
    [s], in place of fps. plays: how often the animation is played; 0 for ever.
    """
    file = BytesIO()
    write_apng(file, frames, fps, delays=delays, plays=plays)
    return file.getvalue()


def write_apng(
    file: BinaryIO,
    frames: Iterable[HasPixels],
    fps: float,
    *,
    delays: Sequence[float] = (),
    plays: int = 0,
) -> None:
    """An animation; see `apng_bytes`.

    Each frame replaces its rectangle (blend "source") and is not cleared (dispose "none"), so
    half-transparent pixels are exact and old pixels do not remain.
    """
    start, sequence, count = 0, 0, 0
    for patch, png in encode_ahead(with_previous(frame.pixels for frame in frames), _encode_patch):
        chunks = dict(_joined_chunks(png))
        if count == 0:
            file.write(SIGNATURE + _chunk(b"IHDR", chunks[b"IHDR"]))
            start = file.tell()
            file.write(_chunk(b"acTL", bytes(8)))
        delay = Fraction(delays[count]) if delays else 1 / Fraction(fps)
        file.write(_chunk(b"fcTL", _frame_control(sequence, patch, delay)))
        if count == 0:
            file.write(_chunk(b"IDAT", chunks[b"IDAT"]))
        else:
            file.write(_chunk(b"fdAT", struct.pack(">I", sequence + 1) + chunks[b"IDAT"]))
        sequence += 1 if count == 0 else 2
        count += 1
    file.write(_chunk(b"IEND", b""))
    file.seek(start)
    file.write(_chunk(b"acTL", struct.pack(">II", count, plays)))


def _encode_patch(pair: tuple[Pixels | None, Pixels]) -> tuple[FramePatch, bytes]:
    patch = changed_patch(*pair)
    return patch, png_bytes(patch.pixels, FRAME_LEVEL)


def _frame_control(sequence: int, patch: FramePatch, seconds: Fraction) -> bytes:
    height, width = patch.pixels.shape[:2]
    delay = seconds.limit_denominator(10_000)
    return struct.pack(
        ">5I2H2B",
        sequence,
        width,
        height,
        patch.left,
        patch.top,
        delay.numerator,
        delay.denominator,
        0,
        0,
    )


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _joined_chunks(png: bytes) -> Iterator[tuple[bytes, bytes]]:
    """The header chunk and the image data, whose chunks are joined into one."""
    data, place = b"", len(SIGNATURE)
    while place < len(png):
        (length,) = struct.unpack_from(">I", png, place)
        kind, body = png[place + 4 : place + 8], png[place + 8 : place + 8 + length]
        if kind == b"IHDR":
            yield kind, body
        elif kind == b"IDAT":
            data += body
        place += length + 12
    yield b"IDAT", data
