"""The live cloth as an element of the page: `drapery.web` draws it, and `stream` sends the data."""

from pathlib import Path
from typing import Literal

from nicegui import ui

import drapery.web
from drapery.studio.session import Session
from drapery.studio.translation import translated

VIEWER = str(Path(drapery.web.__file__).parent / "viewer")

Which = Literal["all", "left", "right"]

LABEL = (
    "Live banner. Drag the cloth to pull it and the background to turn the view; the wheel or plus"
    " and minus zoom, Shift with arrows turns, Home resets the view. W, A, S, D or arrows turn the"
    " wind, Q and E make it weaker and stronger, Space stops it."
)


class ViewerElement(ui.element, component="viewer.js", esm={"drapery-viewer": VIEWER}):
    """A canvas on which a session's cloth moves.

    which: which of two designs side by side it shows: all, or only the left or the right one. All
    viewers of one session show the same motion.
    """

    def __init__(self, session: Session, which: Which = "all", label: str = LABEL) -> None:
        super().__init__()
        self._props["address"] = f"live/{session.token}?which={which}"
        self._props["label"] = translated(label)
        self._props["words"] = [translated(text) for text in ("no wind", "frames/s")]
