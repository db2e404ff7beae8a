"""Decoded textures, within a limit of memory."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field

from drapery.banner.packs.textures import MAX_SHEET, MISSING, Texture

MAX_CACHED_TEXELS = 18 * MAX_SHEET**2
"""Most texels that an opened stack of packs keeps decoded (4 bytes each, 302 MB): the two base
sheets and sixteen layers of one banner at the largest size."""


@dataclass
class TextureCache:
    """The textures used last; the others are decoded again when they are asked for again.

    Threads may share one: each operation on the dictionary is whole.
    """

    _textures: dict[Hashable, Texture] = field(default_factory=dict)

    def get(self, key: Hashable, read: Callable[[], Texture]) -> Texture:
        """The texture of a key, by `read` if it is not in the cache; a missing one is not kept."""
        known = self._textures.pop(key, None)
        texture = known or read()
        if texture is not MISSING:
            # A dictionary keeps the order of insertion: the texture used last comes last.
            self._textures[key] = texture
        if known is None:
            self._shrink()
        return texture

    def _shrink(self) -> None:
        kept = [*self._textures.items()]
        size = sum(texture.texel_count() for _, texture in kept)
        for key, texture in kept[:-1]:
            if size <= MAX_CACHED_TEXELS:
                return
            size -= texture.texel_count()
            self._textures.pop(key, None)
