"""Labelled fields: numbers, choices, colours, check boxes and lines of text.

A field shows the value of `get` and updates it at every `refresh`. The user's input goes to
`change`; if that raises a DraperyError, the user sees it and the field returns to the value of
`get`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from nicegui import ui
from nicegui.element import Element

from drapery.option import Option
from drapery.studio.components import value_of
from drapery.studio.notices import errors_shown
from drapery.studio.snippets import plain
from drapery.studio.widgets import button, text_element

Get = Callable[[], Any]
Change = Callable[[Any], object]


@dataclass(frozen=True)
class _BoundProp:
    element: Element
    prop: str
    get: Get


class Fields:
    """The fields of one form."""

    def __init__(self) -> None:
        self._shown: list[_BoundProp] = []

    def refresh(self) -> None:
        """Show the current values."""
        for field in self._shown:
            value = field.get()
            if field.element.props.get(field.prop) != value:
                field.element.props[field.prop] = value
                field.element.update()

    def number(self, label: str, option: Option, get: Get, change: Change) -> None:
        """A number with an option's bounds and help; an empty field returns to its last value."""
        assert option.bounds is not None
        minimum, maximum = option.bounds
        step = "1" if option.type is int else "any"
        kind = {"type": "number", "min": minimum, "max": maximum, "step": step}
        kind["title"] = option.describe()

        def changed(text: Any) -> None:
            if _is_number(text):
                change(int(float(text)) if option.type is int else float(text))

        self._field(label, "input", kind, "value", lambda: plain(get()), changed)

    def choice(self, label: str, options: Mapping[str, str], get: Get, change: Change) -> None:
        """A list of choices, by name, with their titles."""
        with self._field(label, "select", {}, "value", get, change):
            for name, title in options.items():
                text_element(title, "option").props.update({"value": name})

    def tick(self, label: str, get: Get, change: Change) -> None:
        """A check box."""
        kind = {"type": "checkbox"}
        field = self._field(label, "input", kind, "checked", get, change, "e.target.checked")
        field.classes(remove="field")

    def colour(self, label: str, get: Get, change: Change) -> None:
        """A colour, `#rrggbb`."""
        self._field(label, "input", {"type": "color"}, "value", get, change)

    def line(self, label: str, get: Get, change: Change, **props: Any) -> Element:
        """A line of text."""
        return self._field(label, "input", {"type": "text"} | props, "value", get, change)

    def _field(
        self,
        label: str,
        tag: str,
        kind: Mapping[str, Any],
        prop: str,
        get: Get,
        change: Change,
        value: str = "e.target.value",
    ) -> Element:
        def changed(event: Any) -> None:
            # Record the value that the browser already shows.
            element.props[prop] = value_of(event)
            with errors_shown():
                change(value_of(event))
            self.refresh()

        with ui.element("label").classes("option"):
            text_element(label)
            element = ui.element(tag).classes("field")
            element.props.update({**kind, prop: get()})
        element.on("change", changed, js_handler=f"(e) => emit({value})")
        self._shown.append(_BoundProp(element, prop, get))
        return element


def _is_number(text: object) -> bool:
    try:
        return abs(float(str(text))) < float("inf")
    except ValueError:
        return False


def copy_field(name: str, label: str, rows: int) -> Callable[[str], None]:
    """A read-only text with a copy button; returns a callable that sets the text.

    name: its id on the page.
    """
    with ui.element("div").classes("copy"):
        with ui.element("div").classes("copy-head"):
            text_element(label, "h3")
            press = button(f"Copy: {label}", lambda: None, icon="content_copy")
            with press:
                text_element("Copy").classes("copy-label")
            press.props.update({"data-copy": name})
        area = ui.element("textarea").classes("field code").props("readonly")
        area.props.update({"id": name, "rows": rows, "aria-label": label, "spellcheck": "false"})

    def show(text: str) -> None:
        if area.props.get("value") != text:
            area.props["value"] = text
            area.update()

    return show
