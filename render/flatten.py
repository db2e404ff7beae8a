"""Composites a material's layers once, texel by texel, instead of at every sample.

The rasteriser composites layers before it lights them, so one composited texture gives exactly the
same picture in a fraction of the time.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Texels
from drapery.render.atlas import make_atlas
from drapery.render.identity_cache import IdentityCache
from drapery.render.materials import CUTOUT, OPAQUE, MaterialTables

MAX_TEXELS = 1 << 20
"""The most texels of composited textures; larger ones are composited at every sample."""

_cache: IdentityCache[MaterialTables] = IdentityCache()


def composite_layers(tables: MaterialTables) -> MaterialTables:
    """The same materials with one layer each; `tables` itself if the textures' sizes prevent it."""
    return _cache.get((tables,), None, lambda: _flatten(tables))


def _flatten(tables: MaterialTables) -> MaterialTables:
    sizes = [_common_size(tables, material) for material in range(len(tables.material_layers))]
    if None in sizes or sum(w * h for w, h in filter(None, sizes)) > MAX_TEXELS:
        return tables
    sprites = [_composite(tables, material, size) for material, size in enumerate(sizes) if size]
    atlas = make_atlas(sprites)
    numbers = np.arange(len(sprites), dtype=np.int32)
    return replace(
        tables,
        material_layers=np.stack([numbers, np.ones_like(numbers)], axis=1),
        layer_rects=atlas.rects,
        layer_tints=np.full((len(sprites), 3), 255, np.uint8),
        atlas=atlas.texels,
    )


def _common_size(tables: MaterialTables, material: int) -> tuple[int, int] | None:
    """The largest size among a material's textures, if each of the others divides it."""
    first, count = tables.material_layers[material]
    sizes = tables.layer_rects[first : first + count, 2:]
    largest = sizes.max(axis=0)
    if (largest % sizes).any():
        return None
    return int(largest[0]), int(largest[1])


def _composite(tables: MaterialTables, material: int, size: tuple[int, int]) -> Texels:
    first, count = tables.material_layers[material]
    below = _sprite(tables, first, size)
    alpha = below[..., 3]
    if tables.material_alpha[material] == OPAQUE:
        alpha[:] = 255
    elif tables.material_alpha[material] == CUTOUT:
        cut = alpha < 128
        below[cut] = 0
        alpha[~cut] = 255
    for layer in range(first + 1, first + count):
        below = lay_over(_sprite(tables, layer, size), below)
    if tables.material_alpha[material] == CUTOUT:
        below[cut] = 0
    return below


def _sprite(tables: MaterialTables, layer: int, size: tuple[int, int]) -> Texels:
    """A layer's texels, tinted, at the common size."""
    x, y, width, height = tables.layer_rects[layer]
    texels = tables.atlas[y : y + height, x : x + width].copy()
    tint = tables.layer_tints[layer].astype(np.uint16)
    texels[..., :3] = (texels[..., :3] * tint + 127) // 255
    return texels.repeat(size[1] // height, axis=0).repeat(size[0] // width, axis=1)


def lay_over(top: Texels, below: Texels) -> Texels:
    """Straight-alpha texels over others: round((a * src + (255 - a) * dst) / 255) over opaque
    texels, and Porter and Duff's `over` (1984) in whole numbers elsewhere."""
    a, d = (texels[..., 3:].astype(np.int32) for texels in (top, below))
    share, rest = 255 * a, d * (255 - a)
    total = share + rest
    colour = (share * top[..., :3] + rest * below[..., :3] + total // 2) // np.maximum(total, 1)
    alpha: NDArray[np.int32] = (total + 127) // 255
    return np.concatenate([colour, alpha], axis=-1).astype(np.uint8)
