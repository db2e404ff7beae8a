"""The page's own elements in the browser; each has a JavaScript file beside this one."""

import hashlib
import json
import math
from functools import cache, partial
from html import escape
from pathlib import Path
from typing import Any

from nicegui import core, ui
from nicegui.element import Element

from drapery.banner import game_titles
from drapery.studio.art import face_files
from drapery.studio.document import Event
from drapery.studio.session import Session
from drapery.studio.sketch import edited_sketch, editor_tree
from drapery.studio.translation import translated
from drapery.studio.widgets import on, set_props
from drapery.web.bundle import bundled_module
from drapery.web.pattern_words import search_words
from drapery.web.tables import languages

VIEWER = Path(__file__).with_name("live_viewer.js")
DESIGNER = VIEWER.with_name("studio_designer.js")
OWN_ART = "Drapery's own art"
LABEL = (
    "Live banner. Drag the cloth to pull it and the background to turn the view; the wheel or plus"
    " and minus zoom, Shift with arrows turns, Home resets the view. W, A, S, D or arrows turn the"
    " wind, Q and E make it weaker and stronger, Space stops it."
)


def editor_part(name: str) -> Element:
    """A place of the page where the editor has one of its parts."""
    return ui.element("div").classes(f"editor part-{name}").props(f"data-part={name}")


class DesignerElement(Element, component="designer.js"):
    """The page's editor: it tells of each design, and takes those that come from elsewhere."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self.props["module"] = viewer_address()
        self.props["given"] = {
            "design": editor_tree(session.sketch),
            "motion": session.motion,
            "language": _editor_language(session.language),
            "words": search_words(),
            "token": session.token,
        }
        self._session, self._due, self._answers = session, set[str](), False
        session.follow(self._show_packs, "packs", "scene")
        self._shown = session.motion.get("shown")
        events: tuple[Event, ...] = "laid", "settings", "scene"
        for event in events:
            session.listen(partial(self._tell_soon, event), event)
        on(self, "design", self._take)

    def _show_packs(self) -> None:
        set_props(self, {"faces": face_files(self._session), "beside": _beside(self._session)})

    def _take(self, tree: Any) -> None:
        """Take an edit. What else it changes belongs to its own step of the history."""
        self._answers = True
        try:
            self._session.take(edited_sketch(tree))
            if tree.get("motion") is not None:
                self._tell_soon("settings")  # what it is here, also where it is refused
                self._session.move(tree["motion"])
        finally:
            self._answers = False

    def _tell_soon(self, event: Event) -> None:
        """Tell the editor once of all that changes together, which is one step of its history."""
        if event == "scene" and self._session.motion.get("shown") == self._shown:
            return  # of what is seen, only the look is another one
        if not self._due and core.loop is not None:
            core.loop.call_soon_threadsafe(self._tell)
        self._due.add("answer" if self._answers else event)

    def _tell(self) -> None:
        due, self._due = self._due, set()
        session = self._session
        if not session.closed:
            design = editor_tree(session.sketch) if "laid" in due else None
            self._shown = session.motion.get("shown")
            self.run_method("lay", design, session.motion, due == {"answer"})


EDITOR_TEXTS = {
    "new": "New banner",
    "untitled": "Untitled",
    "titleOf": "Title of the design",
    "history": "History",
    "missing": "{name} is in none of the packs: the game shows a checker. Add its pack.",
    "step": "Step {number}: {design}",
    "compare": "Compare designs",
    "compareHint": "Keep the design as it is now, or choose an earlier one. Then edit, or open"
    " another design: the slider shows both.",
    "keep": "Keep this design",
    "compareWith": "Compare with",
    "nothing": "nothing",
    "versus": "Left: your design now. Right: {title}",
    "yourPacks": "Your packs in their order",
    "design": "Design",
}
"""The texts that the editor has in the studio alone."""


def _editor_language(code: str) -> dict[str, Any]:
    """What an editor needs to speak a language."""
    texts = {key: translated(text) for key, text in EDITOR_TEXTS.items()}
    if code not in languages():
        return {"code": "en", "texts": texts, "dyes": {}, "patterns": {}}
    language = languages()[code]
    dyes, patterns = game_titles(language["game"])
    named = {"code": code, "dyes": dyes, "patterns": patterns}
    return {**named, "texts": texts | language["texts"]}


def _beside(session: Session) -> dict[str, Any] | None:
    """The packs that are compared with the page's: their name, and what faces are drawn of."""
    paths = session.viewport.request.beside
    if paths is None:
        return None
    entries = session.pack_store.entries
    entry = next((each for each in entries if (str(each.path),) == paths), None)
    title = entry.title if entry else translated(OWN_ART, session.language)
    return {"title": title, "faces": face_files(session, str(entry.number) if entry else "own")}


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
        self.on("switch", lambda _: viewport.update(on=not viewport.request.on))
        self.on("still", lambda _: viewport.update(paused=True))
        self.on("stopped", lambda event: viewport.stop_at(_number(event.args)))
        self.on("wind", lambda event: self._steer(event.args))

    def _show(self) -> None:
        set_props(self, {"shown": _shown(self._session)})

    def _steer(self, wind: Any) -> None:
        """Take the wind that keys have made in the browser."""
        speed, heading = map(_number, wind)
        self._session.adjust(wind=round(speed, 1), direction=round(heading, 1))


def add_first_view(session: Session) -> None:
    """Play the cloth about where the viewer will be, before the page's framework has come."""
    label, state = escape(translated(LABEL)), json.dumps(_shown(session)).replace("<", r"\u003c")
    host = f'<div class="viewer-host" tabindex="0" role="application" aria-label="{label}"></div>'
    ui.add_body_html(
        f'<div class="viewer first-view">{host}</div><script type="module" async>'
        f'import {{ LiveViewer }} from "./{viewer_address()}";'
        f'LiveViewer.begin(document.querySelector(".first-view"), {state});</script>'
    )


def _shown(session: Session) -> dict[str, Any]:
    """What the viewer is told, in the language of its user."""
    shown = session.viewport.shown
    for name in ("line", "note"):
        shown[name] = translated(shown[name])
    return {**shown, "labels": [*map(translated, shown["labels"])]}


def viewer_module() -> str:
    """The JavaScript of the viewer, of all that plays cloth, and of the editor, as one module."""
    return bundled_module(VIEWER, ("LiveViewer", "StudioDesigner"), more=[DESIGNER])


@cache
def viewer_address() -> str:
    """The address of `viewer_module`; another module has another one."""
    return f"viewer.js?v={hashlib.sha256(viewer_module().encode()).hexdigest()[:16]}"


def _number(value: Any) -> float:
    """A number that the page has sent; 0 for anything else."""
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else 0.0
