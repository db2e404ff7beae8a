"""Texels as the bytes of a PNG file, the same on every machine."""

import io
import zlib

import numpy as np
from PIL import Image

from assets.drawing.canvas import Texels

# Run-length matching leaves the compressor no choices: zlib and zlib-ng, which differ at the usual
# levels, then write the same bytes.
STRATEGY = zlib.Z_RLE


def encode(texels: Texels) -> bytes:
    """The smaller PNG file of RGBA texels: with a palette, if they have few colours, or without."""
    files = [_written(Image.fromarray(texels, "RGBA"))]
    colours, number = np.unique(texels.reshape(-1, 4), axis=0, return_inverse=True)
    if len(colours) <= 256:
        # The opaque colours come last, since only the others need an entry for their alpha.
        order = np.argsort(colours[:, 3], kind="stable")
        place = np.argsort(order, kind="stable").astype(np.uint8)
        image = Image.fromarray(place[number].reshape(texels.shape[:2]), "P")
        image.putpalette(colours[order, :3].tobytes())
        alpha = colours[order, 3]
        files.append(_written(image, transparency=alpha[alpha < 255].tobytes() or None))
    return min(files, key=len)


def _written(image: Image.Image, **options: object) -> bytes:
    file = io.BytesIO()
    image.save(file, "PNG", compress_level=9, compress_type=STRATEGY, **options)
    return file.getvalue()
