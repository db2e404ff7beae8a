"""The texture of capes and elytra, and their place on a player's back."""

import warnings
from dataclasses import astuple
from pathlib import Path

import numpy as np

from drapery.arrays import Texels
from drapery.banner.names import shown
from drapery.banner.packs import Packs
from drapery.banner.packs.equipment import WINGS_SHEET, whole_wings
from drapery.banner.packs.png_file import read_png_file
from drapery.errors import OptionError
from drapery.settings import Settings
from drapery.style.figure import TEXEL
from drapery.style.uv_mapping import BoxMapping
from drapery.style.visible import is_invisible

SHOULDERS = (0.5, 24 * TEXEL, 0.5)
"""The middle between the shoulders [m], above the middle of a block."""

SHEET = WINGS_SHEET


def back_texture(settings: Settings, packs: Packs, used: BoxMapping) -> Texels:
    """The sheet of a cape and elytra, shape [H, 2 H, 4]: the texture given, or the packs'.

    used: the part that is shown. It warns of one that is transparent.
    Raises OptionError or PackError.
    """
    name, texels = _texels(settings, packs)
    height, width = texels.shape[:2]
    sides = np.reshape(astuple(used), (-1, 2, 2)) * SHEET
    low, high = (tuple(map(round, edge)) for edge in (sides.min((0, 1)), sides.max((0, 1))))
    whole = whole_wings(width, height, (high[0], high[1]))
    if whole is not None:
        sheet = _widened(texels, whole)
        if is_invisible(sheet, astuple(used)):
            warnings.warn(
                f"{name}: its part for kind {settings.kind}, from {low[0]},{low[1]} to"
                f" {high[0]},{high[1]} of {SHEET[0]} x {SHEET[1]} texels, is transparent, so"
                " nothing can be seen; use another texture or kind",
                UserWarning,
                stacklevel=2,
            )
        return sheet
    raise OptionError(
        f"{name} is {width} x {height} px, which does not fit a {settings.kind};"
        " use 64 x 32 px, or a multiple of it"
    )


def _texels(settings: Settings, packs: Packs) -> tuple[str, Texels]:
    """The texture and what messages call it. Raises OptionError or PackError."""
    texture = settings.texture
    if texture is None:
        return "elytra.png of the packs", _of_packs(settings.kind, packs)
    if isinstance(texture, str | Path):
        name = f"texture {shown(str(texture), 200)}"
        return name, read_png_file(Path(texture), name)
    if texture.dtype != np.uint8 or texture.ndim != 3 or texture.shape[2] != 4:
        raise OptionError(
            f"texture: an array of {texture.dtype} {list(texture.shape)}; use uint8 [H, W, 4]"
        )
    return "texture: the array", texture


def _of_packs(kind: str, packs: Packs) -> Texels:
    """The packs' sheet of wings, for a cape only where one is drawn beside the wings."""
    texels = packs.elytra()
    if texels is None:
        raise OptionError(
            f"kind {kind} needs a texture; give its PNG file by texture,"
            " or a pack that has elytra.png"
        )
    height, width = texels.shape[:2]
    if kind == "cape" and not texels[: height * 17 // SHEET[1], : width * 22 // SHEET[0], 3].any():
        raise OptionError(
            "elytra.png of the packs has no cape beside the wings; give a PNG file by texture"
        )
    return texels


def _widened(texels: Texels, size: tuple[int, int]) -> Texels:
    """The sheet at its whole size, width and height [px], transparent where it was cut."""
    whole = np.zeros((size[1], size[0], 4), np.uint8)
    whole[: texels.shape[0], : texels.shape[1]] = texels
    return whole
