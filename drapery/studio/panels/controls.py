"""Sliders, lists and buttons that show what the session holds and change it.

A control asks for its value whenever the session tells of a change, so that undo, links and keys
are seen in it too.
"""

from collections.abc import Callable, Mapping
from typing import Any

from nicegui import ui
from nicegui.elements.mixins.value_element import ValueElement

from drapery.studio.notices import faults
from drapery.studio.session import Session
from drapery.studio.viewport import stage_of

LET_GO = "() => setTimeout(() => document.activeElement?.blur?.(), 60)"

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
        """Show what the session holds from now on; call it once all controls are there."""
        self._session.listen("settings", self.refresh)
        self._session.listen("scene", self.refresh)
        stage_of(self._session).listen(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show what the session holds now."""
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
        words: Callable[[Any], str] = "{:g}".format,
    ) -> None:
        """A slider with its value beside its label. bounds: least, most, step."""
        least, most, step = bounds
        with ui.element("div").classes("control"):
            with ui.element("div").classes("control-head"):
                ui.label(label)
                shown = ui.label(words(get())).classes("control-value").props('aria-hidden="true"')
            element = ui.slider(min=least, max=most, step=step, value=get())
            element.props(f'aria-label="{label}" dense')
        element.on_value_change(lambda event: shown.set_text(words(event.value)))
        self._listen(element, get, change)

    def select(self, label: str, choices: Mapping[Any, str], get: Get, change: Set) -> ui.select:
        """One of several."""
        element = ui.select(dict(choices), label=label, value=get()).classes("control")
        element.props(f'dense outlined options-dense aria-label="{label}"')
        # Left alone by its list it would keep the keys that steer the wind.
        element.on("popup-hide", js_handler=LET_GO)
        self._listen(element, get, change)
        return element

    def switch(self, label: str, get: Get, change: Set) -> None:
        """On or off."""
        element = ui.switch(label, value=get()).classes("control").props("dense")
        self._listen(element, get, change)

    def button(
        self, label: str, call: Callable[[], object], *, icon: str | None = None
    ) -> ui.button:
        """Something done at once; an icon stands for its label."""

        def press() -> None:
            with faults():
                call()
            self.refresh()

        button = ui.button("" if icon else label, icon=icon, on_click=press)
        button.props(f'flat dense no-caps aria-label="{label}"')
        if icon:
            with button:
                ui.tooltip(label)
        return button

    def pressed(self, button: ui.button, get: Callable[[], bool]) -> None:
        """Show of a button whether it is pressed."""

        def show() -> None:
            button.props.update({"aria-pressed": str(get()).lower()})
            button.update()

        self._states.append(show)

    def _listen(self, element: ValueElement[Any], get: Get, change: Set) -> None:
        def changed(event: Any) -> None:
            # What the session itself has made of a value is no wish of the user's.
            if self._quiet or event.value == get():
                return
            with faults():
                change(event.value)
            self.refresh()

        element.on_value_change(changed)
        self._shown.append((element, get))
