"""Links and lines of HTML that show the design on other pages."""

from dataclasses import replace

from nicegui import ui

from drapery.studio.embeds import (
    EmbedPlaces,
    component_tag,
    frame_tag,
    page_link,
    picture_address,
    picture_tag,
)
from drapery.studio.panels.fields import Fields, copy_field
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of
from drapery.studio.widgets import hint, translated_text

MAX_ADDRESS = 300
"""The most characters of an address that the user gives."""


def build(session: Session) -> None:
    """Where the user's page and server are, and what to copy."""
    places = EmbedPlaces()
    fields = Fields(session)

    def field(label: str, name: str) -> None:
        def change(text: object) -> None:
            nonlocal places
            default = getattr(EmbedPlaces(), name)
            places = replace(places, **{name: str(text).strip()[:MAX_ADDRESS] or default})
            show()

        fields.line(label, lambda: getattr(places, name), change, maxlength=MAX_ADDRESS)

    translated_text("Without a server", "h2").classes("heading")
    hint(
        "Export a web page once and put it anywhere. Its address followed by # and a design shows"
        " that design."
    )
    with ui.element("div").classes("options"):
        field("Your page", "page")
    link = copy_field("embed-link", "Link to the design on your page", 2)
    frame = copy_field("embed-frame", "Your page within another page", 3)
    translated_text("As a component", "h2").classes("heading")
    with ui.element("div").classes("options"):
        field("Folder of drapery web --component", "package")
    component = copy_field("embed-component", "Live banner for your page", 4)
    translated_text("As a picture", "h2").classes("heading")
    with ui.element("div").classes("options"):
        field("Address of drapery serve", "server")
    address = copy_field("embed-address", "Address of the picture", 2)
    picture = copy_field("embed-picture", "Picture for your page", 3)

    def show() -> None:
        banner, settings = banner_of(session.sketch), session.settings
        link(page_link(places, banner))
        frame(frame_tag(places, banner))
        component(component_tag(places, banner, settings))
        address(picture_address(places, banner, settings))
        picture(picture_tag(places, banner, settings))

    session.follow(show, "sketch", "settings")
