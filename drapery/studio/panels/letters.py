"""Words as rows of banners: write, look, and open a letter as the design."""

from dataclasses import dataclass, replace
from typing import Any

from nicegui import ui

from drapery import Banner, DraperyError
from drapery.banner import DYE_NAMES, alt_text, letter_banners, write_banner
from drapery.studio.art import face_address
from drapery.studio.descriptions import dye_title
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.sketch import sketch_of
from drapery.studio.widgets import button, translated_text

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
    fields = Fields()
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
    row = ui.element("div").classes("letters").props('role="group" aria-label="Letters"')
    copy = button("Copy commands", lambda: None, icon="content_copy")
    copy.props('data-copy="letters-text"')
    with copy:
        translated_text("Copy commands").classes("copy-label")
    written = (
        ui.element("textarea").classes("field code").props('id="letters-text" rows=4 readonly')
    )
    written.props.update({"aria-label": "The commands of the letters", "spellcheck": "false"})

    def show() -> None:
        try:
            banners = chosen.banners()
            addresses = [face_address(banner, session.packs()) for banner in banners]
        except DraperyError:
            return
        row.clear()
        with row:
            for banner, address in zip(banners, addresses, strict=True):
                _letter(session, banner, address)
        written.props["value"] = "\n".join(write_banner(banner, "give") for banner in banners)
        written.update()

    show()
    session.listen("packs", show)


def _letter(session: Session, banner: Banner, address: str) -> None:
    words = alt_text(banner)
    choice = ui.element("button").classes("found").props("type=button")
    choice.props.update({"aria-label": f"Open {words}", "title": words})
    choice.on("click", lambda: session.selection.lay_out(sketch_of(banner, session.sketch.title)))
    with choice:
        picture = ui.element("img").props("width=30 height=60")
        picture.props.update({"src": address, "alt": words})
