"""Pictures from outside: the one place where Pillow opens them, checked before it decodes them."""

import logging
import re
import struct
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from typing import TYPE_CHECKING

from drapery.errors import DraperyError, OptionError
from drapery.file_formats import READERS

if TYPE_CHECKING:
    from PIL.Image import Image

MAX_PIXELS = 4096 * 4096
"""The most pixels of a picture; those of its first frame."""
MAX_SIDE = 16_384
"""The widest and highest picture [px]."""
MAX_SCANS = 100
"""The most scans of a JPEG file of up to MAX_PIXELS, less of a larger one; usual are up to 10.

Each takes time for all pixels."""

# Pillow logs some faults of files, which are refusals here; where nobody handles them, Python would
# write them to standard error.
logging.getLogger("PIL").addHandler(logging.NullHandler())

_MARKER = re.compile(rb"\xff+([^\x00\xff])")
_ALONE = {0x01, *range(0xD0, 0xD9)}
"""JPEG markers without a length: TEM, RST0 to RST7 and SOI."""
_END, _SCAN = 0xD9, 0xDA
_GIF_EXTENSION, _GIF_FRAME, _GIF_END = b"!,;"


@contextmanager
def opened_picture(
    data: bytes,
    name: str,
    formats: Sequence[str] = READERS,
    *,
    max_pixels: int = MAX_PIXELS,
    max_side: int = MAX_SIDE,
) -> Iterator["Image"]:
    """A picture of which only the header is read; faults while it is decoded are refusals too.

    data: the bytes of a file. name: its name in errors. formats: those tried, by Pillow's names.
    Raises OptionError for what is no such picture, is broken, exceeds max_pixels, max_side or
    MAX_SCANS, or is a GIF with a frame outside of its picture.
    """
    from PIL import Image, UnidentifiedImageError

    try:
        with warnings.catch_warnings(action="ignore"):
            _check_size(_webp_size(data), name, max_pixels, max_side)
            image = _opened(data, formats)
            with image:
                _check_size(image.size, name, max_pixels, max_side)
                if image.format in ("JPEG", "MPO"):
                    _check_scans(data, image.width * image.height, name)
                if image.format == "GIF":
                    _check_frames(data, image.size, name)
                yield image
    except DraperyError:
        raise
    except (Image.DecompressionBombError, MemoryError):
        raise OptionError(
            f"{name} has over {max_pixels >> 20} million pixels, which are not read: shrink it"
        ) from None
    except UnidentifiedImageError:
        *first, last = (each.replace("WEBP", "WebP") for each in formats)
        known = " or ".join(filter(None, (", ".join(first), last)))
        raise OptionError(f"{name} is not a picture that can be read; save it as {known}") from None
    except Exception:  # Pillow's readers raise errors of many types
        raise OptionError(f"{name} is a broken picture; save it again") from None


def _opened(data: bytes, formats: Sequence[str]) -> "Image":
    """What `Image.open` returns; for a PNG without the import of the readers of other formats."""
    from PIL import Image, UnidentifiedImageError

    width, height = struct.unpack_from(">II", data, 16) if len(data) >= 24 else (0, 0)
    usual = width * height <= (Image.MAX_IMAGE_PIXELS or 0)
    if not (usual and "PNG" in formats and data[:8] == b"\x89PNG\r\n\x1a\n"):
        return Image.open(BytesIO(data), formats=list(formats))
    from PIL.PngImagePlugin import PngImageFile

    try:
        return PngImageFile(BytesIO(data))
    except (SyntaxError, IndexError, TypeError, struct.error):
        raise UnidentifiedImageError from None


def _check_size(size: tuple[int, int], name: str, max_pixels: int, max_side: int) -> None:
    width, height = size
    if width * height > max_pixels:
        raise OptionError(
            f"{name} is {width} x {height} px; at most {max_pixels >> 20} million pixels are read:"
            " shrink it"
        )
    if max(width, height) > max_side:
        raise OptionError(f"{name} is larger than {max_side} pixels; use a smaller")


def _check_scans(data: bytes, pixels: int, name: str) -> None:
    """Count the scans of a JPEG file as its decoder finds them: from marker to marker."""
    at, scans, most = 2, 0, MAX_SCANS * min(1, MAX_PIXELS / pixels)
    while found := _MARKER.search(data, at):
        marker, at = found[1][0], found.end()
        if marker == _END:
            return
        if marker not in _ALONE:
            scans += marker == _SCAN
            at += int.from_bytes(data[at : at + 2], "big")
        if scans > most:
            raise OptionError(
                f"{name} is a JPEG of over {most:.0f} scans; save it again, not progressive"
            )


def _check_frames(data: bytes, size: tuple[int, int], name: str) -> None:
    """Refuse a GIF with a frame outside of its picture, for which Pillow makes a larger one.

    size: of the picture and its first frame. A frame has to lie within the picture (GIF89a, 20).
    """
    at = 13 + _table_size(data[10:11])
    while at < len(data) and data[at] != _GIF_END:
        kind, at = data[at], at + 1
        if kind == _GIF_FRAME:
            left, top, width, height = struct.unpack_from("<4H", data, at)
            if left + width > size[0] or top + height > size[1]:
                raise OptionError(
                    f"{name} is a GIF with a frame outside of its {size[0]} x {size[1]} px;"
                    " save it again"
                )
            at = _after_blocks(data, at + 10 + _table_size(data[at + 8 : at + 9]))
        elif kind == _GIF_EXTENSION:
            at = _after_blocks(data, at + 1)


def _table_size(flags: bytes) -> int:
    """The bytes of the table of colours that a byte of flags announces in a GIF."""
    return 6 << (flags[0] & 7) if flags and flags[0] & 0x80 else 0


def _after_blocks(data: bytes, at: int) -> int:
    """The place after a chain of blocks, each of which begins with its length."""
    while at < len(data) and data[at]:
        at += 1 + data[at]
    return at + 1


def _webp_size(data: bytes) -> tuple[int, int]:
    """Width and height of a WebP file, whose decoder needs memory for both when it is opened.

    (0, 0) for other files. The layouts of the three kinds are those of RFC 9649.
    """
    if data[:4] != b"RIFF" or data[8:12] != b"WEBP" or len(data) < 30:
        return 0, 0
    kind, start = data[12:16], data[20:30]
    if kind == b"VP8X":
        return int.from_bytes(start[4:7], "little") + 1, int.from_bytes(start[7:10], "little") + 1
    if kind == b"VP8L":
        bits = int.from_bytes(start[1:5], "little")
        return (bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1
    width, height = struct.unpack_from("<HH", start, 6)
    return width & 0x3FFF, height & 0x3FFF
