"""A field of the page that takes files, chosen or dropped on it, and sends them to the server."""

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

from nicegui import ui

from drapery import DraperyError
from drapery.studio.notices import show_notice
from drapery.studio.session import Session
from drapery.studio.translation import translated
from drapery.studio.uploads import PURPOSES


class FileField(ui.element, component="file_field.js"):
    """A field that can be clicked, reached by Tab and dropped on.

    purpose: one of PURPOSES. take: a callable that gets the number of each file that has arrived;
    if a file is refused, the user sees the reason. endings: for example `.zip,.jar`; "" accepts
    all. tab: the panel that opens when a file with such an ending is dropped elsewhere on the
    page; "" opens none. zone: a CSS selector of the part of the page on which files with such an
    ending are for this field alone; "" has none.
    """

    def __init__(
        self,
        session: Session,
        purpose: str,
        label: str,
        take: Callable[[int], Awaitable[None]],
        *,
        endings: str = "",
        multiple: bool = False,
        tab: str = "",
        zone: str = "",
    ) -> None:
        super().__init__()
        self._props["address"] = f"upload/{session.token}/{purpose}"
        self._props["label"] = translated(label)
        self._props["sends"] = translated("Sending {name}")
        self._props["stop"] = translated("Cancel")
        self._props["accept"] = endings
        self._props["multiple"] = multiple
        self._props["tab"] = tab
        self._props["zone"] = zone
        self._props["maxBytes"] = PURPOSES[purpose].max_bytes

        # One after another: of two files, the later one would else be taken first if it is quicker.
        turn = asyncio.Lock()

        async def sent(event: Any) -> None:
            answer = event.args if isinstance(event.args, dict) else {}
            number, line = answer.get("number"), answer.get("line")
            if not isinstance(number, int):
                show_notice(str(line or "the file could not be sent; send it again")[:400], "fault")
                return
            try:
                async with turn:
                    await take(number)
            except DraperyError as error:
                show_notice(str(error), "fault")

        self.on("sent", sent)
