"""A contact sheet: the face of every pattern of a stack of packs, with its name."""

from typing import TYPE_CHECKING

import numpy as np

from drapery.banner.design import Banner, Layer
from drapery.banner.packs import Packs
from drapery.banner.png import Texels
from drapery.banner.sprites import FRONT, composite, flag_layers
from drapery.errors import PackError

if TYPE_CHECKING:
    from PIL.ImageDraw import ImageDraw

COLUMNS = 11
CELL = (96, 174)
FACE = (64, 128)
"""Width and height of a cell and of the face in it [px]."""

_INK = (225, 225, 230, 255)
_PAPER = (43, 45, 51, 255)
_MAX_PATTERNS = 1000


def contact_sheet(packs: Packs, *, base: str = "white", dye: str = "black") -> Texels:
    """Each pattern's face and name, as pixels [H, W, 4], in the order of `Packs.patterns`.

    base, dye: the dyes of the cloth and of the pattern. A pattern whose file is broken is a cell
    without a face. Raises PackError for more than 1000 patterns.
    """
    from PIL import Image, ImageDraw

    patterns = packs.patterns()
    if len(patterns) > _MAX_PATTERNS:
        raise PackError(f"the packs have {len(patterns)} patterns; a sheet shows {_MAX_PATTERNS}")
    rows = -(-len(patterns) // COLUMNS)
    picture = Image.new("RGBA", (COLUMNS * CELL[0], rows * CELL[1]), _PAPER)
    pen = ImageDraw.Draw(picture)
    for number, pattern in enumerate(patterns):
        left, top = number % COLUMNS * CELL[0], number // COLUMNS * CELL[1]
        face = _face(packs, Banner(base, (Layer(pattern, dye),)))
        if face is not None:
            picture.paste(Image.fromarray(face), (left + (CELL[0] - FACE[0]) // 2, top + 6))
        _write(pen, pattern, left + CELL[0] // 2, top + FACE[1] + 10)
    return np.array(picture)


def _face(packs: Packs, banner: Banner) -> Texels | None:
    try:
        sheet = composite(flag_layers(banner, packs))
    except PackError:
        return None
    # Nearest texel at each pixel's middle, so sheets of all sizes give the same picture's size.
    face = FRONT.crop(sheet)
    down = (2 * np.arange(FACE[1]) + 1) * len(face) // (2 * FACE[1])
    across = (2 * np.arange(FACE[0]) + 1) * face.shape[1] // (2 * FACE[0])
    return np.ascontiguousarray(face[down[:, None], across])


def _write(pen: "ImageDraw", name: str, middle: int, top: int) -> None:
    """The name in up to three centred lines. The bitmap font looks alike on every machine."""
    from PIL.ImageFont import load_default_imagefont

    font = load_default_imagefont()
    for number, line in enumerate(_lines(name.removeprefix("minecraft:"), CELL[0] // 6 - 1)):
        width = font.getbbox(line)[2]
        pen.text((middle - width // 2, top + 11 * number), line, _INK, font)


def _lines(name: str, longest: int) -> list[str]:
    """The name broken after `_`, `:` and `/` into up to three lines."""
    lines = [""]
    for word in name.replace("_", "_\n").replace(":", ":\n").replace("/", "/\n").split("\n"):
        if len(lines[-1] + word) > longest:
            lines.append("")
        lines[-1] += word
    return [line[:longest] for line in lines[:3] if line]
