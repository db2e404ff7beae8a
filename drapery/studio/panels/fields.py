"""Labelled fields: numbers, choices, colours, check boxes and lines of text.

A field shows the value of `get` and updates it at every `refresh`. The user's input goes to
`change`; if that raises a DraperyError, the user sees it and the field returns to the value of
`get`.
"""

from collections.abc import Callable, Mapping
from typing import Any

from nicegui import ui
from nicegui.element import Element

from drapery.option import Option
from drapery.studio.descriptions import option_help
from drapery.studio.form_field import FormField, Kind
from drapery.studio.snippets import plain
from drapery.studio.translation import translated
from drapery.studio.widgets import button, text_element, translated_text

Get = Callable[[], Any]
Change = Callable[[Any], object]


class Fields:
    """The fields of one form."""

    def __init__(self) -> None:
        self._fields: list[FormField] = []

    def refresh(self) -> None:
        """Show the current values."""
        for field in self._fields:
            field.refresh()

    def number(self, label: str, option: Option, get: Get, change: Change) -> None:
        """A number with an option's bounds and help; an empty field returns to its last value."""
        assert option.bounds is not None
        minimum, maximum = option.bounds
        step = "1" if option.type is int else "any"
        props = {"min": minimum, "max": maximum, "step": step, "title": option_help(option)}

        def changed(text: Any) -> None:
            if _is_number(text):
                change(int(float(text)) if option.type is int else float(text))

        self._field(label, "number", props, lambda: plain(get()), changed)

    def choice(self, label: str, options: Mapping[str, str], get: Get, change: Change) -> None:
        """A list of choices, by name, with their titles."""
        self._field(label, "select", {}, get, change, options)

    def tick(self, label: str, get: Get, change: Change) -> None:
        """A check box."""
        self._field(label, "checkbox", {}, get, change).classes(remove="field")

    def colour(self, label: str, get: Get, change: Change) -> None:
        """A colour, `#rrggbb`."""
        self._field(label, "color", {}, get, change)

    def line(self, label: str, get: Get, change: Change, **props: Any) -> Element:
        """A line of text."""
        return self._field(label, "text", props, get, change)

    def _field(
        self,
        label: str,
        kind: Kind,
        props: Mapping[str, Any],
        get: Get,
        change: Change,
        choices: Mapping[str, str] | None = None,
    ) -> FormField:
        def changed(value: Any) -> None:
            try:
                change(value)
            finally:
                self.refresh()

        with ui.element("label").classes("option"):
            translated_text(label)
            shown = {name: translated(title) for name, title in (choices or {}).items()}
            field = FormField(kind, get, changed, shown).classes("field")
            field.props.update(props)
        self._fields.append(field)
        return field


def _is_number(text: object) -> bool:
    try:
        return abs(float(str(text))) < float("inf")
    except ValueError:
        return False


def copy_field(name: str, label: str, rows: int) -> Callable[[str], None]:
    """A read-only text with a copy button; returns a callable that sets the text.

    name: its id on the page.
    """
    label = translated(label)
    with ui.element("div").classes("copy"):
        with ui.element("div").classes("copy-head"):
            text_element(label, "h3")
            copying = translated("Copy: {label}").format(label=label)
            press = button(copying, lambda: None, icon="content_copy")
            with press:
                translated_text("Copy").classes("copy-label")
            press.props.update({"data-copy": name})
        area = ui.element("textarea").classes("field code").props("readonly")
        area.props.update({"id": name, "rows": rows, "aria-label": label, "spellcheck": "false"})

    def show(text: str) -> None:
        if area.props.get("value") != text:
            area.props["value"] = text
            area.update()

    return show
