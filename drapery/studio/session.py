"""One browser tab's work: its design with what can be undone, and the options of its picture."""

import secrets
import shutil
import tempfile
from collections import defaultdict
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

from drapery.banner.packs import Packs, open_packs
from drapery.errors import DraperyError
from drapery.settings import Settings
from drapery.studio.history import History
from drapery.studio.sketch import Sketch

Event = Literal["sketch", "settings", "packs", "scene"]


class Session:
    """The state of one tab. What changes tells those who listen, in the order they came.

    token: names this tab to the server; nobody can guess it.
    survival: whether the loom's six layers are meant to suffice.
    """

    def __init__(self, settings: Settings | None = None, sketch: Sketch | None = None) -> None:
        self.token = secrets.token_urlsafe(24)
        self.history: History[Sketch] = History(sketch or Sketch())
        self.settings = settings or Settings()
        self.survival = True
        self._folder: Path | None = None
        self._packs: tuple[object, Packs] | None = None
        self._listeners: defaultdict[str, list[Callable[[], object]]] = defaultdict(list)
        self._at_close: list[Callable[[], object]] = []
        self._closed = False

    @property
    def sketch(self) -> Sketch:
        """The design as it is now."""
        return self.history.present

    @property
    def folder(self) -> Path:
        """The session's own folder, made at first use and removed when the session closes."""
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="drapery-studio-"))
        return self._folder

    @property
    def closed(self) -> bool:
        """Whether the tab is gone."""
        return self._closed

    def packs(self) -> Packs:
        """The packs of the settings, opened once for as long as they stay. Raises PackError."""
        key = (self.settings.packs, self.settings.format)
        if self._packs is None or self._packs[0] != key:
            self._packs = key, open_packs(self.settings.packs, format=self.settings.format)
        return self._packs[1]

    def edit(self, sketch: Sketch) -> None:
        """Make this the present design, a step that can be undone; tells "sketch"."""
        self._go(self.history.push(sketch))

    def undo(self) -> None:
        """One step back, if there is one; tells "sketch"."""
        self._go(self.history.undo())

    def redo(self) -> None:
        """One undone step forth, if there is one; tells "sketch"."""
        self._go(self.history.redo())

    def _go(self, history: History[Sketch]) -> None:
        if history is not self.history:
            self.history = history
            self.tell("sketch")

    def adjust(self, **options: Any) -> None:
        """Change options of the picture; tells "settings", and "packs" where those changed.

        Raises OptionError, or PackError for packs that cannot be opened; nothing has changed then.
        """
        before = self.settings
        self.settings = replace(before, **options)
        new_packs = (self.settings.packs, self.settings.format) != (before.packs, before.format)
        if new_packs:
            try:
                self.packs()
            except DraperyError:
                self.settings = before
                raise
            self.tell("packs")
        if self.settings != before:
            self.tell("settings")

    def listen(self, what: Event, call: Callable[[], object]) -> None:
        """Call this whenever `what` is told."""
        self._listeners[what].append(call)

    def tell(self, what: Event) -> None:
        """Call all who listen to `what`."""
        for call in [*self._listeners[what]]:
            call()

    def on_close(self, call: Callable[[], object]) -> None:
        """Call this when the tab is gone; at once where it is already."""
        if self._closed:
            call()
        else:
            self._at_close.append(call)

    def close(self) -> None:
        """End what the tab had running and remove its files. A second time does nothing."""
        if self._closed:
            return
        self._closed = True
        for call in reversed(self._at_close):
            with suppress(Exception):
                call()
        self._at_close.clear()
        self._listeners.clear()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)


_SESSIONS: dict[str, Session] = {}

MAX_SESSIONS = 64
"""Tabs at once; more than anybody opens by hand."""


def open_session(settings: Settings, sketch: Sketch | None = None) -> Session:
    """A new session that `find_session` knows until it closes; of too many the oldest ends."""
    while len(_SESSIONS) >= MAX_SESSIONS:
        next(iter(_SESSIONS.values())).close()
    session = Session(settings, sketch)
    _SESSIONS[session.token] = session
    session.on_close(lambda: _SESSIONS.pop(session.token, None))
    return session


def find_session(token: str) -> Session | None:
    """The open session of this token."""
    return _SESSIONS.get(token)


def open_count() -> int:
    """How many sessions are open."""
    return len(_SESSIONS)


def close_all() -> None:
    """End all sessions, as when the server stops."""
    for session in [*_SESSIONS.values()]:
        session.close()
