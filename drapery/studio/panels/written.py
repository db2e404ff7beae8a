"""The design as text in any form; give commands have a player, a count, a name and lore."""

from dataclasses import dataclass, field, replace
from itertools import zip_longest
from typing import Any

from nicegui import ui

from drapery import Banner, DesignError
from drapery.banner import (
    FORMS,
    GIVE_FORMS,
    ItemDetails,
    not_kept,
    plain_text,
    write_banner,
    write_give,
)
from drapery.option import Option
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.sketch import MAX_TITLE, banner_of
from drapery.studio.translation import translated
from drapery.studio.widgets import button, set_props, text_element, translated_text

COUNT = Option("count", "How many items the command gives", int, 1, bounds=(1, 1600))
COMMON = ("give", "give-legacy", "give-1.12", "bedrock", "item", "shorthand", "json")
"""The forms that most users look for; the others follow by name."""
MAX_LORE = 500
"""The most characters of all lines of lore."""


@dataclass
class WrittenForm:
    """The chosen form, and what a give command says beside the design."""

    form: str = "give"
    details: ItemDetails = field(default_factory=ItemDetails)

    @property
    def is_named(self) -> bool:
        """Whether a command says a name or lore."""
        return bool(self.details.name or self.details.lore)

    def text(self, banner: Banner) -> str:
        """The design as text. Raises DesignError."""
        if self.form in GIVE_FORMS:
            return write_give(banner, self.form, self.details)
        return write_banner(banner, self.form)


def build_writer(session: Session) -> None:
    """The choice of the form, what a command says beside the design, and the text to copy."""
    chosen = WrittenForm()
    fields = Fields(session)
    translated_text("Write the design", "h2").classes("heading")
    others = sorted(name for name, form in FORMS.items() if form.write and name not in COMMON)
    forms = {name: f"{name}: {FORMS[name].title}" for name in (*COMMON, *others)}

    def change(**changes: Any) -> None:
        chosen.details = replace(chosen.details, **changes)
        show()

    def choose(form: str) -> None:
        chosen.form = form
        show()

    with ui.element("div").classes("options"):
        fields.choice("Form of the text", forms, lambda: chosen.form, choose)
        with fields.only(lambda: chosen.form in GIVE_FORMS):
            _item_fields(fields, chosen, change)
        with fields.only(lambda: chosen.form == "give" and chosen.is_named):
            fields.tick(
                "Name and lore for 1.20.5 to 1.21.4",
                lambda: chosen.details.json_text,
                lambda on: change(json_text=bool(on)),
            )
    with ui.element("div").classes("line"):
        copy = button("Copy the text", icon="copy").classes("main")
        with copy:
            translated_text("Copy").classes("copy-label")
    copy.props('data-copy="written"')
    written = ui.element("textarea").classes("field command").props('id="written" rows=6 readonly')
    written.props.update({"aria-label": translated("The design as text"), "spellcheck": "false"})

    note = text_element("", "p").classes("hint")

    def show() -> None:
        try:
            text, fault = chosen.text(banner_of(session.sketch)), False
        except DesignError as error:
            text, fault = str(error), True
        written.classes(add="fault" if fault else "", remove="" if fault else "fault")
        set_props(written, {"value": text})
        set_props(copy, {"disabled": fault})
        note.set_text("" if fault else not_kept(chosen.details, chosen.form))
        note.set_visibility(bool(note.text))
        fields.refresh()

    def keep_name() -> None:
        """What a pasted item says beside its design."""
        queue = session.upload_queue
        if queue.line:
            return
        if queue.details is None:
            change(name="", components={}, tag={}, left_out=())
        else:
            chosen.details = queue.details
            show()

    session.follow(show, "sketch")
    session.listen(keep_name, "read")


def _item_fields(fields: Fields, chosen: WrittenForm, change: Any) -> None:
    fields.line(
        "Player or selector",
        lambda: chosen.details.target,
        lambda text: change(target=str(text).strip() or ItemDetails.target),
        maxlength=200,
    )
    fields.number("Count", COUNT, lambda: chosen.details.count, lambda number: change(count=number))
    fields.line(
        "Name of the item",
        lambda: plain_text(chosen.details.name),
        lambda text: change(name=_unless_same(str(text).strip(), chosen.details.name)),
        maxlength=MAX_TITLE,
    )
    fields.line(
        "Lore, with | between lines",
        lambda: " | ".join(map(plain_text, chosen.details.lore)),
        lambda text: change(lore=_lines(str(text), chosen.details.lore)),
        maxlength=MAX_LORE,
    )


def _lines(text: str, lore: tuple[Any, ...]) -> tuple[Any, ...]:
    """The lines of lore; one that says what it said before keeps its looks."""
    lines = [line.strip() for line in text.split("|")] if text.strip() else []
    return tuple(_unless_same(line, old) for line, old in zip_longest(lines, lore[: len(lines)]))


def _unless_same(text: str, component: Any) -> Any:
    """The text, or the component if it says the same."""
    return component if text == plain_text(component).strip() else text
