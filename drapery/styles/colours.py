"""Colours in styles: as text in files, as levels, and as words of pixels."""

import numpy as np

from drapery.arrays import Pixels, Words

COLOUR_PATTERN = r"^#[0-9a-fA-F]{6}$"
"""A colour in a style, such as `#5a3c1e`."""


def rgb_of(colour: str) -> tuple[int, ...]:
    """Red, green and blue of a colour, each 0..255."""
    return tuple(bytes.fromhex(colour.removeprefix("#")))


def word_of(colour: str) -> int:
    """A colour as the lower bytes of a pixel's word."""
    return int.from_bytes(bytes(rgb_of(colour)), "little")


def as_pixels(words: Words) -> Pixels:
    """Words, shape [H, W], as pixels, shape [H, W, 4]; no copy."""
    return words.view(np.uint8).reshape(*words.shape, 4)
