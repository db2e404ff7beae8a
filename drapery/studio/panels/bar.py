"""The bar at the top: what is done to the whole design."""

from nicegui import ui

from drapery.studio.session import Session


def build(session: Session) -> None:
    """The title."""
    ui.element("h1").classes("brand").add_slot("default", "Drapery Studio")
