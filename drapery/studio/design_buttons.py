"""Buttons that show designs by their faces, which the page's editor draws."""

from collections.abc import Callable

from nicegui import ui
from nicegui.element import Element

from drapery import Banner
from drapery.banner import write_banner
from drapery.studio.session import Session
from drapery.studio.sketch import sketch_of
from drapery.studio.widgets import on, text_element


class DesignButton(Element):
    """A button with the face of a design; the editor adds its description to its name."""

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
        label: for screen readers, between the text and the description. text: shown. side: the
        picture's width [pixels].
        """

        def open_design() -> None:
            session.lay_out(sketch_of(banner, title or session.sketch.title))

        super().__init__("button")
        self.classes(kind).props("type=button")
        with on(self, "click", lambda _: (press or open_design)()):
            face = ui.element("canvas").style(f"width: {side}px; height: {2 * side}px")
            # What is read aloud begins with what is seen.
            words = ": ".join(filter(None, (text, label)))
            design = write_banner(banner, "shorthand")
            face.props.update({"data-face": design, "data-label": words, "aria-hidden": "true"})
            if text:
                text_element(text)
