"""AVIF, still and animated, by Pillow and libaom: small files that lose a little.

Colours have full resolution (4:4:4), since a texel's edge is sharp. libavif writes the time of day
into the headers of an animation, which are boxes of ISO/IEC 14496-12; here they are 0.
"""

import struct
from collections.abc import Iterable
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from PIL import Image, features

from drapery.arrays import HasPixels
from drapery.errors import BackendError, OptionError
from drapery.file_formats import frame_delays

if TYPE_CHECKING:
    from drapery.render.encode.palette import Matte

QUALITY = 80
"""The quality where none is given."""
SPEED = 6
"""Of libaom, 0 (small) to 10 (fast)."""
THREADS = 2
"""A fixed number, as for video: an encoder's output may depend on it."""
MAX_PIXELS = 1 << 28
"""The most pixels of all frames together: the encoder gets them as one list, four bytes each."""
HEADERS = b"mvhd", b"tkhd", b"mdhd"
"""Boxes that begin with a version, flags, and the times of creation and modification."""
PARENTS = b"moov", b"trak", b"mdia"
"""The boxes in which those lie."""


def write_avif(
    path: Path,
    frames: Iterable[HasPixels],
    fps: float | None,
    matte: "Matte | None",
    quality: int | None = None,
) -> None:
    """A still, or an animation that loops forever. quality: 1 to 100, by default QUALITY.

    Raises OptionError for more than MAX_PIXELS, BackendError for a Pillow without libavif.
    """
    if not features.check("avif"):
        raise BackendError(
            "this Pillow is built without AVIF; install Pillow's wheel, or write .webp"
        )
    first, *rest = _bounded(path, frames)
    timed = {} if fps is None else {"duration": _delays(fps, 1 + len(rest))}
    data = BytesIO()
    first.save(
        data,
        "AVIF",
        save_all=bool(rest),
        append_images=rest,
        quality=QUALITY if quality is None else quality,
        subsampling="4:4:4",
        speed=SPEED,
        max_threads=THREADS,
        autotiling=False,
        **timed,
    )
    encoded = bytearray(data.getvalue())
    _clear_times(encoded, 0, len(encoded))
    path.write_bytes(encoded)


def _bounded(path: Path, frames: Iterable[HasPixels]) -> list[Image.Image]:
    images: list[Image.Image] = []
    for frame in frames:
        image = Image.fromarray(frame.pixels)
        images.append(image)
        if len(images) * image.width * image.height > MAX_PIXELS:
            raise OptionError(
                f"over {MAX_PIXELS >> 20} million pixels in all frames are too many for AVIF, which"
                " keeps them in memory; use a smaller size, less seconds, or .webp"
            )
    return images


def _delays(fps: float, count: int) -> list[int]:
    """How long each frame is shown [ms]."""
    times = frame_delays(fps, 1000)
    return [next(times) for _ in range(count)]


def _clear_times(file: bytearray, at: int, end: int) -> None:
    """Set the times in the boxes from `at` to `end` to 0."""
    while at + 8 <= end:
        size, kind = struct.unpack_from(">I4s", file, at)
        if kind in PARENTS:
            _clear_times(file, at + 8, at + size)
        elif kind in HEADERS:
            length = 16 if file[at + 8] == 1 else 8  # two times of 8 bytes in version 1, else of 4
            file[at + 12 : at + 12 + length] = bytes(length)
        at += max(size, 8)
