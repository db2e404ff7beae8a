"""The panel of a difference, painted by Pillow: shared by whole pictures and strips of files."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from PIL.Image import Image

GAIN = 8
"""What errors are multiplied by."""
LEAST, MOST = 96, 255
"""The least and the largest strength of an error that is shown."""
_WITHIN = (240, 178, 40)
"""The colour of pixels that differ within the tolerance: amber."""
_FAINT = (1 / 17, 1 / 17, 1 / 17, 210 + 0.5 / 17 - 0.5)
"""Red, green and blue as a faint grey: 210 and a seventeenth of their sum. Pillow adds a half and
rounds down; half a seventeenth keeps whole results from the error of the sum."""
_RED = [255 - strength // 8 for strength in range(256)]
_OTHERS = [224 - strength * 224 // 255 for strength in range(256)]


def difference_image(shown: "Image", strength: "Image", within: "Image | None" = None) -> "Image":
    """A picture in faint grey with errors in red, mode RGB.

    shown: the picture, mode RGB. strength: how much each pixel differs, LEAST to MOST, or 0, mode
    L. within: 255 for the pixels that differ within the tolerance, and else 0, mode L.
    """
    from PIL import Image

    panel = shown.convert("L", _FAINT).convert("RGB")
    if within is not None:
        panel.paste(_WITHIN, mask=within)
    area = strength.getbbox()
    if area is not None:
        part = strength.crop(area)
        others = part.point(_OTHERS)
        red = Image.merge("RGB", (part.point(_RED), others, others))
        panel.paste(red, area[:2], part.point([0] + [255] * 255))
    return panel


def shown_scale(width: int, height: int) -> int:
    """How many times small pictures are enlarged beside each other."""
    return max(1, 256 // max(width, height))
