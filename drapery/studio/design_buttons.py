"""Buttons that show designs by their faces."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from nicegui import ui
from nicegui.element import Element

from drapery import Banner
from drapery.studio.art import face_address
from drapery.studio.descriptions import described
from drapery.studio.session import Session
from drapery.studio.sketch import sketch_of
from drapery.studio.widgets import KeptElements, on, set_props, text_element


class DesignButton(Element):
    """A button with the face of a design; the browser loads it when it comes into sight."""

    def __init__(
        self,
        session: Session,
        kind: str,
        banner: Banner,
        press: Callable[[], object] | None = None,
        *,
        label: str = "",
        text: str = "",
        title: str = "",
        side: int = 40,
    ) -> None:
        """Make the button.

        kind: the CSS class. press: None opens the design under its title, or the present one.
        label: for screen readers, which read it after the text; "" describes the design. text:
        shown. side: the picture's width [pixels].
        """

        def open_design() -> None:
            session.lay_out(sketch_of(banner, title or session.sketch.title))

        super().__init__("button")
        words = label or described(sketch_of(banner))
        if text:  # what is read aloud begins with what is seen
            words = f"{text}: {words}"
        self.classes(kind).props("type=button")
        self.props.update({"aria-label": words, "title": words})
        with on(self, "click", lambda _: (press or open_design)()):
            size = f"width={side} height={2 * side}"
            self._picture = ui.element("img").props(f'alt="" loading=lazy {size}')
            if text:
                text_element(text)
        self._address = partial(face_address, session, banner, 3 if side > 40 else 2)
        self.redraw()

    def redraw(self) -> None:
        """Show the face as the packs draw it now."""
        set_props(self._picture, {"src": self._address()})


class DesignList:
    """Buttons with designs; one that is still shown stays in place, see `KeptElements`."""

    def __init__(self, parent: Element) -> None:
        self._buttons: KeptElements[DesignButton] = KeptElements(parent)

    def show(self, wanted: Mapping[Any, Callable[[], DesignButton]]) -> list[DesignButton]:
        """Show buttons in this order, as the packs draw them now. wanted: as in `KeptElements`."""
        buttons = self._buttons.show(wanted)
        for each in buttons:
            each.redraw()
        return buttons
