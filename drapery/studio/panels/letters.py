"""Words as rows of banners: write, look, and open a letter as the design."""

from dataclasses import dataclass, replace
from typing import Any

from nicegui import ui

from drapery import Banner, DraperyError
from drapery.banner import DYE_NAMES, letter_banners, write_banner
from drapery.studio.descriptions import dye_title
from drapery.studio.design_buttons import design_button
from drapery.studio.panels.fields import Fields, copy_field
from drapery.studio.session import Session
from drapery.studio.translation import translated
from drapery.studio.widgets import translated_text

MAX_WORD = 40
"""The most characters of a word on the page."""


@dataclass(frozen=True)
class LetterChoice:
    """The word and its dyes; border None is the ground's."""

    text: str = "HELLO"
    ink: str = "black"
    ground: str = "white"
    border: str | None = None

    def banners(self) -> tuple[Banner, ...]:
        """The banners. Raises DesignError."""
        return letter_banners(
            self.text[:MAX_WORD], ink=self.ink, ground=self.ground, border=self.border
        )


def build(session: Session) -> None:
    """Fields for the word and its dyes, the row of letters, and the commands that give them."""
    chosen = LetterChoice()
    fields = Fields(session)
    dyes = {name: dye_title(name) for name in DYE_NAMES}
    borders = {"": "Like the ground", "none": "None", **dyes}

    def change(**changes: Any) -> None:
        nonlocal chosen
        after = replace(chosen, **changes)
        after.banners()
        chosen = after
        show()

    translated_text("Letters", "h2").classes("heading")
    with ui.element("div").classes("options"):
        fields.line("Word", lambda: chosen.text, lambda text: change(text=text), maxlength=MAX_WORD)
        fields.choice("Ink", dyes, lambda: chosen.ink, lambda dye: change(ink=dye))
        fields.choice("Ground", dyes, lambda: chosen.ground, lambda dye: change(ground=dye))
        fields.choice(
            "Border",
            borders,
            lambda: chosen.border or "",
            lambda dye: change(border=dye or None),
        )
    row = ui.element("div").classes("letters").props("role=group")
    row.props["aria-label"] = translated("Letters")
    written = copy_field("letters-text", "The commands of the letters", 4)

    def show() -> None:
        try:
            banners = chosen.banners()
        except DraperyError:
            return
        row.clear()
        with row:
            for banner in banners:
                design_button(session, "found", banner, side=30)
        written("\n".join(write_banner(banner, "give") for banner in banners))

    session.follow(show, "packs")
