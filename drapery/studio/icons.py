"""Icons of items: the texture of the user's packs, or else one of our own, from `icons.txt`."""

from base64 import b64encode
from contextlib import suppress
from functools import cache
from importlib.resources import files

import numpy as np

from drapery.arrays import Texels
from drapery.banner import DYES
from drapery.errors import PackError
from drapery.packs import Packs
from drapery.render import png_bytes

_COLOURS = {
    "k": (30, 28, 32),
    "w": (240, 238, 232),
    "s": (150, 150, 152),
    "b": (143, 103, 58),
    "d": (88, 60, 34),
    "g": (74, 128, 48),
    "r": (158, 86, 70),
    "y": (236, 190, 52),
}
_SHADES = {"#": 1.0, "+": 0.78, "-": 1.18}
_SHAPES = {
    "creeper_head": ("head", (94, 160, 74)),
    "wither_skeleton_skull": ("head", (96, 96, 98)),
    "oxeye_daisy": ("flower", (0, 0, 0)),
    "enchanted_golden_apple": ("apple", (0, 0, 0)),
}
"""The shapes of items that do not have the name of their own, and their colours."""


MAX_SIDE = 64
"""The widest icon of a pack that is sent to the page [texels]; of a wider one some are left out."""


def icon_address(item: str, packs: Packs) -> str:
    """The icon of an item as a `data:` address. item: its id, such as `red_wool`."""
    for folder in ("item", "block"):
        name = f"minecraft:{folder}/{item}"
        with suppress(PackError):  # a damaged icon must not cost the user the pack
            if packs.has_texture(name):
                texels = packs.texture(name)
                side, step = texels.shape[1], -(-texels.shape[1] // MAX_SIDE)
                return _address(texels[:side:step, ::step].copy())  # an animation's first frame
    return _own_address(item)


@cache
def _own_address(item: str) -> str:
    return _address(own_icon(item))


def own_icon(item: str) -> Texels:
    """Our own icon of an item, uint8 [8, 8, 4]; the icon of paper for an unknown one."""
    dye, _, kind = item.rpartition("_")
    shape, colour = _SHAPES.get(item, (item, (0, 0, 0)))
    if kind in ("wool", "dye") and dye in DYES:
        shape, colour = kind, DYES[dye].rgb
    elif item.endswith("banner_pattern"):
        shape = "banner_pattern"
    rows = _shapes().get(shape) or _shapes()["paper"]
    return np.array([[_texel(mark, colour) for mark in row] for row in rows], np.uint8)


def _texel(mark: str, colour: tuple[int, int, int]) -> tuple[int, ...]:
    if mark == ".":
        return 0, 0, 0, 0
    if mark in _SHADES:
        return *(min(255, round(part * _SHADES[mark])) for part in colour), 255
    return *_COLOURS[mark], 255


@cache
def _shapes() -> dict[str, list[str]]:
    text = files(__package__).joinpath("icons.txt").read_text(encoding="utf-8")
    _, *shapes = (part.split() for part in text.split("\n\n"))
    return {name: rows for name, *rows in shapes}


def _address(texels: Texels) -> str:
    return f"data:image/png;base64,{b64encode(png_bytes(texels)).decode()}"
