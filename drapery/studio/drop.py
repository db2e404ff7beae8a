"""A field of the page that takes files, chosen or dropped on it, and sends them to `uploads`."""

from collections.abc import Awaitable, Callable
from typing import Any

from nicegui import ui

from drapery.errors import DraperyError
from drapery.studio.notices import tell
from drapery.studio.session import Session
from drapery.studio.uploads import PURPOSES


class Drop(ui.element, component="drop.js"):
    """A field that can be clicked, reached by Tab and dropped on.

    purpose: one of PURPOSES. take: is called with the number of each file that came in whole;
    what was refused is told to the user here. endings: as `.zip,.jar`; "" is any. tab: the
    panel to turn to for files of these endings that are dropped anywhere; "" leaves them alone.
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
    ) -> None:
        super().__init__()
        self._props["address"] = f"/upload/{session.token}/{purpose}"
        self._props["label"] = label
        self._props["accept"] = endings
        self._props["multiple"] = multiple
        self._props["tab"] = tab
        self._props["most"] = PURPOSES[purpose].most

        async def sent(event: Any) -> None:
            answer = event.args if isinstance(event.args, dict) else {}
            number, line = answer.get("number"), answer.get("line")
            if not isinstance(number, int):
                tell(str(line or "the file could not be sent; send it again")[:400], "fault")
                return
            try:
                await take(number)
            except DraperyError as error:
                tell(str(error), "fault")

        self.on("sent", sent)
