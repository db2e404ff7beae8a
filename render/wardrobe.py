"""All looks of a scene as tables: which coats each has, and where their texels lie in one atlas."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError
from drapery.render.atlas import Atlas, make_atlas
from drapery.render.recent import Recent
from drapery.render.scene import Alpha, Coat, Look, Texels

OPAQUE, CUTOUT, BLEND = 0, 1, 2
ALPHA_CODES: dict[Alpha, int] = {"opaque": OPAQUE, "cutout": CUTOUT, "blend": BLEND}

MAX_TEXTURE = 16384
"""The longest side of a texture [texels]."""


@dataclass(frozen=True, eq=False)
class Wardrobe:
    """What the triangles of a draw list can wear.

    look_coats: a look's first coat and how many it has, shape [L, 2], int32.
    look_alpha: OPAQUE, CUTOUT or BLEND, shape [L], uint8.
    look_lit: whether light falls on it, shape [L], bool.
    coat_rects: x, y, width, height in the atlas [texels], shape [C, 4], int32.
    coat_tints: shape [C, 3], uint8.
    atlas: sRGB with straight alpha, shape [H, W, 4], uint8.
    """

    look_coats: NDArray[np.int32]
    look_alpha: NDArray[np.uint8]
    look_lit: NDArray[np.bool_]
    coat_rects: NDArray[np.int32]
    coat_tints: NDArray[np.uint8]
    atlas: Texels


_recent: Recent[Wardrobe] = Recent()


def make_wardrobe(looks: Sequence[Look]) -> Wardrobe:
    """The tables of these looks; look i keeps its place, and each texture is packed once.

    Raises OptionError for a look without coats or a texture that is none.
    """
    arrays = tuple(coat.texels for look in looks for coat in look.coats)
    plain = [(look.alpha, look.lit, [coat.tint for coat in look.coats]) for look in looks]
    return _recent.get(arrays, plain, lambda: _make(looks))


def _make(looks: Sequence[Look]) -> Wardrobe:
    coats = [coat for look in looks for coat in look.coats]
    counts = [len(look.coats) for look in looks]
    if 0 in counts:
        raise OptionError(f"look {counts.index(0)} has no coats; give it at least one texture")
    sprites, sprite_of = _distinct(coats)
    atlas: Atlas = make_atlas(sprites)
    firsts = np.cumsum([0, *counts])[:-1]
    return Wardrobe(
        np.stack([firsts, counts], axis=1).astype(np.int32),
        np.array([ALPHA_CODES[look.alpha] for look in looks], np.uint8),
        np.array([look.lit for look in looks], np.bool_),
        atlas.rects[sprite_of],
        np.array([coat.tint for coat in coats], np.uint8).reshape(-1, 3),
        atlas.texels,
    )


def _distinct(coats: Sequence[Coat]) -> tuple[list[Texels], NDArray[np.intp]]:
    """The different textures among coats, and for each coat its texture's place."""
    place: dict[int | tuple[tuple[int, ...], bytes], int] = {}
    sprites: list[Texels] = []
    for coat in coats:
        if id(coat.texels) in place:
            continue
        checked = _checked(coat.texels)
        content = checked.shape, checked.tobytes()
        if content not in place:
            place[content] = len(sprites)
            sprites.append(checked)
        place[id(coat.texels)] = place[content]
    return sprites, np.array([place[id(coat.texels)] for coat in coats], np.intp)


def _checked(texels: Texels) -> Texels:
    good = texels.dtype == np.uint8 and texels.ndim == 3 and texels.shape[2] == 4
    if not (good and min(texels.shape[:2]) >= 1 and max(texels.shape[:2]) <= MAX_TEXTURE):
        raise OptionError(
            f"a texture of shape {texels.shape} and type {texels.dtype} cannot be worn;"
            f" use [height, width, 4] of uint8 with sides of 1 to {MAX_TEXTURE}"
        )
    return texels
