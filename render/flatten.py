"""Coats laid over one another once, texel by texel, instead of at every sample.

The rasteriser lays coats over one another before it lights them, so one composited texture gives
the same picture to the bit, in a fraction of the time.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from drapery.render.atlas import make_atlas
from drapery.render.recent import Recent
from drapery.render.scene import Texels
from drapery.render.wardrobe import CUTOUT, OPAQUE, Wardrobe

MAX_TEXELS = 1 << 20
"""Wardrobes that would need more texels stay as they are; coats then meet at every sample."""

_recent: Recent[Wardrobe] = Recent()


def flattened(worn: Wardrobe) -> Wardrobe:
    """The same looks, each of one coat, where their textures' sizes allow it."""
    return _recent.get((worn,), None, lambda: _flatten(worn))


def _flatten(worn: Wardrobe) -> Wardrobe:
    sizes = [_common_size(worn, look) for look in range(len(worn.look_coats))]
    if None in sizes or sum(w * h for w, h in filter(None, sizes)) > MAX_TEXELS:
        return worn
    sprites = [_composite(worn, look, size) for look, size in enumerate(sizes) if size]
    atlas = make_atlas(sprites)
    numbers = np.arange(len(sprites), dtype=np.int32)
    return replace(
        worn,
        look_coats=np.stack([numbers, np.ones_like(numbers)], axis=1),
        coat_rects=atlas.rects,
        coat_tints=np.full((len(sprites), 3), 255, np.uint8),
        atlas=atlas.texels,
    )


def _common_size(worn: Wardrobe, look: int) -> tuple[int, int] | None:
    """The largest size among a look's textures, if each of the others divides it."""
    first, count = worn.look_coats[look]
    sizes = worn.coat_rects[first : first + count, 2:]
    largest = sizes.max(axis=0)
    if (largest % sizes).any():
        return None
    return int(largest[0]), int(largest[1])


def _composite(worn: Wardrobe, look: int, size: tuple[int, int]) -> Texels:
    first, count = worn.look_coats[look]
    below = _sprite(worn, first, size)
    alpha = below[..., 3]
    if worn.look_alpha[look] == OPAQUE:
        alpha[:] = 255
    elif worn.look_alpha[look] == CUTOUT:
        cut = alpha < 128
        below[cut] = 0
        alpha[~cut] = 255
    for coat in range(first + 1, first + count):
        below = lay_over(_sprite(worn, coat, size), below)
    if worn.look_alpha[look] == CUTOUT:
        below[cut] = 0
    return below


def _sprite(worn: Wardrobe, coat: int, size: tuple[int, int]) -> Texels:
    """A coat's texels, tinted, at the common size."""
    x, y, width, height = worn.coat_rects[coat]
    texels = worn.atlas[y : y + height, x : x + width].copy()
    tint = worn.coat_tints[coat].astype(np.uint16)
    texels[..., :3] = (texels[..., :3] * tint + 127) // 255
    return texels.repeat(size[1] // height, axis=0).repeat(size[0] // width, axis=1)


def lay_over(top: Texels, below: Texels) -> Texels:
    """Straight-alpha texels over others: round((a * src + (255 - a) * dst) / 255) where what is
    below is opaque, and Porter and Duff's `over` (1984) in whole numbers elsewhere."""
    a, d = (texels[..., 3:].astype(np.int32) for texels in (top, below))
    share, rest = 255 * a, d * (255 - a)
    total = share + rest
    colour = (share * top[..., :3] + rest * below[..., :3] + total // 2) // np.maximum(total, 1)
    alpha: NDArray[np.int32] = (total + 127) // 255
    return np.concatenate([colour, alpha], axis=-1).astype(np.uint8)
