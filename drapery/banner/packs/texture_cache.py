"""Decoded textures, within a limit of memory."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field

from drapery.banner.packs.textures import MAX_SHEET, Texture

MAX_CACHED_TEXELS = 18 * MAX_SHEET**2
"""Most texels that an opened stack of packs keeps decoded (4 bytes each, 302 MB): the two base
sheets and sixteen layers of one banner at the largest size."""


@dataclass
class TextureCache:
    """The textures used last; the others are decoded again when they are asked for again."""

    _textures: dict[Hashable, Texture] = field(default_factory=dict)
    _size: int = 0

    def get(self, key: Hashable, read: Callable[[], Texture]) -> Texture:
        """The texture of a key, by `read` if it is not in the cache."""
        texture = self._textures.pop(key, None)
        if texture is None:
            texture = read()
            self._size += texture.texel_count()
        # A dictionary keeps the order of insertion: the texture used last comes last.
        self._textures[key] = texture
        while self._size > MAX_CACHED_TEXELS and len(self._textures) > 1:
            oldest = next(iter(self._textures))
            self._size -= self._textures.pop(oldest).texel_count()
        return texture
