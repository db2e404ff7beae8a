"""Notices on the page for its user: input errors, warnings and confirmations."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

from nicegui import ui

from drapery import DraperyError

Tone = Literal["fault", "warning", "done"]

_TYPES: dict[Tone, Literal["negative", "warning", "positive"]] = {
    "fault": "negative",
    "warning": "warning",
    "done": "positive",
}
_CLOSE: dict[Tone, list[dict[str, str | bool]]] = {
    "fault": [{"label": "Close", "color": "white", "dense": True, "noCaps": True}],
    "warning": [{"label": "Close", "color": "dark", "dense": True, "noCaps": True}],
    "done": [],
}


def show_notice(line: str, tone: Tone = "done") -> None:
    """Show one line to the user; a screen reader reads it too."""
    ui.notify(
        line,
        type=_TYPES[tone],
        position="bottom",
        timeout={"fault": 10_000, "warning": 7_000, "done": 1_800}[tone],
        attrs={"role": "status" if tone == "done" else "alert"},
        classes="notice",
        actions=_CLOSE[tone],
    )


@contextmanager
def errors_shown() -> Iterator[None]:
    """If the block raises a DraperyError, show it to the user; the page continues to work."""
    try:
        yield
    except DraperyError as error:
        show_notice(str(error), "fault")
