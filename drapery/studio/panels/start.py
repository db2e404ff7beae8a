"""The start page: designs to begin with."""

from functools import partial
from zlib import crc32

from nicegui import ui
from nicegui.element import Element

from drapery import Settings
from drapery.studio.art import face_address
from drapery.studio.descriptions import described
from drapery.studio.design_catalogue import EXAMPLES, OwnDesign, groups, own_designs
from drapery.studio.notices import errors_shown
from drapery.studio.session import Session
from drapery.studio.sketch import Sketch, banner_of, sketch_of
from drapery.studio.translation import translated
from drapery.studio.widgets import button, text_element, translated_text


def build(session: Session) -> None:
    """A new design, and our own designs in their groups; each can be changed."""
    translated_text("Begin with a design", "h2").classes("heading")
    with ui.element("div").classes("line"):
        button(
            "New banner", lambda: session.selection.lay_out(Sketch()), text="New banner"
        ).classes("primary")
        for name, label in (("library", "Open from the library"), ("text", "Open a text or file")):
            button(label, partial(_show_tab, name), text=label)
    _recent(session)
    translated_text("Or change one of these; Undo brings your own design back.", "p").classes(
        "hint"
    )
    for group in groups():
        translated_text(group.capitalize(), "h3")
        with ui.element("div").classes("own-designs"):
            for number, design in enumerate(own_designs()):
                if design.group == group:
                    _card(session, number, design)


def _show_tab(name: str) -> None:
    ui.run_javascript(f"studio.tab('{name}')")


def _recent(session: Session) -> None:
    """The latest designs of this browser, also of tabs that were closed."""
    with ui.element("div") as recent:
        translated_text("Recent", "h3")
        row = ui.element("div").classes("own-designs recent-designs")

    def show() -> None:
        row.clear()
        recent.set_visibility(bool(session.recent))
        with row, errors_shown():
            for sketch, settings in session.recent:
                _recent_card(session, sketch, settings)

    show()
    session.listen("recent", show)


def _recent_card(session: Session, sketch: Sketch, settings: Settings) -> None:
    def press() -> None:
        with errors_shown():
            session.open(sketch, settings)

    choice = ui.element("button").classes("own-design").props("type=button")
    choice.props["title"] = described(sketch)
    choice.on("click", press)
    with choice:
        face_picture(face_address(banner_of(sketch), session.packs()))
        text_element(sketch.title or translated("Untitled"))


def build_examples(session: Session) -> None:
    """A sentence and three designs, until something is designed."""
    with ui.element("div").classes("welcome") as welcome:
        translated_text(
            "Choose a dye, then click patterns: each becomes a layer of your banner."
            " Or begin with one of these:",
            "p",
        )
        with ui.element("div").classes("own-designs"):
            for number, design in enumerate(own_designs()):
                if design.title in EXAMPLES:
                    _card(session, number, design)

    def show() -> None:
        welcome.set_visibility(session.sketch == Sketch() and not session.history.past)

    show()
    session.listen("sketch", show)


def _card(session: Session, number: int, design: OwnDesign) -> None:
    choice = ui.element("button").classes("own-design").props("type=button")
    choice.props.update({"data-own": design.title, "title": described(sketch_of(design.banner))})
    choice.on("click", lambda: session.selection.lay_out(sketch_of(design.banner, design.title)))
    with choice:
        picture = face_picture(_address(session, number))
        text_element(design.title)

    def show() -> None:
        picture.props["src"] = _address(session, number)
        picture.update()

    session.listen("packs", show)


def _address(session: Session, number: int) -> str:
    """Where a design's face is; another one for other packs, because browsers keep pictures."""
    read = session.settings.packs, session.settings.format
    return f"/own/{session.token}/{number}.png?v={crc32(repr(read).encode()):x}"


def face_picture(address: str) -> Element:
    """A small flat face, which the browser loads when it comes into sight."""
    picture = ui.element("img").props('alt="" loading="lazy" width=40 height=80')
    picture.props["src"] = address
    return picture
