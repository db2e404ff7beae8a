"""TIFF stills for print: exact, with straight alpha (TIFF 6.0, Adobe 1992; Deflate, Adobe 2002)."""

from collections.abc import Iterable
from io import BytesIO
from pathlib import Path

from PIL import Image

from drapery.arrays import HasPixels
from drapery.render.encode.palette import Matte

RESOLUTION = 300
"""What readers take the pixels of an inch for."""


def write_tiff(
    path: Path, frames: Iterable[HasPixels], fps: float | None, matte: Matte | None
) -> None:
    """A still, packed with Deflate."""
    (frame,) = frames
    data = BytesIO()  # libtiff has words of its own for a full disk
    image = Image.fromarray(frame.pixels)
    image.save(data, "TIFF", compression="tiff_adobe_deflate", dpi=(RESOLUTION, RESOLUTION))
    path.write_bytes(data.getvalue())
