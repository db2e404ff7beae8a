"""The flat face: the design as banner websites show it, on a banner and on a shield."""

from dataclasses import replace

from nicegui import ui

from drapery.studio.art import face_address
from drapery.studio.descriptions import described
from drapery.studio.selection import OTHER_KIND
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of
from drapery.studio.widgets import button, set_props, text_element


def build(session: Session) -> None:
    """The picture, which follows the design and the packs, and a small one of the other kind."""
    picture = ui.element("img").classes("face")
    switch = button("Banner or shield", session.selection.switch_kind, key="B").classes(
        "face-other"
    )
    with switch:
        other = ui.element("img").props('alt=""')
    # The change in words, for screen readers.
    announced = text_element("").classes("sr").props("role=status")

    def show_picture() -> None:
        shown = session.selection.shown_sketch
        set_props(picture, {"alt": described(session.sketch)})
        for element, kind in ((picture, shown.kind), (other, OTHER_KIND[shown.kind])):
            address = face_address(session, banner_of(replace(shown, kind=kind)))
            set_props(element, {"src": address, "data-kind": kind})

    def show() -> None:
        show_picture()
        announced.set_text(described(session.sketch))

    session.follow(show, "sketch", "packs")
    session.listen(show_picture, "preview")
