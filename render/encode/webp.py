"""WebP, still and animated; lossless unless a quality is given.

Pillow compresses each frame, several in parallel; this module joins the frames as in
"WebP Container Specification", Google, section "Extended File Format: Animation".
"""

import struct
from collections.abc import Iterable
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from PIL import Image

from drapery.arrays import HasPixels, Pixels
from drapery.file_formats import frame_delays
from drapery.render.encode.ahead import encode_ahead
from drapery.render.encode.changes import FramePatch, changed_patch, with_previous

if TYPE_CHECKING:
    from drapery.render.encode.palette import Matte

ANIMATED_WITH_ALPHA = 0x12
DO_NOT_BLEND = 0x02


def webp_bytes(pixels: Pixels, method: int = 4, quality: int | None = None) -> bytes:
    """A WebP file, lossless and exact also where the picture is transparent without a quality.

    pixels: sRGB, straight alpha, shape [H, W, 4], uint8.
    method: 0 (fast) to 6 (small).
    quality: of colours, 1 to 100; their transparency is exact. None loses nothing.
    """
    file = BytesIO()
    if quality is not None:
        Image.fromarray(pixels).save(file, "WEBP", quality=quality, method=method)
        return file.getvalue()
    Image.fromarray(pixels).save(file, "WEBP", lossless=True, exact=True, method=method, quality=75)
    return file.getvalue()


def write_webp(
    path: Path,
    frames: Iterable[HasPixels],
    fps: float | None,
    matte: "Matte | None",
    quality: int | None = None,
) -> None:
    """A still, or an animation that loops forever. quality: see `webp_bytes`."""
    with path.open("wb") as file:
        if fps is None:
            file.writelines(webp_bytes(frame.pixels, quality=quality) for frame in frames)
        else:
            _write_loop(file, frames, fps, quality)


def _write_loop(
    file: BinaryIO, frames: Iterable[HasPixels], fps: float, quality: int | None
) -> None:
    """Each frame replaces its rectangle, without blending."""
    pairs, times = with_previous(frame.pixels for frame in frames), frame_delays(fps, 1000)
    encode = partial(_encode_patch, quality)
    for count, (patch, webp) in enumerate(encode_ahead(pairs, encode)):
        if count == 0:
            height, width = patch.pixels.shape[:2]
            canvas = bytes([ANIMATED_WITH_ALPHA, 0, 0, 0]) + _size(width) + _size(height)
            file.write(b"RIFF\0\0\0\0WEBP")
            file.write(_chunk(b"VP8X", canvas) + _chunk(b"ANIM", bytes(6)))
        file.write(_chunk(b"ANMF", _frame_header(patch, next(times)) + _image_chunks(webp)))
    length = file.tell()
    file.seek(4)
    file.write(struct.pack("<I", length - 8))


def _encode_patch(
    quality: int | None, pair: tuple[Pixels | None, Pixels]
) -> tuple[FramePatch, bytes]:
    patch = changed_patch(*pair, grid=2)  # the format counts offsets in steps of two pixels
    return patch, webp_bytes(patch.pixels, 2 if quality is None else 4, quality)


def _image_chunks(webp: bytes) -> bytes:
    """A still's chunks without its header; a lossy one with transparency has a chunk for that."""
    return webp[12 + 8 + 10 :] if webp[12:16] == b"VP8X" else webp[12:]


def _frame_header(patch: FramePatch, milliseconds: int) -> bytes:
    height, width = patch.pixels.shape[:2]
    corner = _uint24(patch.left // 2) + _uint24(patch.top // 2)
    return corner + _size(width) + _size(height) + _uint24(milliseconds) + bytes([DO_NOT_BLEND])


def _size(pixels: int) -> bytes:
    return _uint24(pixels - 1)


def _uint24(number: int) -> bytes:
    return number.to_bytes(3, "little")


def _chunk(kind: bytes, data: bytes) -> bytes:
    return kind + struct.pack("<I", len(data)) + data + bytes(len(data) % 2)
