"""The layers in their order, with the actions on each."""

from nicegui import ui

from drapery.banner import PATTERNS
from drapery.studio.components import editor_part
from drapery.studio.session import Session
from drapery.studio.translation import translated


def build(session: Session) -> None:
    """The editor's list, and a warning of patterns that are missing."""
    warning = ui.label().classes("warning").props('role="status"')
    editor_part("layers")

    def show() -> None:
        lines = missing_patterns(session)
        warning.set_text(" ".join(lines))
        warning.set_visibility(bool(lines))

    session.follow(show, "sketch", "packs")


def missing_patterns(session: Session) -> list[str]:
    """A line for each pattern of the design that no pack has."""
    packs = session.packs()
    added = {each.pattern for each in session.sketch.strokes if each.pattern not in PATTERNS}
    return [
        translated(f"{name} is in none of the packs: the game shows a checker. Add its pack.")
        for name in sorted(added)
        if packs.level(name) is None
    ]
