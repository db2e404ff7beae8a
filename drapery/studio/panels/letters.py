"""Words as rows of banners: write, look, and open a letter as the design."""

from functools import partial
from typing import Any

from nicegui import ui

from drapery.banner import DYE_NAMES, letter_banners, write_banner
from drapery.studio.descriptions import dye_title
from drapery.studio.design_buttons import DesignButton
from drapery.studio.panels.fields import Fields, copy_field
from drapery.studio.session import Session
from drapery.studio.translation import translated
from drapery.studio.widgets import KeptElements, translated_text

MAX_WORD = 40
"""The most characters of a word on the page."""


def build(session: Session) -> None:
    """Fields for the word and its dyes, the row of letters, and the commands that give them."""
    # Without a border of its own a letter has the ground's.
    chosen: dict[str, Any] = {"text": "HELLO", "ink": "black", "ground": "white", "border": None}
    fields = Fields(session)
    dyes = {name: dye_title(name) for name in DYE_NAMES}
    borders = {"": "Like the ground", "none": "None", **dyes}

    def change(**changes: Any) -> None:
        letter_banners(**chosen | changes)  # it checks them
        chosen.update(changes)
        show()

    def word(text: str) -> None:
        change(text=text[:MAX_WORD])

    def border(dye: str) -> None:
        change(border=dye or None)

    translated_text("Letters", "h2").classes("heading")
    with ui.element("div").classes("options"):
        fields.line("Word", lambda: chosen["text"], word, maxlength=MAX_WORD)
        fields.choice("Ink", dyes, lambda: chosen["ink"], lambda dye: change(ink=dye))
        fields.choice("Ground", dyes, lambda: chosen["ground"], lambda dye: change(ground=dye))
        fields.choice("Border", borders, lambda: chosen["border"] or "", border)
    row = ui.element("div").classes("letters").props("role=group")
    row.props["aria-label"] = translated("Letters")
    letters: KeptElements[DesignButton] = KeptElements(row)
    written = copy_field("letters-text", "The commands of the letters", 4)

    def show() -> None:
        banners = letter_banners(**chosen)
        letters.show(
            {
                (place, banner): partial(DesignButton, session, "found", banner, side=30)
                for place, banner in enumerate(banners)
            }
        )
        written("\n".join(write_banner(banner, "give") for banner in banners))

    show()
