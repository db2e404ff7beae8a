"""What is drawn on a piece: its material, and where its sides lie on the texture."""

from pathlib import Path

import numpy as np

from drapery.arrays import Texels
from drapery.banner.dyes import DYES
from drapery.banner.names import shown
from drapery.banner.packs import Packs
from drapery.banner.packs.png_file import read_png_file
from drapery.banner.sprites import WHITE, Tint, tint
from drapery.garments.model import Area, ClothTexture
from drapery.render.scene import Material, TextureLayer
from drapery.style.block import FLAG_MAPPING
from drapery.style.layers import flag_material
from drapery.style.uv_mapping import BoxMapping, Rect, RegionMapping, box_mapping

FACE = (20, 40)
"""Width and height of a banner's face, in whose texels the regions of a design are given."""


def texture_of(
    texture: ClothTexture, size: tuple[float, float], packs: Packs, folder: Path
) -> tuple[Material, BoxMapping | RegionMapping]:
    """The material of a piece, and where its sides lie on it.

    size: width and height of the piece [texels]. folder: where relative paths start.
    Raises OptionError for a file that cannot be read, and PackError.
    """
    if texture.design is not None:
        return flag_material(texture.design, packs), _of_design(texture)
    if texture.source == "block":
        texels = _woven(texture, size, packs)
        return Material((TextureLayer(texels),)), _regions(texture, size)
    if texture.file is not None:
        texels = read_texture(folder / texture.file)
    else:
        texels = packs.texture(str(texture.pack))
    material = Material((TextureLayer(texels, _colour(texture.dye)),), "cutout")
    sheet = texture.sheet or (float(texels.shape[1]), float(texels.shape[0]))
    if texture.box is not None:
        left, top, *extent = texture.box
        return material, box_mapping((left, top), (extent[0], extent[1], extent[2]), sheet)
    return material, _regions(texture, sheet)


def read_texture(path: Path) -> Texels:
    """The texels of a PNG file. Raises OptionError or PackError."""
    return read_png_file(path, f"texture {shown(str(path), 200)}")


def _of_design(texture: ClothTexture) -> BoxMapping | RegionMapping:
    if texture.front is None and texture.back is None:
        return FLAG_MAPPING
    whole = (0.0, 0.0, float(FACE[0]), float(FACE[1]))
    front = _within(FLAG_MAPPING.front_rect, texture.front or whole)
    return RegionMapping(front, _within(FLAG_MAPPING.back_rect, texture.back or whole))


def _within(outer: Rect, area: Area) -> Rect:
    """A part of a banner's face as fractions of its sheet."""
    left, top, right, bottom = _fractions(area, (float(FACE[0]), float(FACE[1])))
    width, height = outer[2] - outer[0], outer[3] - outer[1]
    x, y = outer[:2]
    return x + left * width, y + top * height, x + right * width, y + bottom * height


def _regions(texture: ClothTexture, sheet: tuple[float, float]) -> RegionMapping:
    front = (0.0, 0.0, 1.0, 1.0) if texture.front is None else _fractions(texture.front, sheet)
    back = front if texture.back is None else _fractions(texture.back, sheet)
    return RegionMapping(front, back)


def _fractions(area: Area, sheet: tuple[float, float]) -> Rect:
    (left, top, width, height), (across, down) = area, sheet
    return left / across, top / down, (left + width) / across, (top + height) / down


def _woven(texture: ClothTexture, size: tuple[float, float], packs: Packs) -> Texels:
    """A block's texture over the whole piece, one texel of it on each texel, in its dyes."""
    block = packs.texture(f"block/{texture.block or 'white_wool'}")
    times = max(1, block.shape[1] // 16)
    width, height = (max(1, round(length)) * times for length in size)
    rows, columns = np.arange(height), np.arange(width)
    tile = block[: block.shape[1]]  # the first frame of an animated one
    plain = tile[(rows % len(tile))[:, None], columns % tile.shape[1]]
    stripe, band = (place // (texture.width * times) for place in (columns, rows[:, None]))
    order = (texture.dye, *texture.stripes, *texture.bands)
    across = stripe % (len(texture.stripes) + 1)
    down = band % (len(texture.bands) + 1)
    shade = np.where(down > 0, len(texture.stripes) + down, across)
    if texture.trim is not None:
        order = (*order, texture.trim)
        shade = np.where(
            rows[:, None] >= height - texture.trim_width * times, len(order) - 1, shade
        )
    woven = np.empty_like(plain)
    for number, dye in enumerate(order):
        woven[shade == number] = tint(plain, _colour(dye))[shade == number]
    return np.ascontiguousarray(woven)


def _colour(dye: str | None) -> Tint:
    return WHITE if dye is None else DYES[dye].rgb
