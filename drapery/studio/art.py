"""Small pictures of designs and patterns, drawn from the session's packs, as PNG files."""

import threading
from collections.abc import Callable
from urllib.parse import urlencode
from weakref import WeakKeyDictionary
from zlib import crc32

from drapery import Banner, OptionError, Settings
from drapery.packs import Packs
from drapery.pictures import face_pixels
from drapery.render import draw_scene, png_bytes
from drapery.scenes import still
from drapery.studio.document import Document
from drapery.styles import find_style

FACE_SCALE = 8
THUMBNAIL_SCALE = 2
"""Pixels of a texel in the library."""
STYLE_SIZE = (72, 128)
"""Width and height of the picture of a style [pixels]."""
STYLE_GRID = (7, 13)
MAX_STYLES = 128
"""Pictures of styles that are cached for a stack of packs."""


def face_png(banner: Banner, packs: Packs, scale: int = FACE_SCALE) -> bytes:
    """The flat face: 20 x 40 units (shield: 12 x 22) of `scale` pixels each. Raises PackError."""
    return png_bytes(face_pixels(banner, packs, scale, kind=banner.kind))


def face_files(document: Document, pack: str = "now") -> dict[str, str]:
    """The addresses of what the page's editor draws faces of, by the kind of design.

    pack: the tab's packs as they are `now`, its `own` art alone, or the number of one of its packs.
    """
    words = urlencode(_packs(document, pack))
    return {kind: f"faces/{document.token}/{kind}.bin?{words}" for kind in ("banner", "shield")}


def pattern_names(packs: Packs) -> tuple[str, ...]:
    """The patterns that a design can name; the result is cached for each opened stack of packs."""
    if packs not in _names:
        extra = packs.extra_sprites()
        _names[packs] = tuple(name for name in packs.patterns() if name not in extra)
    return _names[packs]


_names: WeakKeyDictionary[Packs, tuple[str, ...]] = WeakKeyDictionary()


_styled: WeakKeyDictionary[Packs, dict[tuple[Banner, str], bytes]] = WeakKeyDictionary()
_one_style = threading.Lock()


def style_png(
    banner: Banner, packs: Packs, style: str, is_wanted: Callable[[], bool] = lambda: True
) -> bytes:
    """The design as cloth in a style, small. Raises OptionError, PackError.

    One is drawn at a time, because a page asks for all of them at once.
    is_wanted: asked when its turn comes; a page that is gone must not hold the server's end.
    """
    with _one_style:
        if not is_wanted():
            raise OptionError("the page is gone; open it again")
        drawn = _styled.setdefault(packs, {})
        if (banner, style) not in drawn:
            while len(drawn) >= MAX_STYLES:
                del drawn[next(iter(drawn))]
            settings = Settings(size=STYLE_SIZE, grid=STYLE_GRID, style=(style,))
            scene = still(banner, packs, settings)
            drawn[banner, style] = png_bytes(find_style(style).draw(scene, draw_scene).pixels)
        return drawn[banner, style]


def style_address(document: Document, style: str) -> str:
    """The address from the page of `style_png` for the tab's packs and design."""
    settings = document.settings
    shown = document.sketch, settings.packs, settings.format
    return f"styles/{document.token}/{style}.png?v={crc32(repr(shown).encode()):x}"


def _packs(document: Document, pack: str) -> dict[str, str]:
    """The packs of a picture, and a mark of all of the tab's, because browsers keep pictures."""
    used = document.settings.packs, document.settings.format
    return {"pack": pack, "v": f"{crc32(repr(used).encode()):x}"}
