"""The bar at the top: actions on the whole design."""

import secrets
from collections.abc import Callable
from dataclasses import replace

from nicegui import ui

from drapery.studio.form_field import FormField
from drapery.studio.session import Session
from drapery.studio.sketch import MAX_TITLE, Sketch, clear, random_sketch
from drapery.studio.translation import translated
from drapery.studio.widgets import SegmentedControl, button, set_props, text_element

_KINDS = {"banner": "Banner", "shield": "Shield"}
_MODES = {"survival": "Survival", "commands": "Commands"}


def build(session: Session) -> None:
    """Title, undo, redo, random design, banner or shield, survival or commands, theme, help."""
    text_element("Drapery Studio", "h1").classes("brand")
    _title(session)
    with ui.element("div").classes("bar-group"):
        undo = button("Undo", session.undo, icon="undo", key="Ctrl+Z")
        redo = button("Redo", session.redo, icon="redo", key="Ctrl+Shift+Z")
    with ui.element("div").classes("bar-group bar-design"):
        button("New banner", lambda: start_anew(session), icon="add", key="N")
        button("Random design", lambda: randomise(session), icon="casino", key="R")
        button(
            "Remove all layers", lambda: session.edit(clear(session.sketch)), icon="layers_clear"
        )

    def choose_kind(name: str) -> None:
        if name != session.sketch.kind:
            session.selection.switch_kind()

    kind = SegmentedControl("Banner or shield", _KINDS, choose_kind)
    mode = SegmentedControl("Layers allowed", _MODES, lambda name: set_mode(session, name))
    ui.element("div").classes("gap")
    button("Light or dark", icon="contrast").classes("theme")
    button("Keyboard shortcuts", icon="keyboard", key="?").classes("help")

    def show() -> None:
        for element, there in ((undo, session.history.past), (redo, session.history.future)):
            set_props(element, {"disabled": not there})
        kind.show(session.sketch.kind)
        mode.show("survival" if session.survival else "commands")

    session.follow(show, "selection")


def _title(session: Session) -> None:
    field = FormField("text", lambda: session.sketch.title, session.name).classes("field title")
    title, untitled = translated("Title of the design"), translated("Untitled")
    field.props.update({"placeholder": untitled, "aria-label": title, "maxlength": MAX_TITLE})
    session.listen(field.refresh, "sketch")


def start_anew(session: Session) -> None:
    """Begin with a plain banner or shield, whose field the next dye is for; Undo brings the design
    back."""
    session.selection.lay_out(Sketch(kind=session.sketch.kind), chosen="field")


def randomise(session: Session) -> None:
    """Replace the design by a random one of the same kind."""
    sketch = random_sketch(secrets.randbits(32))
    session.selection.lay_out(replace(sketch, kind=session.sketch.kind))


def set_mode(session: Session, name: str) -> None:
    """Choose whether to warn of more layers than a loom can make."""
    session.survival = name == "survival"
    session.selection.notify()


def act(session: Session, what: str) -> None:
    """Perform the action of a keyboard shortcut from `studio.js`."""
    selection = session.selection
    actions: dict[str, Callable[[], object]] = {
        "undo": session.undo,
        "redo": session.redo,
        "new": lambda: start_anew(session),
        "random": lambda: randomise(session),
        "kind": selection.switch_kind,
        "mode": lambda: set_mode(session, "commands" if session.survival else "survival"),
        "up": lambda: selection.act_on_chosen("move", 1),
        "down": lambda: selection.act_on_chosen("move", -1),
        "hide": lambda: selection.act_on_chosen("hide"),
        "duplicate": lambda: selection.act_on_chosen("duplicate"),
        "remove": lambda: selection.act_on_chosen("remove"),
        "none": lambda: selection.choose(None),
    }
    if what in actions:
        actions[what]()
