"""The start page: designs to begin with."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from nicegui import ui

from drapery.settings import Settings
from drapery.studio.design_buttons import DesignButton
from drapery.studio.design_catalogue import EXAMPLES, OwnDesign, groups, own_designs
from drapery.studio.notices import errors_shown
from drapery.studio.session import Session
from drapery.studio.share import write_link
from drapery.studio.sketch import Sketch, banner_of
from drapery.studio.translation import translated
from drapery.studio.widgets import KeptElements, button, hint, translated_text


def build(session: Session) -> None:
    """A new design, and our own designs in their groups; each can be changed."""
    translated_text("Begin with a design", "h2").classes("heading")
    with ui.element("div").classes("line"):
        new = button("New banner", text="New banner").classes("main")
        new.props["data-act"] = "new"
        for name, label in (("library", "Open from the library"), ("text", "Open a text or file")):
            button(label, partial(_show_tab, name), text=label)
    _recent(session)
    hint("Or change one of these; Undo brings your own design back.")
    for group in groups():
        translated_text(group.capitalize(), "h3")
        _designs(session, [design for design in own_designs() if design.group == group])


def _show_tab(name: str) -> None:
    ui.run_javascript(f"studio.tab('{name}')")


def _recent(session: Session) -> None:
    """The latest designs of this browser, also of tabs that were closed."""
    with ui.element("div") as recent:
        translated_text("Recent", "h3")
        row = ui.element("div").classes("own-designs recent-designs")

    def card(sketch: Sketch, settings: Settings) -> DesignButton:
        press = partial(session.open, sketch, settings)
        text = sketch.title or translated("Untitled")
        return DesignButton(session, "own-design", banner_of(sketch), press, text=text)

    def show() -> None:
        recent.set_visibility(bool(session.recent))
        with errors_shown():
            cards.show({write_link(*each): partial(card, *each) for each in session.recent})

    cards: KeptElements[DesignButton] = KeptElements(row)
    session.follow(show, "recent")


def build_examples(session: Session) -> None:
    """A sentence and three designs, until something is designed."""
    with ui.element("div").classes("welcome") as welcome:
        translated_text(
            "Choose a dye, then click patterns: each becomes a layer of your banner."
            " Or begin with one of these:",
            "p",
        )
        _designs(session, [design for design in own_designs() if design.title in EXAMPLES])

    def show() -> None:
        welcome.set_visibility(replace(session.sketch, origin=0) == Sketch())

    session.follow(show, "sketch")


def _designs(session: Session, designs: Sequence[OwnDesign]) -> None:
    with ui.element("div").classes("own-designs"):
        for each in designs:
            name = each.title
            card = DesignButton(session, "own-design", each.banner, text=name, title=name)
            card.props["data-own"] = name
