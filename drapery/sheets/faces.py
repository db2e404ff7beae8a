"""Sheets of plain faces: all patterns in their dyes, a pack's contents, the loom's steps."""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from drapery.arrays import Pixels
from drapery.banner.design import Banner
from drapery.banner.dyes import DYES
from drapery.banner.loom import loom_steps
from drapery.banner.packs import Packs
from drapery.banner.sprites import FLAG_REGIONS, composite, flag_layers
from drapery.errors import OptionError, PackError, counted
from drapery.pictures import face_pixels
from drapery.sheets.sheet import PictureSheet, SheetCell

MAX_FACES = 2000

Side = Literal["front", "back"]


def patterns_sheet(
    packs: Packs, base: str, dyes: Sequence[str], *, side: Side = "front", scale: int = 3
) -> PictureSheet:
    """Every pattern of the packs, extra ones too, in several dyes on a base.

    A pattern whose file is broken is an empty cell labelled as broken.

    packs: resource packs, see `drapery.packs.open_packs`.
    base: the base dye.
    dyes: of the patterns; each pattern has a face in each.
    side: of the cloth.
    scale: pixels of a texel.

    Raises OptionError for more than 2000 faces.
    """
    patterns = packs.patterns()
    count = len(patterns) * len(dyes)
    if count > MAX_FACES:
        raise OptionError(f"{count} faces are too many for a sheet of {MAX_FACES}; use fewer dyes")
    cells = tuple(
        _pattern_cell(packs, base, (pattern, dye), len(dyes) > 1, side, scale)
        for pattern in patterns
        for dye in dyes
    )
    title = f"{counted(len(patterns), 'pattern')} on {_words(base)}"
    names = tuple(map(_short, patterns))
    if len(dyes) > 1:
        return PictureSheet(title, cells, len(dyes), tuple(map(_words, dyes)), names)
    return PictureSheet(f"{title}, in {_words(dyes[0])}", cells, min(11, len(cells)))


def contents_sheet(packs: Packs, *, base: str = "white", dye: str = "black") -> PictureSheet:
    """Every pattern of a stack of packs, with the pack that it is from.

    packs: resource packs, see `drapery.packs.open_packs`.
    base: the base dye.
    dye: of the patterns.

    Raises OptionError for more than 2000 patterns.
    """
    sheet = patterns_sheet(packs, base, (dye,))
    cells = tuple(
        SheetCell(f"{cell.label} {_origin(packs, pattern)}".rstrip(), cell.pixels)
        for pattern, cell in zip(packs.patterns(), sheet.cells, strict=True)
    )
    return PictureSheet(
        " over ".join(pack.label for pack in packs.packs[::-1]), cells, sheet.columns
    )


def steps_sheet(banner: Banner, packs: Packs) -> PictureSheet:
    """The banner after each step at the loom, with the dye and the pattern to use.

    banner: the design.
    packs: resource packs, see `drapery.packs.open_packs`.
    """
    made = [(f"base, {banner.base}", Banner(banner.base))]
    made += [
        (f"{step.layer.pattern}, {step.layer.dye}", step.banner) for step in loom_steps(banner)
    ]
    cells = tuple(
        SheetCell(f"{number}. {name}", face_pixels(until, packs, 4))
        for number, (name, until) in enumerate(made)
    )
    return PictureSheet("The loom's steps", cells, min(len(cells), 6))


def _pattern_cell(
    packs: Packs, base: str, layer: tuple[str, str], with_dye: bool, side: Side, scale: int
) -> SheetCell:
    """One pattern in one dye. It is laid over the base as it is: no Layer can name an extra one."""
    pattern, dye = layer
    label = _short(pattern) + (f", {_words(dye)}" if with_dye else "")
    try:
        layers = *flag_layers(Banner(base), packs), (packs.sheet(pattern), DYES[dye].rgb)
        return SheetCell(label, FLAG_REGIONS[side].sample(composite(layers), scale))
    except PackError:
        return SheetCell(f"{label} (broken)", _nothing(scale))


def _nothing(scale: int) -> Pixels:
    return np.zeros((40 * scale, 20 * scale, 4), np.uint8)


def _origin(packs: Packs, pattern: str) -> str:
    """The pack that a pattern is from, in brackets; nothing for the topmost pack."""
    try:
        level = packs.level(pattern)
    except PackError:
        return ""
    if level is None:
        return "(missing)"
    if level == len(packs.packs) - 1:
        return ""
    return f"({packs.packs[level].label if level else 'ours'})"


def _short(pattern: str) -> str:
    name = pattern.removeprefix("minecraft:")
    return name if name == pattern else f"{name} (extra)"


def _words(dye: str) -> str:
    return dye.replace("_", " ")
