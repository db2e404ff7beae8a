"""The layers in their order, with the actions on each."""

from typing import Any

from nicegui import ui

from drapery.banner import DYES, LOOM_LAYERS, MAX_LAYERS, PATTERNS
from drapery.studio.art import pattern_names, sheet_address
from drapery.studio.components import LayerList
from drapery.studio.descriptions import dye_colour, dye_title, layer_title, pattern_title
from drapery.studio.session import Session
from drapery.studio.sketch import Stroke
from drapery.studio.translation import translated
from drapery.studio.widgets import on, set_props, translated_text


def build(session: Session) -> None:
    """The list with its count, and warnings: too many layers for a loom, or a missing pattern."""
    with ui.element("div").classes("heading-line"):
        translated_text("Layers", "h2").classes("heading")
        count = ui.label().classes("count")
    warning = ui.label().classes("warning").props('role="status"')
    rows = LayerList().classes("rows-holder")

    def show() -> None:
        shown = sum(not stroke.hidden for stroke in session.sketch.strokes)
        most = LOOM_LAYERS if session.survival else MAX_LAYERS
        count.set_text(translated("{count} of {most}").format(count=shown, most=most))
        too_many = session.survival and shown > LOOM_LAYERS
        count.classes(add="over" if too_many else "", remove="" if too_many else "over")
        lines = [translated(_TOO_MANY)] * too_many + missing_patterns(session)
        warning.set_text(" ".join(lines))
        warning.set_visibility(bool(lines))
        set_props(rows, _shown(session))

    def act(event: Any) -> None:
        what, number = str(event["what"]), int(event["number"])
        session.selection.act(what, number, int(event.get("place", 0)))

    def choose(chosen: Any) -> None:
        session.selection.choose("field" if chosen == "field" else int(chosen))

    on(rows, "act", act)
    on(rows, "choose", choose)
    session.follow(show, "selection", "packs")


_TOO_MANY = f"A loom makes at most {LOOM_LAYERS} layers. This needs a command."


_WORDS = {
    "field": "Field",
    "empty": "Choose the field's dye, then click a pattern to add it.",
    "layers": "Layers, topmost first",
    "hide": "Hide",
    "show": "Show",
    "duplicate": "Duplicate",
    "remove": "Remove",
}
"""The texts of the list itself."""


def missing_patterns(session: Session) -> list[str]:
    """A line for each pattern of the design that no pack has."""
    packs = session.packs()
    added = {each.pattern for each in session.sketch.strokes if each.pattern not in PATTERNS}
    return [
        translated(f"{name} is in none of the packs: the game shows a checker. Add its pack.")
        for name in sorted(added)
        if packs.level(name) is None
    ]


def _shown(session: Session) -> dict[str, Any]:
    sketch = session.sketch
    names = pattern_names(session.packs())
    rows = [_row(session, names, place, each) for place, each in enumerate(sketch.strokes)]
    field = {"dyeTitle": dye_title(sketch.base), "colour": dye_colour(DYES[sketch.base])}
    return {
        "rows": rows[::-1],
        "field": field,
        "chosen": session.selection.chosen,
        "count": len(names),
        "words": {key: translated(text) for key, text in _WORDS.items()},
    }


def _row(session: Session, names: tuple[str, ...], place: int, stroke: Stroke) -> dict[str, Any]:
    return {
        "number": stroke.number,
        "place": place,
        "index": names.index(stroke.pattern) if stroke.pattern in names else 0,
        "title": pattern_title(stroke.pattern),
        "name": layer_title(place + 1, stroke.dye, stroke.pattern),
        "dyeTitle": dye_title(stroke.dye),
        "colour": dye_colour(DYES[stroke.dye]),
        "sheet": sheet_address(session, stroke.dye),
        "hidden": stroke.hidden,
    }
