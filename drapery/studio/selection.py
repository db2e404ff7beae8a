"""What is chosen in the editor: a part of the design, and the dye for the next layer."""

import secrets
from contextlib import suppress
from dataclasses import replace
from typing import Literal

from drapery import DesignError
from drapery.banner import DYES
from drapery.studio import sketch as edits
from drapery.studio.descriptions import MIDDLE_LUMINANCE, luminance
from drapery.studio.document import Document
from drapery.studio.sketch import Sketch

Kind = Literal["banner", "shield"]
Chosen = int | Literal["field"] | None
"""A stroke's number, the field, or None; with None, a dye applies to the next layer."""

OTHER_KIND: dict[Kind, Kind] = {"banner": "shield", "shield": "banner"}


def visible_on(field: str, dye: str) -> str:
    """The dye, or black or white if the field has the same: whichever contrasts more with it."""
    if dye != field:
        return dye
    return "white" if luminance(DYES[field]) < MIDDLE_LUMINANCE else "black"


class Selection:
    """What is chosen in a document; clicks become edits of its sketch.

    All methods that edit raise DesignError for an edit that is not possible.
    """

    def __init__(self, document: Document) -> None:
        self._document = document
        self.chosen: Chosen = "field"
        self._base = document.sketch.base
        self.dye = visible_on(self._base, "black")
        self.swaps = False
        self.previewed = ""
        document.listen(self._follow, "sketch")

    @property
    def shown_dye(self) -> str:
        """The dye that the palette marks: that of the chosen part, or that for the next layer."""
        sketch = self._document.sketch
        if self.chosen == "field":
            return sketch.base
        if self.chosen is None:
            return self.dye
        return sketch.strokes[edits.place_of(sketch, self.chosen)].dye

    @property
    def pattern_dye(self) -> str:
        """The dye in which a pattern would be added, or replace that of the chosen layer."""
        if not isinstance(self.chosen, int):
            return self.dye
        return self.shown_dye if self.swaps else visible_on(self._base, self.shown_dye)

    def choose(self, chosen: Chosen) -> None:
        """Choose the field, a stroke or, with None, the next layer; choosing it again clears it."""
        self.chosen = None if chosen == self.chosen else chosen
        if self.chosen is None:
            self.swaps = False
        self.notify()

    def switch_kind(self) -> None:
        """Put the design on a shield, or on a banner again; a shield is not on a wall."""
        document = self._document
        kind = OTHER_KIND[document.sketch.kind]
        if kind == "shield" and document.settings.placement == "wall":
            document.adjust(placement="standing", facing=None)
        self._edit(replace(document.sketch, kind=kind))

    def press_dye(self, dye: str) -> None:
        """Dye what is chosen; a layer's dye is also that of the next layer."""
        if dye not in DYES:
            return
        if self.chosen == "field":
            self._edit(edits.dye_field(self._document.sketch, dye))
            return
        self.dye = dye
        if self.chosen is not None:
            self._edit(edits.recolour(self._document.sketch, self.chosen, dye))
        self.notify()

    def press_pattern(self, pattern: str) -> None:
        """Add a pattern in the current dye; with `swaps`, replace the chosen layer's pattern.

        A new layer is chosen, so that a click on a dye changes it.
        """
        edited = self._with_pattern(pattern)
        self.previewed = ""
        if not self._replaces():
            self.dye = self.pattern_dye
            # The choice comes before the edit, so that no listener sees the new design without it.
            self.chosen = edited.strokes[-1].number
        self._edit(edited)

    def preview(self, pattern: str) -> None:
        """Show the design as a click on this pattern would make it; with "" as it is."""
        if pattern != self.previewed:
            self.previewed = pattern
            self._document.notify("preview")

    @property
    def shown_sketch(self) -> Sketch:
        """The design, with the pattern that is previewed."""
        with suppress(DesignError):  # there may be too many layers
            if self.previewed:
                return self._with_pattern(self.previewed)
        return self._document.sketch

    def _replaces(self) -> bool:
        return self.swaps and isinstance(self.chosen, int)

    def _with_pattern(self, pattern: str) -> Sketch:
        sketch = self._document.sketch
        if self.swaps and isinstance(self.chosen, int):
            return edits.repattern(sketch, self.chosen, pattern)
        return edits.add(sketch, pattern, self.pattern_dye)

    def set_swaps(self, swaps: bool) -> None:
        """Choose whether a click on a pattern replaces the chosen layer's."""
        self.swaps = swaps
        self.notify()

    def act(self, what: str, number: int, place: int = 0) -> None:
        """Move, hide, duplicate or remove a stroke."""
        sketch = self._document.sketch
        if what == "move":
            self._edit(edits.move(sketch, number, place))
        elif what in ("hide", "duplicate", "remove"):
            self._edit(getattr(edits, what)(sketch, number))

    def act_on_chosen(self, what: str, step: int = 0) -> None:
        """Call `act` for the chosen stroke, if there is one. step: the number of places upwards."""
        if isinstance(self.chosen, int):
            place = edits.place_of(self._document.sketch, self.chosen)
            self.act(what, self.chosen, place + step)

    def lay_out(self, sketch: Sketch, *, same: bool = False, chosen: Chosen = None) -> None:
        """Replace the design; this can be undone.

        same: whether it is still the same design, such as after layers without effect are removed.
        chosen: what a dye applies to then.
        """
        self.chosen, self.swaps = chosen, False
        origin = self._document.sketch.origin if same else secrets.randbits(48)
        self._edit(replace(sketch, origin=origin))
        self.notify()

    def _edit(self, sketch: Sketch) -> None:
        self._document.edit(sketch)

    def _follow(self) -> None:
        """Drop the choice of a removed stroke; keep the next layer visible on a new field."""
        base = self._document.sketch.base
        if base != self._base:
            self._base, self.dye = base, visible_on(base, self.dye)
        numbers = {stroke.number for stroke in self._document.sketch.strokes}
        if isinstance(self.chosen, int) and self.chosen not in numbers:
            self.chosen, self.swaps = None, False
        self.notify()

    def notify(self) -> None:
        """Say that the choice may have changed, even if the design has stayed the same."""
        self._document.notify("selection")
