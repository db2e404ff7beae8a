"""Texels as the bytes of a PNG file, the same on every machine."""

import io
import zlib

from PIL import Image

from assets.drawing.canvas import Texels

# Run-length matching leaves the compressor no choices: zlib and zlib-ng, which differ at the usual
# levels, then write the same bytes.
STRATEGY = zlib.Z_RLE


def encode(texels: Texels) -> bytes:
    """The PNG file of RGBA texels."""
    file = io.BytesIO()
    image = Image.fromarray(texels, "RGBA")
    image.save(file, "PNG", compress_level=9, compress_type=STRATEGY)
    return file.getvalue()
