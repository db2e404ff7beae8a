"""All materials of a scene as tables: their layers, and the layers' places in one atlas."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Bytes, Floats, Integers, Mask, Texels
from drapery.errors import OptionError
from drapery.render.atlas import Atlas, make_atlas
from drapery.render.detail import DetailTables, make_detail_tables
from drapery.render.identity_cache import IdentityCache
from drapery.render.scene import Alpha, Material, TextureLayer

OPAQUE, CUTOUT, BLEND = 0, 1, 2
ALPHA_CODES: dict[Alpha, int] = {"opaque": OPAQUE, "cutout": CUTOUT, "blend": BLEND}

MAX_TEXTURE = 16384
"""The longest side of a texture [texels]."""


@dataclass(frozen=True, eq=False)
class MaterialTables:
    """The materials of a draw list; triangles refer to them by their index.

    material_layers: first layer and number of layers of each material, shape [L, 2], int32.
    material_alpha: OPAQUE, CUTOUT or BLEND, shape [L], uint8.
    material_lit: whether light falls on it, shape [L], bool.
    material_transmission: see `Material`, shape [L], float32.
    layer_rects: x, y, width, height in the atlas [texels], shape [C, 4], int32.
    layer_tints: shape [C, 3], uint8.
    atlas: sRGB with straight alpha, shape [H, W, 4], uint8.
    details: see `DetailTables`.
    """

    material_layers: Integers
    material_alpha: Bytes
    material_lit: Mask
    material_transmission: Floats
    layer_rects: Integers
    layer_tints: Bytes
    atlas: Texels
    details: DetailTables


_cache: IdentityCache[MaterialTables] = IdentityCache()


def make_material_tables(materials: Sequence[Material]) -> MaterialTables:
    """The tables of these materials in their order; each texture is in the atlas once.

    Raises OptionError for a material without layers or a texture of another shape or type.
    """
    arrays = tuple(layer.texels for material in materials for layer in material.layers)
    plain = [
        (
            *(material.alpha, material.lit, material.transmission, material.detail),
            [layer.tint for layer in material.layers],
        )
        for material in materials
    ]
    return _cache.get(arrays, plain, lambda: _make(materials))


def material_numbers(tables: MaterialTables) -> NDArray[np.int32]:
    """The number of each material from 0 on; equal ones have one number, see `Buffers.material`."""
    known: dict[tuple[object, ...], int] = {}
    numbers = []
    for (first, count), alpha, lit in zip(
        tables.material_layers, tables.material_alpha, tables.material_lit, strict=True
    ):
        own = slice(first, first + count)
        rects, tints = tables.layer_rects[own].tobytes(), tables.layer_tints[own].tobytes()
        numbers.append(known.setdefault((rects, tints, int(alpha), bool(lit)), len(known)))
    return np.array(numbers, np.int32)


def _make(materials: Sequence[Material]) -> MaterialTables:
    layers = [layer for material in materials for layer in material.layers]
    counts = [len(material.layers) for material in materials]
    if 0 in counts:
        raise OptionError(f"material {counts.index(0)} has no layers; give it at least one texture")
    sprites, sprite_of = _distinct(layers)
    atlas: Atlas = make_atlas(sprites)
    firsts = np.cumsum([0, *counts])[:-1]
    return MaterialTables(
        np.stack([firsts, counts], axis=1).astype(np.int32),
        np.array([ALPHA_CODES[material.alpha] for material in materials], np.uint8),
        np.array([material.lit for material in materials], np.bool_),
        np.array([material.transmission for material in materials], np.float32),
        atlas.rects[sprite_of],
        np.array([layer.tint for layer in layers], np.uint8).reshape(-1, 3),
        atlas.texels,
        make_detail_tables([material.detail for material in materials]),
    )


def _distinct(layers: Sequence[TextureLayer]) -> tuple[list[Texels], NDArray[np.intp]]:
    """The different textures of the layers, and the index of each layer's texture."""
    place: dict[int | tuple[tuple[int, ...], bytes], int] = {}
    sprites: list[Texels] = []
    for layer in layers:
        if id(layer.texels) in place:
            continue
        checked = _checked(layer.texels)
        content = checked.shape, checked.tobytes()
        if content not in place:
            place[content] = len(sprites)
            sprites.append(checked)
        place[id(layer.texels)] = place[content]
    return sprites, np.array([place[id(layer.texels)] for layer in layers], np.intp)


def _checked(texels: Texels) -> Texels:
    good = texels.dtype == np.uint8 and texels.ndim == 3 and texels.shape[2] == 4
    if not (good and min(texels.shape[:2]) >= 1 and max(texels.shape[:2]) <= MAX_TEXTURE):
        raise OptionError(
            f"a texture of shape {texels.shape} and type {texels.dtype} cannot be drawn;"
            f" use [height, width, 4] of uint8 with sides of 1 to {MAX_TEXTURE}"
        )
    return texels
