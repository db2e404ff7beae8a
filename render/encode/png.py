"""PNG stills and APNG animations: exact, with straight alpha.

Pillow compresses each frame, several in parallel; this module joins the frames as in
"PNG Specification (Third Edition)", W3C 2025, section 11.3.6.
"""

import struct
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from PIL import Image
from PIL.PngImagePlugin import PngInfo

from drapery.arrays import HasPixels, Pixels
from drapery.render.encode.ahead import encode_ahead
from drapery.render.encode.changes import FramePatch, changed_patch, with_previous
from drapery.render.encode.quick_png import SIGNATURE, png_chunk

if TYPE_CHECKING:
    from drapery.render.encode.palette import Matte

LEVEL = 6
SMALLEST = 9
"""The level of stills in files: 5 to 8 % smaller, for 0.1 s more at 512 x 512 pixels."""
SRGB = b"sRGB", b"\0"
"""The chunk that says that colours are sRGB, to be shown as pictures mostly are (perceptual)."""


def png_bytes(pixels: Pixels, level: int = LEVEL, *, srgb: bool = False) -> bytes:
    """A PNG file; the same pixels and level give the same bytes.

    pixels: sRGB, straight alpha, shape [H, W, 4], uint8.
    level: of zlib, 0 (fast) to 9 (small).
    srgb: whether the file says that it is sRGB.
    """
    info = PngInfo()
    if srgb:
        info.add(*SRGB)
    file = BytesIO()
    file.name = "pixels.png"  # given a format, newer Pillow would import five
    Image.fromarray(pixels).save(file, compress_level=level, pnginfo=info)
    return file.getvalue()


def write_png(
    path: Path, frames: Iterable[HasPixels], fps: float | None, matte: "Matte | None"
) -> None:
    """A still, or an animation that loops forever."""
    with path.open("wb") as file:
        if fps is None:
            file.writelines(png_bytes(frame.pixels, SMALLEST, srgb=True) for frame in frames)
        else:
            _write_loop(file, frames, fps)


def apng_bytes(
    frames: Iterable[HasPixels], fps: float = 0, *, delays: Sequence[float] = (), plays: int = 0
) -> bytes:
    """An APNG file, lossless; the same frames give the same bytes.

    frames: at least one, of one size.
    fps: [frames/s], above 0.
    delays: how long each frame is shown [s], in place of fps.
    plays: how often the animation is played; 0 for ever.
    """
    file = BytesIO()
    _write_loop(file, frames, fps, delays=delays, plays=plays)
    return file.getvalue()


def _write_loop(
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
            file.write(SIGNATURE + png_chunk(b"IHDR", chunks[b"IHDR"]))
            file.write(png_chunk(*SRGB))
            start = file.tell()
            file.write(png_chunk(b"acTL", bytes(8)))
        delay = Fraction(delays[count]) if delays else 1 / Fraction(fps)
        file.write(png_chunk(b"fcTL", _frame_control(sequence, patch, delay)))
        if count == 0:
            file.write(png_chunk(b"IDAT", chunks[b"IDAT"]))
        else:
            file.write(png_chunk(b"fdAT", struct.pack(">I", sequence + 1) + chunks[b"IDAT"]))
        sequence += 1 if count == 0 else 2
        count += 1
    file.write(png_chunk(b"IEND", b""))
    file.seek(start)
    file.write(png_chunk(b"acTL", struct.pack(">II", count, plays)))


def _encode_patch(pair: tuple[Pixels | None, Pixels]) -> tuple[FramePatch, bytes]:
    patch = changed_patch(*pair)
    return patch, png_bytes(patch.pixels)


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
