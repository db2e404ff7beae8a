"""Sheets of many labelled pictures: patterns, rotations, packs, styles, garments, loom steps.

Each function makes a `PictureSheet`, which is saved as a picture or as a page of HTML. Names are
loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.sheets.drawn import (
        garments_sheet,
        packs_sheet,
        players_sheet,
        rotations_sheet,
        styles_sheet,
    )
    from drapery.sheets.faces import contents_sheet, patterns_sheet, steps_sheet
    from drapery.sheets.letters import cloth_row, faces_row
    from drapery.sheets.sheet import PictureSheet, SheetCell

__all__ = [
    "PictureSheet",
    "SheetCell",
    "cloth_row",
    "contents_sheet",
    "faces_row",
    "garments_sheet",
    "packs_sheet",
    "patterns_sheet",
    "players_sheet",
    "rotations_sheet",
    "steps_sheet",
    "styles_sheet",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "sheets.drawn": (
            "garments_sheet",
            "packs_sheet",
            "players_sheet",
            "rotations_sheet",
            "styles_sheet",
        ),
        "sheets.faces": ("contents_sheet", "patterns_sheet", "steps_sheet"),
        "sheets.letters": ("cloth_row", "faces_row"),
        "sheets.sheet": ("PictureSheet", "SheetCell"),
    },
)
