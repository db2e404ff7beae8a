"""The patterns of the packs in the chosen dyes."""

from drapery import DraperyError
from drapery.studio.art import pattern_names, sheet_address
from drapery.studio.components import PatternGrid
from drapery.studio.descriptions import dye_title, pattern_title
from drapery.studio.panels.start import build_examples
from drapery.studio.session import Session
from drapery.studio.sketch import place_of
from drapery.studio.translation import translated
from drapery.studio.widgets import on, set_props
from drapery.web.pattern_words import search_words


def build(session: Session) -> None:
    """The grid; a click adds the pattern as a layer."""
    build_examples(session)
    grid = PatternGrid()

    def show() -> None:
        dye = session.selection.pattern_dye
        shown = {
            "sheet": sheet_address(session, dye),
            "label": translated("Patterns in {dye}").format(dye=dye_title(dye)),
            "swaps": session.selection.swaps,
            "canSwap": isinstance(session.selection.chosen, int),
            "current": _current(session),
        }
        set_props(grid, shown)

    def list_patterns() -> None:
        try:
            names = pattern_names(session.packs())
        except DraperyError:  # the live cloth says why
            return
        words = search_words()
        found = [
            {"name": name, "title": pattern_title(name), "words": words.get(name, name)}
            for name in names
        ]
        set_props(grid, {"patterns": found})

    grid.props["words"] = {key: translated(text) for key, text in _WORDS.items()}
    on(grid, "pattern", lambda pattern: session.selection.press_pattern(str(pattern)))
    on(grid, "preview", lambda pattern: session.selection.preview(str(pattern)))
    on(grid, "swaps", lambda swaps: session.selection.set_swaps(bool(swaps)))
    session.follow(list_patterns, "packs")
    session.follow(show, "selection", "packs")


_WORDS = {
    "find": "Find a pattern",
    "count": "Patterns: {count}",
    "add": "New layer",
    "change": "Change layer",
    "what": "What a pattern does",
    "nothing": "No pattern is called that. Try another word, such as stripe or corner.",
}
"""The texts of the grid itself."""


def _current(session: Session) -> str:
    if not isinstance(session.selection.chosen, int):
        return ""
    return session.sketch.strokes[place_of(session.sketch, session.selection.chosen)].pattern
