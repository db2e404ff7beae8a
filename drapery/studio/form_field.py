"""A field of a form, which shows a value of the session and takes the user's input."""

from collections.abc import Callable, Mapping
from typing import Any, Literal

from nicegui.element import Element

from drapery.studio.notices import errors_shown

Kind = Literal["text", "number", "checkbox", "color", "select", "range"]


class FormField(Element, component="form_field.js"):
    """One field. The browser does not replace its value while it is in use.

    kind: `select` for a list, otherwise the type of an HTML input. get: a callable that gives the
    value to show. change: takes the user's value; if it raises a DraperyError, the user sees the
    error and the field shows `get()` again. choices: the names of a list, with their titles.
    """

    def __init__(
        self,
        kind: Kind,
        get: Callable[[], Any],
        change: Callable[[Any], object],
        choices: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__()
        self._get, self._change = get, change
        # The number of the last input that the server has handled.
        self._answered = 0
        self.props.update({"kind": kind, "choices": list((choices or {}).items())})
        self._show()
        self.on("value", lambda event: self.take(**event.args))

    def refresh(self) -> None:
        """Show the current value."""
        if self.props["shown"]["value"] != self._get():
            self._show()

    def set_choices(self, choices: Mapping[str, str]) -> None:
        """Replace the names of a list."""
        self.props["choices"] = list(choices.items())
        self._show()

    def take(self, value: Any, number: int) -> None:
        """Take the input of this number from the page."""
        self._answered = int(number)
        try:
            with errors_shown():
                self._change(value)
        finally:
            self._show()

    def _show(self) -> None:
        self.props["shown"] = {"value": self._get(), "answered": self._answered}
        self.update()
