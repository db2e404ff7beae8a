"""Sheets of drawn pictures: all rotations of one thing, one design over many packs."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from drapery.banner.design import Banner
from drapery.pictures import draw_face, draw_rotations, draw_with
from drapery.settings import Settings
from drapery.sheets.sheet import Cell, Sheet

COMPASS = {0: "south", 4: "west", 8: "north", 12: "east"}


def rotations_sheet(design: Banner | None, settings: Settings) -> Sheet:
    """All sixteen rotations, by one camera. Raises OptionError, PackError or BackendError."""
    cells = tuple(
        Cell(f"{number} {COMPASS.get(number, '')}".rstrip(), frame.pixels)
        for number, frame in enumerate(draw_rotations(design, settings))
    )
    return Sheet("Sixteen rotations", cells, 8)


def packs_sheet(
    banner: Banner, paths: Sequence[str | Path], settings: Settings, *, scale: int | None = None
) -> Sheet:
    """One design over our own art, and over each pack alone, drawn by the settings.

    scale: shows plain faces instead, each texel of a 64 x 64 pack so many pixels wide.
    Raises OptionError, PackError or BackendError.
    """
    stacks: list[tuple[str, tuple[str | Path, ...]]] = [("our own art", ())]
    stacks += [(Path(path).name or str(path), (path,)) for path in paths]
    cells = []
    for name, packs in stacks:
        if scale is None:
            frame = draw_with(banner, replace(settings, packs=packs))
        else:
            frame = draw_face(banner, packs=packs, format=settings.format, scale=scale)
        cells.append(Cell(name, frame.pixels))
    return Sheet("One design over many packs", tuple(cells), min(len(cells), 6))
