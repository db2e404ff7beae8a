"""The page's own elements in the browser; each has a JavaScript file beside this one."""

from pathlib import Path
from typing import Literal

from nicegui.element import Element

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


class Palette(Element, component="palette.js"):
    """A palette of dyes, one of them marked; emits `dye` with a name."""


class PatternGrid(Element, component="patterns.js"):
    """All patterns in the chosen dyes; emits `pattern` with a name, and `swaps`."""


class LayerList(Element, component="layers.js"):
    """The layers, topmost first; emits `choose` with a number, and `act` with what to do."""


class ViewerElement(Element, component="viewer.js", esm={"drapery-viewer": VIEWER}):
    """A canvas on which a session's cloth moves: `drapery.web` draws what `stream` sends.

    which: which of two designs side by side it shows: all, or only the left or the right one. All
    viewers of one session show the same motion.
    """

    def __init__(self, session: Session, which: Which = "all", label: str = LABEL) -> None:
        super().__init__()
        self._props["address"] = f"live/{session.token}?which={which}"
        self._props["label"] = translated(label)
        self._props["words"] = [translated(text) for text in ("no wind", "frames/s")]
