"""The bar at the top: actions on the whole design."""

from nicegui import ui

from drapery.studio.components import DesignerElement, editor_part
from drapery.studio.session import Session
from drapery.studio.widgets import button, text_element


def build(session: Session) -> None:
    """The editor's title and tools, theme, help; the editor itself has its parts in all panels."""
    text_element("Drapery Studio", "h1").classes("brand")
    editor_part("tools")
    ui.element("div").classes("grow")
    button("Light or dark", icon="contrast").classes("theme")
    button("Keyboard shortcuts", icon="keyboard", key="?").classes("help")
    DesignerElement(session)
