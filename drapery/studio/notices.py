"""Notices on the page for its user: input errors, warnings and confirmations."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Literal, TypeVar

from nicegui import Client, run, ui

from drapery import DraperyError
from drapery.studio.line_icons import LINES
from drapery.studio.translation import translated

T = TypeVar("T")
Tone = Literal["fault", "warning", "done"]
_TONES: dict[Tone, tuple[Literal["negative", "warning", "positive"], int, str]] = {
    "fault": ("negative", 10_000, "white"),
    "warning": ("warning", 7_000, "dark"),
    "done": ("positive", 4_000, ""),
}
"""Quasar's type, how long it is shown [ms], and the colour of its button, if it has one."""

ADDED = "Designs added: {}; here already: {}"
"""What a library says after it has got several designs."""


def show_notice(line: str, tone: Tone = "done") -> None:
    """Show one line to the user; a screen reader reads it too."""
    kind, timeout, colour = _TONES[tone]
    close = {"label": translated("Close"), "color": colour, "dense": True, "noCaps": True}
    ui.notify(
        translated(line),
        type=kind,
        icon=LINES[tone],
        position="top",
        timeout=timeout,
        attrs={"role": "status" if tone == "done" else "alert"},
        classes="notice",
        actions=[close] if colour else [],
    )


@contextmanager
def errors_shown() -> Iterator[None]:
    """If the block raises a DraperyError, show it to the user; the page continues to work."""
    try:
        yield
    except DraperyError as error:
        show_notice(str(error), "fault")


async def called_in_thread(client: Client, call: Callable[[], T]) -> T | None:
    """The result of a call in a thread; None after a DraperyError, which the page's user sees."""
    try:
        return await run.io_bound(call)
    except DraperyError as error:
        with client:  # what was pressed may be gone, and the notice would go with it
            show_notice(str(error), "fault")
        return None
