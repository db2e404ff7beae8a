"""The patterns of the packs, as they would look in the chosen dyes."""

from drapery.errors import DraperyError
from drapery.studio.art import pattern_names, sheet_address
from drapery.studio.components import PatternGrid, value_of
from drapery.studio.notices import faults
from drapery.studio.selection import Selection, desk_of
from drapery.studio.session import Session
from drapery.studio.sketch import place_of
from drapery.studio.words import dye_words, pattern_words


def build(session: Session) -> None:
    """The grid; a click lays the pattern on."""
    desk = desk_of(session)
    grid = PatternGrid()

    def show() -> None:
        dye = desk.pattern_dye
        grid.show(
            sheet=sheet_address(session, dye),
            label=f"Patterns in {dye_words(dye)}",
            swaps=desk.swaps,
            canSwap=isinstance(desk.chosen, int),
            current=_current(session, desk),
        )

    def list_patterns() -> None:
        try:
            names = pattern_names(session.packs())
        except DraperyError:
            return
        grid.show(patterns=[{"name": name, "title": pattern_words(name)} for name in names])

    def press(pattern: object) -> None:
        with faults():
            desk.press_pattern(str(pattern))

    grid.on("pattern", lambda event: press(value_of(event)))
    grid.on("swaps", lambda event: desk.set_swaps(bool(value_of(event))))
    list_patterns()
    show()
    desk.listen(show)
    session.listen("packs", list_patterns)
    session.listen("packs", show)


def _current(session: Session, desk: Selection) -> str:
    if not isinstance(desk.chosen, int):
        return ""
    return session.sketch.strokes[place_of(session.sketch, desk.chosen)].pattern
