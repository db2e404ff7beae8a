"""The bar at the top: what is done to the whole design."""

import secrets
from collections.abc import Callable
from dataclasses import replace
from typing import Any, get_args

from nicegui import ui

from drapery.studio.components import value_of
from drapery.studio.notices import faults
from drapery.studio.selection import Selection, desk_of
from drapery.studio.session import Session
from drapery.studio.sketch import MAX_TITLE, Sketch, clear, random_sketch
from drapery.studio.widgets import Segments, button, words

_KINDS = {"banner": "Banner", "shield": "Shield"}
_MODES = {"survival": "Survival", "commands": "Commands"}


def build(session: Session) -> None:
    """Title, undo and redo, chance, banner or shield, survival or commands, theme, help."""
    desk = desk_of(session)
    words("Drapery Studio", "h1").classes("brand")
    _title(session)
    with ui.element("div").classes("bar-group"):
        undo = button("Undo", session.undo, icon="undo", key="Ctrl+Z")
        redo = button("Redo", session.redo, icon="redo", key="Ctrl+Shift+Z")
    with ui.element("div").classes("bar-group bar-design"):
        button("A design by chance", lambda: chance(session), icon="casino", key="R")
        button(
            "Remove all layers", lambda: session.edit(clear(session.sketch)), icon="layers_clear"
        )
    kind = Segments("What bears the design", _KINDS, lambda name: set_kind(session, name))
    mode = Segments("Layers allowed", _MODES, lambda name: set_mode(session, name))
    ui.element("div").classes("gap")
    button("Light or dark", lambda: None, icon="contrast").classes("theme")
    button("Keyboard shortcuts", lambda: None, icon="keyboard", key="?").classes("help")

    def show() -> None:
        for element, there in ((undo, session.history.past), (redo, session.history.future)):
            element.props["disabled"] = not there
            element.update()
        kind.show(session.sketch.kind)
        mode.show("survival" if session.survival else "commands")

    show()
    desk.listen(show)


def _title(session: Session) -> None:
    field = ui.element("input").classes("field title")
    field.props(f'placeholder="Untitled" aria-label="Title of the design" maxlength={MAX_TITLE}')

    def show() -> None:
        if field.props.get("value") != session.sketch.title:
            field.props["value"] = session.sketch.title
            field.update()

    def name(title: Any) -> None:
        field.props["value"] = str(title)[:MAX_TITLE]
        session.edit(replace(session.sketch, title=field.props["value"]))

    field.on(
        "change", lambda event: name(value_of(event)), js_handler="(e) => emit(e.target.value)"
    )
    show()
    session.listen("sketch", show)


def chance(session: Session) -> None:
    """Another design by chance, of the same kind."""
    sketch = random_sketch(secrets.randbits(32))
    desk_of(session).lay_out(replace(sketch, kind=session.sketch.kind))


def set_kind(session: Session, name: str) -> None:
    """Put the design on a banner or a shield."""
    for kind in get_args(Sketch.__annotations__["kind"]):
        if kind == name:
            if kind == "shield" and session.settings.placement == "wall":
                session.adjust(placement="standing", facing=None)
            session.edit(replace(session.sketch, kind=kind))


def set_mode(session: Session, name: str) -> None:
    """Warn of more layers than the loom makes, or not."""
    session.survival = name == "survival"
    desk_of(session).choose_again()


def act(session: Session, desk: Selection, what: str) -> None:
    """Do what a shortcut of `studio.js` asks for."""
    deeds: dict[str, Callable[[], object]] = {
        "undo": session.undo,
        "redo": session.redo,
        "chance": lambda: chance(session),
        "kind": lambda: set_kind(
            session, "banner" if session.sketch.kind == "shield" else "shield"
        ),
        "mode": lambda: set_mode(session, "commands" if session.survival else "survival"),
        "up": lambda: desk.act_on_chosen("move", 1),
        "down": lambda: desk.act_on_chosen("move", -1),
        "hide": lambda: desk.act_on_chosen("hide"),
        "duplicate": lambda: desk.act_on_chosen("duplicate"),
        "remove": lambda: desk.act_on_chosen("remove"),
        "none": lambda: desk.choose(None),
    }
    with faults():
        if what in deeds:
            deeds[what]()
