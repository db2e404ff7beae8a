"""What lies ready to hand while one designs: which part is chosen, and the dye for the next."""

from collections.abc import Callable
from typing import Literal

from drapery.banner.dyes import DYES
from drapery.studio import sketch as edits
from drapery.studio.session import Session
from drapery.studio.sketch import Sketch

Chosen = int | Literal["field"] | None
"""A stroke's number, the field beneath all, or nothing: then dyes are for the next layer."""


class Selection:
    """The hand that designs: its clicks become edits of the session's sketch.

    All methods that edit raise DesignError where the edit cannot be.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._listeners: list[Callable[[], None]] = []
        self.chosen: Chosen = "field"
        self.dye = "black"
        self.swaps = False
        session.listen("sketch", self._forget_what_is_gone)

    @property
    def shown_dye(self) -> str:
        """The dye that the palette marks: of what is chosen, or for the next layer."""
        sketch = self._session.sketch
        if self.chosen == "field":
            return sketch.base
        if self.chosen is None:
            return self.dye
        return sketch.strokes[edits.place_of(sketch, self.chosen)].dye

    @property
    def pattern_dye(self) -> str:
        """The dye in which patterns would be laid on: never that of what is only the field."""
        return self.dye if self.chosen == "field" else self.shown_dye

    def listen(self, call: Callable[[], None]) -> None:
        """Call this whenever what is chosen changes, the design with it or not."""
        self._listeners.append(call)

    def choose(self, chosen: Chosen) -> None:
        """Turn to the field, a stroke or, with None, to the next layer; twice lets it go."""
        self.chosen = None if chosen == self.chosen else chosen
        if self.chosen is None:
            self.swaps = False
        self._tell()

    def choose_again(self) -> None:
        """Tell those who listen, though nothing is chosen anew."""
        self._tell()

    def press_dye(self, dye: str) -> None:
        """Dye what is chosen, and keep the dye for the next layer unless it is the field's."""
        if dye not in DYES:
            return
        if self.chosen == "field":
            self._edit(edits.dye_field(self._session.sketch, dye))
            return
        self.dye = dye
        if self.chosen is not None:
            self._edit(edits.recolour(self._session.sketch, self.chosen, dye))
        self._tell()

    def press_pattern(self, pattern: str) -> None:
        """Lay a pattern on in the dye at hand; or change the chosen layer's, if it swaps."""
        sketch = self._session.sketch
        if self.swaps and isinstance(self.chosen, int):
            self._edit(edits.repattern(sketch, self.chosen, pattern))
            return
        added = edits.add(sketch, pattern, self.pattern_dye)
        self.dye, self.chosen, self.swaps = self.pattern_dye, None, False
        self._edit(added)
        self._tell()

    def set_swaps(self, swaps: bool) -> None:
        """Whether a pattern that is pressed replaces the chosen layer's."""
        self.swaps = swaps
        self._tell()

    def act(self, what: str, number: int, place: int = 0) -> None:
        """Move, hide, duplicate or remove a stroke."""
        sketch = self._session.sketch
        if what == "move":
            self._edit(edits.move(sketch, number, place))
        elif what == "hide":
            self._edit(edits.hide(sketch, number))
        elif what == "duplicate":
            self._edit(edits.duplicate(sketch, number))
        elif what == "remove":
            self._edit(edits.remove(sketch, number))

    def act_on_chosen(self, what: str, step: int = 0) -> None:
        """The same for the stroke that is chosen, if one is; `step` is upwards."""
        if isinstance(self.chosen, int):
            place = edits.place_of(self._session.sketch, self.chosen)
            self.act(what, self.chosen, place + step)

    def lay_out(self, sketch: Sketch) -> None:
        """Begin to work on another design, which can be undone."""
        self.chosen, self.swaps = None, False
        self._edit(sketch)
        self._tell()

    def _edit(self, sketch: Sketch) -> None:
        self._session.edit(sketch)

    def _forget_what_is_gone(self) -> None:
        numbers = {stroke.number for stroke in self._session.sketch.strokes}
        if isinstance(self.chosen, int) and self.chosen not in numbers:
            self.chosen, self.swaps = None, False
        self._tell()

    def _tell(self) -> None:
        for call in self._listeners:
            call()


_DESKS: dict[str, Selection] = {}


def desk_of(session: Session) -> Selection:
    """The desk of a session, cleared away with it."""
    if session.token not in _DESKS:
        _DESKS[session.token] = Selection(session)
        session.on_close(lambda: _DESKS.pop(session.token, None))
    return _DESKS[session.token]
