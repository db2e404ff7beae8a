"""Files of pictures that are compared: which are read, and their limits."""

from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING

from drapery.file_formats import READERS
from drapery.picture_file import opened_picture
from drapery.user_files import read_user_file

if TYPE_CHECKING:
    from PIL.Image import Image

MAX_SIDE = 16384
MAX_PIXELS = 1 << 28
"""The most pixels in all frames of a picture."""
MAX_FILE = 512 << 20
"""The longest file [bytes]."""


def picture_bytes(path: Path) -> bytes:
    """The bytes of a file. Raises OptionError for one that cannot be read or is too large."""
    return read_user_file(path, MAX_FILE, shorter="compare smaller pictures")


def opened(
    data: bytes, name: str, formats: Sequence[str] = READERS
) -> "AbstractContextManager[Image]":
    """A picture of which only the header is read. name: of the file in errors.

    Raises OptionError; see `opened_picture`.
    """
    return opened_picture(data, name, formats, max_pixels=MAX_PIXELS, max_side=MAX_SIDE)
