"""PNG files of every mode as texels: sRGB with straight alpha, checked before decoding."""

import struct
from io import BytesIO

from drapery.arrays import Texels
from drapery.banner.packs.png_chunks import texel_chunks
from drapery.errors import PackError
from drapery.picture_pixels import pixels_of

MAX_SIDE = 8192
MAX_PIXELS = 4096 * 4096

_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def png_size(data: bytes, name: str) -> tuple[int, int]:
    """Width and height from the header [px]; nothing is decoded.

    data: the bytes of a PNG file.
    name: the file's name in errors.

    Raises PackError for other bytes.
    """
    if data[:8] != _SIGNATURE or data[12:16] != b"IHDR" or len(data) < 33:
        raise PackError(f"{name} is not a PNG file: save it as one")
    width, height = struct.unpack_from(">II", data, 16)
    if not (0 < width <= MAX_SIDE and 0 < height <= MAX_SIDE and width * height <= MAX_PIXELS):
        raise PackError(
            f"{name} is {width} x {height} px; at most {MAX_SIDE} px a side and"
            f" {MAX_PIXELS >> 20} million in all are read: shrink it"
        )
    return width, height


def is_plain_rgba(data: bytes) -> bool:
    """Whether a PNG file, whose header `png_size` has checked, is RGBA with 8 bits a channel."""
    return data[24:26] == bytes([8, 6])


def read_png(data: bytes, name: str) -> Texels:
    """The texels of a PNG file of any mode, shape [H, W, 4].

    Only the upper eight of 16 bits a channel are used, as in the game. Chunks that say nothing
    about the texels are not read, whatever is wrong with them.

    data: the bytes of the file.
    name: the file's name in errors.

    Raises PackError for a file that is broken, too large or no PNG.
    """
    png_size(data, name)
    # Only this plug-in: PIL.Image.open would load those of all common formats first.
    from PIL.PngImagePlugin import PngImageFile

    file = BytesIO(texel_chunks(data, name))
    try:
        with PngImageFile(file) as image:
            image.load()
            texels = pixels_of(image, depth=data[24])
    except (OSError, SyntaxError, ValueError, EOFError, IndexError, struct.error):
        raise PackError(f"{name} is a broken PNG file: save it again") from None
    texels.setflags(write=False)
    return texels
