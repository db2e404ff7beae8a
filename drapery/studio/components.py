"""The page's own elements in the browser; each has a JavaScript file beside this one."""

import hashlib
import math
from functools import cache
from pathlib import Path
from typing import Any

from nicegui.element import Element

from drapery.studio.session import Session
from drapery.studio.translation import translated
from drapery.studio.widgets import set_props
from drapery.web.bundle import bundled_module

VIEWER = Path(__file__).with_name("live_viewer.js")
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


class ViewerElement(Element, component="viewer.js"):
    """What a session shows: the browser plays its live cloth, or shows its picture."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self.props["module"] = viewer_address()
        self.props["label"] = translated(LABEL)
        self.props["words"] = [translated(text) for text in ("no wind", "frames/s")]
        self._session = session
        session.follow(self._show, "sketch", "settings", "packs", "scene")
        viewport = session.viewport
        self.on("switch", lambda _: viewport.switch())
        self.on("still", lambda _: viewport.update(paused=True))
        self.on("stopped", lambda event: viewport.stop_at(_number(event.args)))
        self.on("wind", lambda event: self._steer(event.args))

    def _show(self) -> None:
        shown = self._session.viewport.shown
        for name in ("line", "note"):
            shown[name] = translated(shown[name])
        shown["labels"] = [*map(translated, shown["labels"])]
        set_props(self, {"shown": shown})

    def _steer(self, wind: Any) -> None:
        """Take the wind that keys have made in the browser."""
        speed, heading = map(_number, wind)
        self._session.adjust(wind=round(speed, 1), direction=round(heading, 1))


def viewer_module() -> str:
    """The JavaScript of the viewer and of all that plays cloth, as one module."""
    return bundled_module(VIEWER, ("LiveViewer",))


@cache
def viewer_address() -> str:
    """The address of `viewer_module`; another module has another one."""
    return f"viewer.js?v={hashlib.sha256(viewer_module().encode()).hexdigest()[:16]}"


def _number(value: Any) -> float:
    """A number that the page has sent; 0 for anything else."""
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else 0.0
