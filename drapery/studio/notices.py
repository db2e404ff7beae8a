"""What the page tells its user: faults of input, warnings, and that something is done."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

from nicegui import ui

from drapery.errors import DraperyError

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


def tell(line: str, tone: Tone = "done") -> None:
    """One line to the user, where a screen reader reads it too."""
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
def faults() -> Iterator[None]:
    """Tell the user of a fault inside, and of what was warned of; the page goes on."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        try:
            yield
        except DraperyError as error:
            tell(str(error), "fault")
    for line in dict.fromkeys(str(each.message) for each in caught[:5]):
        tell(line, "warning")
