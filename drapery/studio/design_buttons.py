"""Buttons that show designs by their faces."""

from collections.abc import Callable

from nicegui import ui
from nicegui.element import Element

from drapery import Banner
from drapery.studio.art import face_address
from drapery.studio.descriptions import described
from drapery.studio.session import Session
from drapery.studio.sketch import sketch_of
from drapery.studio.widgets import on, text_element


def design_button(
    session: Session,
    kind: str,
    banner: Banner,
    press: Callable[[], object] | None = None,
    *,
    label: str = "",
    text: str = "",
    title: str = "",
    side: int = 40,
) -> Element:
    """A button with the face of a design; the browser loads it when it comes into sight.

    kind: the CSS class. press: None opens the design under its title, or the present one. label:
    for screen readers, which read it after the text; "" describes the design. text: shown. side:
    the picture's width [pixels].
    """

    def open_design() -> None:
        session.selection.lay_out(sketch_of(banner, title or session.sketch.title))

    words = label or described(sketch_of(banner))
    if text:  # what is read aloud begins with what is seen
        words = f"{text}: {words}"
    element = ui.element("button").classes(kind).props("type=button")
    element.props.update({"aria-label": words, "title": words})
    with on(element, "click", lambda _: (press or open_design)()):
        size = f"width={side} height={2 * side}"
        picture = ui.element("img").props(f'alt="" loading=lazy {size}')
        picture.props["src"] = face_address(session, banner, 3 if side > 40 else 2)
        if text:
            text_element(text)
    return element
