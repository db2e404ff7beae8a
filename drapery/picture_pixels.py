"""The pixels of a picture that Pillow has opened: sRGB with straight alpha, 8 or 16 bits a channel.

One reader for the textures of packs and skins, and for pictures that are matched or compared.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    from PIL.Image import Image


_SIXTEEN = ("I;16", "I;16B", "I;16L", "I;16N")
"""Pillow's modes of grey with 16 bits."""
_LOW_BYTES = {"RGB;16B": "RGB;16L", "RGBA;16B": "RGBA;16L"}
"""Pillow keeps one byte of each channel of 16 bits. Told that the bytes of a channel are in the
other order, it keeps the low ones."""


def pixels_of(image: "Image", depth: int = 8) -> NDArray[np.uint8]:
    """The pixels of a picture, 8 bits a channel; of 16 bits the upper eight, as in the game.

    depth: bits of a channel in the file. Raises OptionError for a mode without a fixed range.
    """
    if image.mode.startswith("I;16") or (image.mode == "I" and depth == 16):
        return (_grey16(image) >> 8).astype(np.uint8)
    clear = image.info.get("transparency")
    # Pillow widens grey texels of 2 and 4 bits, but not their transparent value.
    if image.mode == "L" and isinstance(clear, int) and depth < 8:
        image.info["transparency"] = clear * (255 // ((1 << depth) - 1))
    if image.mode == "RGB" and isinstance(clear, tuple) and depth == 16:
        image.info["transparency"] = tuple(value >> 8 for value in clear)
    if image.mode in ("I", "F"):
        raise OptionError(
            f"a picture of mode {image.mode} has no fixed range of values; scale it to 0 to 255 and"
            " convert it to mode L, or to 0 to 65535 and mode I;16"
        )
    if image.mode == "RGBA":
        return np.asarray(image, np.uint8)
    try:
        return np.asarray(image.convert("RGBA"), np.uint8)
    except ValueError:
        raise OptionError(
            f"a picture of mode {image.mode} cannot be converted to colours; convert it to RGB"
        ) from None


def sixteen_bit_pixels(
    image: Any, reopen: "Callable[[], AbstractContextManager[Any]]"
) -> NDArray[np.uint16] | None:
    """The pixels of a picture of 16 bits a channel; None for other pictures.

    image: Pillow's, not loaded yet. reopen: opens the same file again, for the low bytes of a PNG.
    """
    if image.mode in _SIXTEEN:
        return _grey16(image)
    if image.format != "PNG" or not getattr(image, "tile", None):
        return None
    tile = image.tile[0]
    mode = tile.args
    if mode == "LA;16B":
        # As many bytes as a pixel of RGBA: the high and the low byte of grey, and of alpha.
        image.tile = [tile._replace(args="RGBA")]
        halves = np.asarray(image).astype(np.uint16)
        grey, alpha = (halves[..., at] * 256 + halves[..., at + 1] for at in (0, 2))
        return np.stack([grey, grey, grey, alpha], axis=-1)
    if mode not in _LOW_BYTES:
        return None
    with reopen() as again:
        again.tile = [again.tile[0]._replace(args=_LOW_BYTES[mode])]
        low = np.asarray(again)
    clear = image.info.get("transparency")
    joined = np.asarray(image).astype(np.uint16) * 256 + low
    return joined if joined.shape[2] == 4 else _with_alpha(joined, clear)


def _grey16(image: "Image") -> NDArray[np.uint16]:
    grey = np.asarray(image).astype(np.uint16)
    return _with_alpha(np.repeat(grey[..., None], 3, axis=-1), image.info.get("transparency"))


def _with_alpha(
    colours: NDArray[np.uint16], clear: int | tuple[int, ...] | None
) -> NDArray[np.uint16]:
    """Colours [H, W, 3] with an alpha that is 0 where they are the transparent one."""
    alpha = np.full(colours.shape[:2], 65535, np.uint16)
    if isinstance(clear, (int, tuple)):
        alpha[(colours == np.asarray(clear)).all(axis=-1)] = 0
    return np.dstack([colours, alpha])
