"""Small pictures of designs and patterns, drawn from the session's packs, as PNG files."""

from weakref import WeakKeyDictionary
from zlib import crc32

import numpy as np

from drapery.banner.design import Banner, Layer
from drapery.banner.packs import Packs
from drapery.banner.packs.resampling import resize
from drapery.banner.sprites import (
    FLAG_REGIONS,
    SHIELD_REGIONS,
    UNITS,
    SheetRegion,
    composite,
    flag_layers,
    shield_layers,
)
from drapery.pictures import face_pixels
from drapery.render.encode.png import png_bytes
from drapery.render.frame import Pixels
from drapery.studio.session import Session

FACE_SCALE = 8


def face_png(banner: Banner, packs: Packs, scale: int = FACE_SCALE) -> bytes:
    """The plain face, 20 x 40 units of `scale` pixels; of a shield 12 x 22. Raises PackError."""
    if banner.kind == "banner":
        return png_bytes(face_pixels(banner, packs, scale))
    sheet = composite(shield_layers(banner, packs))
    return png_bytes(_sampled(SHIELD_REGIONS["front"], sheet, scale))


def pattern_names(packs: Packs) -> tuple[str, ...]:
    """`packs.patterns()`, asked once for as long as they are open."""
    if packs not in _names:
        _names[packs] = packs.patterns()
    return _names[packs]


_names: WeakKeyDictionary[Packs, tuple[str, ...]] = WeakKeyDictionary()
_sheets: WeakKeyDictionary[Packs, dict[tuple[str, str], bytes]] = WeakKeyDictionary()


def pattern_sheet(packs: Packs, base: str, dye: str) -> bytes:
    """All patterns of the packs side by side, in one dye on a field of another.

    Cells of 20 x 40 pixels in the order of `pattern_names`. Raises PackError, DesignError.
    """
    kept = _sheets.setdefault(packs, {})
    if (base, dye) not in kept:
        banners = [Banner(base, (Layer(name, dye),)) for name in pattern_names(packs)]
        cells = [_cell(packs, banner) for banner in banners]
        kept[base, dye] = png_bytes(np.concatenate(cells, axis=1))
    return kept[base, dye]


def _cell(packs: Packs, banner: Banner) -> Pixels:
    # Sampled before they are laid over each other: fine packs have 256 times the texels.
    layers = [(resize(texels, UNITS), rgb) for texels, rgb in flag_layers(banner, packs)]
    return _sampled(FLAG_REGIONS["front"], composite(layers), 1)


def _sampled(region: SheetRegion, sheet: Pixels, scale: int) -> Pixels:
    """A region at `scale` pixels a unit, each the nearest texel to its middle."""
    texels = region.crop(sheet)
    height, width = (region.bottom - region.top) * scale, (region.right - region.left) * scale
    down = (np.arange(height) * 2 + 1) * texels.shape[0] // (2 * height)
    across = (np.arange(width) * 2 + 1) * texels.shape[1] // (2 * width)
    return np.ascontiguousarray(texels[down][:, across])


def sheet_address(session: Session, dye: str) -> str:
    """Where the page finds `pattern_sheet` for the session's packs and field, in a dye."""
    settings = session.settings
    mark = crc32(repr((settings.packs, settings.format)).encode())
    return f"/patterns/{session.token}.png?base={session.sketch.base}&dye={dye}&packs={mark:x}"
