"""Labelled fields: numbers, sliders, choices, colours, check boxes and lines of text.

A field shows the value of `get` and updates it at every `refresh`. The user's input goes to
`change`; if that raises a DraperyError, the user sees it and the field returns to the value of
`get`.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import Any

from nicegui import ui

from drapery.option import Option
from drapery.settings import OPTIONS
from drapery.studio.descriptions import choice_titles, option_help, with_unit
from drapery.studio.form_field import FormField, Kind
from drapery.studio.session import Session
from drapery.studio.snippets import plain
from drapery.studio.translation import translated
from drapery.studio.widgets import button, set_props, text_element, translated_text

Get = Callable[[], Any]
Change = Callable[[Any], object]


class Fields:
    """The fields of one form. session: whose options `option` shows."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._shows: list[Callable[[], object]] = []

    def refresh(self) -> None:
        """Show the current values."""
        for show in self._shows:
            show()

    def on_refresh(self, show: Callable[[], object]) -> None:
        """Call this at every refresh too."""
        self._shows.append(show)

    @contextmanager
    def only(self, applies: Callable[[], bool]) -> Iterator[None]:
        """Within the block, add fields that are visible only while `applies` returns true."""
        with ui.element("div").classes("option-group") as group:
            yield
        self.on_refresh(lambda: group.set_visibility(applies()))

    def option(
        self,
        name: str,
        label: str,
        choices: Mapping[str, str] | None = None,
        *,
        step: float = 0.0,
        **also: Any,
    ) -> None:
        """A field for an option of the picture, as the table of options describes it.

        choices: a list's values with titles that need no help. step: of a slider; 0 is a number to
        type. also: other options that change with it.
        """
        option = OPTIONS[name]

        def get() -> Any:
            return getattr(self._session.settings, name)

        def given() -> str:
            return option.to_text(self._session.settings.as_given(name))

        def change(value: Any) -> None:
            self._session.adjust(**{name: value}, **also)

        def choose(text: str) -> None:
            change(option.parse(text) if text else None)

        if option.type is bool:
            self.tick(label, get, lambda on: change(bool(on)))
        elif titles := choices or choice_titles(option):
            help = "" if choices else option_help(option)
            self.choice(label, titles, given, choose, title=help)
        elif step:
            self.slider(label, option, step, get, change, partial(with_unit, option))
        else:
            self.number(label, option, get, change)

    def number(self, label: str, option: Option, get: Get, change: Change) -> None:
        """A number with an option's bounds and help; an empty field returns to its last value."""
        self._number(label, "number", option, get, change)

    def slider(
        self,
        label: str,
        option: Option,
        step: float,
        get: Get,
        change: Change,
        to_text: Callable[[Any], str],
        **bounds: float,
    ) -> None:
        """A slider with its value in words, with an option's help and its bounds or others."""
        least, most = option.bounds or (0, 0)
        bounds = {"min": least, "max": most, "step": step} | bounds
        field = self._number(label, "range", option, get, change, **bounds)
        field.classes("slider", remove="field").props["aria-label"] = translated(label)
        with next(field.ancestors()):
            shown = text_element("").classes("option-value").props("aria-hidden=true")

        def show() -> None:
            shown.set_text(to_text(get()))
            set_props(field, {"aria-valuetext": shown.text})

        self.on_refresh(show)

    def _number(
        self, label: str, kind: Kind, option: Option, get: Get, change: Change, **props: Any
    ) -> FormField:
        def changed(text: str) -> None:
            if text.strip():
                change(typed_number(option, text))

        title = option_help(option)
        return self._field(label, kind, lambda: plain(get()), changed, title=title, **props)

    def choice(
        self, label: str, choices: Mapping[str, str], get: Get, change: Change, **props: Any
    ) -> FormField:
        """A list of choices, by name, with their titles."""
        return self._field(label, "select", get, change, choices, **props)

    def tick(self, label: str, get: Get, change: Change) -> None:
        """A check box."""
        self._field(label, "checkbox", get, change).classes(remove="field")

    def colour(self, label: str, get: Get, change: Change) -> None:
        """A colour, `#rrggbb`."""
        self._field(label, "color", get, change)

    def line(self, label: str, get: Get, change: Change, **props: Any) -> None:
        """A line of text."""
        self._field(label, "text", get, change, **props)

    def _field(
        self,
        label: str,
        kind: Kind,
        get: Get,
        change: Change,
        choices: Mapping[str, str] | None = None,
        **props: Any,
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
        self.on_refresh(field.refresh)
        return field


def typed_number(option: Option, text: str) -> Any:
    """A number that a user typed, with a point or a comma; of a pair, one of its two numbers.

    Raises OptionError that names the option and its limits.
    """
    return replace(option, parts=()).parse(text.replace(",", "."))


def copy_field(name: str, label: str, rows: int) -> Callable[[str], None]:
    """A read-only text with a copy button; returns a callable that sets the text.

    name: its id on the page.
    """
    label = translated(label)
    with ui.element("div").classes("copy"):
        with ui.element("div").classes("head"):
            text_element(label, "h3").classes("grow")
            press = button(translated("Copy: {label}").format(label=label), icon="copy")
            with press.classes("quiet"):
                translated_text("Copy").classes("copy-label")
            press.props.update({"data-copy": name})
        area = ui.element("textarea").classes("field command").props("readonly")
        area.props.update({"id": name, "rows": rows, "aria-label": label, "spellcheck": "false"})

    return lambda text: set_props(area, {"value": text})
