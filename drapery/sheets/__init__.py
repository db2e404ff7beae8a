"""Sheets of many labelled pictures: patterns, rotations, packs, styles, garments, loom steps.

Each function makes a `PictureSheet`, which is saved as a picture or as a page of HTML;
`draw_sprites` makes the loops of a game's sprite sheet. Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.sheets.drawn import (
        garments_sheet as garments_sheet,
        packs_sheet as packs_sheet,
        players_sheet as players_sheet,
        rotations_sheet as rotations_sheet,
        styles_sheet as styles_sheet,
    )
    from drapery.sheets.faces import (
        contents_sheet as contents_sheet,
        patterns_sheet as patterns_sheet,
        steps_sheet as steps_sheet,
    )
    from drapery.sheets.letters import cloth_row as cloth_row, faces_row as faces_row
    from drapery.sheets.sheet import PictureSheet as PictureSheet, SheetCell as SheetCell
    from drapery.sheets.sprites import draw_sprites as draw_sprites
else:
    import_lazily(__name__)
