"""Two designs, one over the other, with a slider between them."""

from functools import partial

from nicegui import ui

from drapery.studio.art import face_address
from drapery.studio.descriptions import described
from drapery.studio.notices import errors_shown
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.sketch import Sketch, banner_of
from drapery.studio.translation import translated
from drapery.studio.widgets import KeptElements, VersusSlider, button, hint, translated_text


def build(session: Session) -> None:
    """The choice of the other design, among those of the history, and the slider."""
    kept: Sketch | None = None
    translated_text("Compare designs", "h2").classes("heading")
    hint(
        "Keep the design as it is now, or choose an earlier one. Then edit, or open another design:"
        " the slider shows both."
    )

    def states() -> dict[str, Sketch]:
        """The latest designs of the tab by their names in the list, and the kept one."""
        found = {str(place): each for place, each in enumerate(session.states)}
        return found if kept is None or kept in found.values() else {"kept": kept, **found}

    def choices() -> dict[str, str]:
        nothing = {"": translated("nothing")}
        return nothing | {name: _title(name, each) for name, each in states().items()}

    def current() -> str:
        return next((name for name, each in states().items() if each == kept), "")

    def choose(name: object) -> None:
        nonlocal kept
        kept = states().get(str(name))
        show()

    def keep() -> None:
        nonlocal kept
        kept = session.sketch
        show()

    def face(sketch: Sketch) -> str:
        return face_address(session, banner_of(sketch))

    def slider_to(other: Sketch) -> VersusSlider:
        return VersusSlider(described(other))

    with ui.element("div").classes("line"):
        button("Keep this design to compare with", keep, icon="pin", text="Keep this design")
    field = Fields(session).choice("Compare with", {}, current, choose)
    sliders: KeptElements[VersusSlider] = KeptElements(ui.element("div"))

    def show() -> None:
        field.set_choices(choices())
        with errors_shown():
            others = [] if kept is None else [kept]
            for slider in sliders.show({each: partial(slider_to, each) for each in others}):
                slider.show(face(session.sketch), face(others[0]))

    session.follow(show, "sketch", "packs")


def _title(name: str, sketch: Sketch) -> str:
    words = sketch.title or described(sketch)
    return f"{int(name) + 1}: {words}" if name.isdigit() else words
