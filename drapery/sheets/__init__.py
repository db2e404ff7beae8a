"""Sheets of many labelled pictures: patterns, rotations, packs, the loom's steps.

Each function makes a `PictureSheet`, which is saved as a picture or as a page of HTML. Names are
loaded when they are first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from drapery.sheets.drawn import packs_sheet, rotations_sheet
    from drapery.sheets.faces import contents_sheet, patterns_sheet, steps_sheet
    from drapery.sheets.sheet import PictureSheet, SheetCell, check_sheet_target

__all__ = [
    "PictureSheet",
    "SheetCell",
    "check_sheet_target",
    "contents_sheet",
    "packs_sheet",
    "patterns_sheet",
    "rotations_sheet",
    "steps_sheet",
]

_NAMES = {
    "drapery.sheets.drawn": (
        "packs_sheet",
        "rotations_sheet",
    ),
    "drapery.sheets.faces": (
        "contents_sheet",
        "patterns_sheet",
        "steps_sheet",
    ),
    "drapery.sheets.sheet": (
        "PictureSheet",
        "SheetCell",
        "check_sheet_target",
    ),
}
_MODULE_OF = {name: module for module, names in _NAMES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'drapery.sheets' has no attribute {name!r}")
    value = getattr(import_module(_MODULE_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
