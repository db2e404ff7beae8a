"""Sliders, lists and buttons that show what the session holds and change it.

A control reads its value again at each event of the session, so it also shows the effects of undo,
links and keys.
"""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from nicegui import ui
from nicegui.elements.mixins.value_element import ValueElement

from drapery.settings import OPTIONS
from drapery.studio.descriptions import choice_titles, option_help, with_unit
from drapery.studio.form_field import FormField
from drapery.studio.notices import errors_shown
from drapery.studio.session import Session
from drapery.studio.snippets import plain
from drapery.studio.translation import translated
from drapery.studio.widgets import text_element

BLUR = "() => setTimeout(() => document.activeElement?.blur?.(), 60)"

Get = Callable[[], Any]
Set = Callable[[Any], object]


class Controls:
    """The controls of one panel."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._shown: list[tuple[ValueElement[Any], Get]] = []
        self._states: list[Callable[[], None]] = []
        self._quiet = False

    def follow(self) -> None:
        """Refresh at every event of the session; call this after all controls have been made."""
        self._session.listen("settings", self.refresh)
        self._session.listen("scene", self.refresh)
        self._session.viewport.listen(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show the current values."""
        self._quiet = True
        try:
            for element, get in self._shown:
                value = get()
                if element.value != value:
                    element.value = value
            for show in self._states:
                show()
        finally:
            self._quiet = False

    def slider(
        self,
        label: str,
        bounds: tuple[float, float, float],
        get: Get,
        change: Set,
        to_text: Callable[[Any], str] = "{:g}".format,
        help: str = "",
    ) -> None:
        """A slider with its value beside its label. bounds: minimum, maximum, step."""
        label = translated(label)
        minimum, maximum, step = bounds
        with ui.element("div").classes("control"):
            with ui.element("div").classes("control-head"):
                ui.label(label)
                shown = (
                    ui.label(to_text(get())).classes("control-value").props('aria-hidden="true"')
                )
            element = FormField("range", lambda: plain(get()), lambda text: change(float(text)))
            element.classes("slider").props.update({"min": minimum, "max": maximum, "step": step})
            element.props.update({"aria-label": label, "title": help})

        def show() -> None:
            shown.set_text(to_text(get()))
            element.props["aria-valuetext"] = to_text(get())
            element.refresh()

        self._states.append(show)

    def number(self, name: str, label: str, step: float) -> None:
        """A slider for a number of the table of options."""
        option, get = OPTIONS[name], self._getter(name)
        assert option.bounds is not None and option.type in (int, float)

        def change(value: Any) -> None:
            self._session.adjust(**{name: value if option.type is float else int(value)})

        to_text = partial(with_unit, option)
        self.slider(label, (*option.bounds, step), get, change, to_text, option_help(option))

    def choice(self, name: str, label: str, **also: Any) -> None:
        """A list for an option with few choices. also: other options that change with it."""
        option = OPTIONS[name]
        element = self.select(
            label,
            choice_titles(option),
            self._getter(name),
            lambda value: self._session.adjust(**{name: value}, **also),
        )
        element.props.update({"title": option_help(option)})

    def flag(self, name: str, label: str) -> None:
        """A switch for an option that is on or off."""
        get = self._getter(name)
        self.switch(label, get, lambda on: self._session.adjust(**{name: bool(on)}))

    def _getter(self, name: str) -> Get:
        return lambda: getattr(self._session.settings, name)

    def select(self, label: str, choices: Mapping[Any, str], get: Get, change: Set) -> ui.select:
        """A list of choices, by value, with their titles."""
        label = translated(label)
        titles = {value: translated(title) for value, title in choices.items()}
        element = ui.select(titles, label=label, value=get()).classes("control")
        element.props(f'dense outlined options-dense aria-label="{label}"')
        # If it had the focus, it would consume the keys that change the wind.
        element.on("popup-hide", js_handler=BLUR)
        self._listen(element, get, change)
        return element

    def switch(self, label: str, get: Get, change: Set) -> None:
        """A switch."""
        label = translated(label)
        element = ui.switch(label, value=get()).classes("control").props("dense")
        element.props.update({"aria-label": label})
        self._listen(element, get, change)

    def button(
        self, label: str, call: Callable[[], object], *, icon: str | None = None
    ) -> ui.button:
        """A button for an action; an icon takes the place of its label."""

        def press() -> None:
            with errors_shown():
                call()
            self.refresh()

        label = translated(label)
        button = ui.button("" if icon else label, icon=icon, on_click=press)
        button.props(f'flat dense no-caps aria-label="{label}"')
        if icon:
            button.props.update({"title": label})
        return button

    def pressed(self, button: ui.button, get: Callable[[], bool]) -> None:
        """Show on a button whether it is pressed."""

        def show() -> None:
            button.props.update({"aria-pressed": str(get()).lower()})
            button.update()

        self._states.append(show)

    def enabled(self, button: ui.button, get: Callable[[], bool]) -> None:
        """Let a button work only while `get` returns true."""

        def show() -> None:
            button.set_enabled(get())

        self._states.append(show)

    def line(self, get: Callable[[], str]) -> None:
        """A line of text, which is hidden while it is empty."""
        element = text_element("", "p").classes("hint").props("role=status")

        def show() -> None:
            element.set_text(get())
            element.set_visibility(bool(get()))

        self._states.append(show)

    def _listen(self, element: ValueElement[Any], get: Get, change: Set) -> None:
        def changed(event: Any) -> None:
            # Ignore a change that the session made: it is not the user's input.
            if self._quiet or event.value == get():
                return
            with errors_shown():
                change(event.value)
            self.refresh()

        element.on_value_change(changed)
        self._shown.append((element, get))
