"""The work of one tab: its design, its options, packs and files."""

import logging
import secrets
import shutil
import tempfile
import threading
from collections import defaultdict
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

from drapery import DesignError, Settings
from drapery.packs import Packs, open_packs
from drapery.studio.sketch import MAX_TITLE, Sketch

LOG = logging.getLogger(__name__)

Event = (
    Literal["sketch", "settings", "packs", "scene", "recent", "library"]
    | Literal["laid", "read", "files"]
)
"""`laid`: a design for the page's editor. `read`: a text or a file, of which designs come. `files`:
the garments and skins that another tab was sent."""


class Document:
    """What one tab works on. A change calls the event's listeners in the order they were added.

    The page's editor has the design and all that can be undone, and tells of each edit.

    token: identifies the tab to the server; it cannot be guessed.
    sketch: the design.
    """

    def __init__(self, settings: Settings | None = None, sketch: Sketch | None = None) -> None:
        self.token = secrets.token_urlsafe(24)
        self.sketch = sketch or Sketch()
        self.settings = settings or Settings()
        self.closed = False
        self._folder: Path | None = None
        self._packs: tuple[object, Packs] | None = None
        # Threads that draw pictures read the packs while the page may change them.
        self._lock = threading.Lock()
        self._listeners: defaultdict[str, list[Callable[[], object]]] = defaultdict(list)
        self._at_close: list[Callable[[], object]] = []

    @property
    def folder(self) -> Path:
        """The tab's own folder, made at first use and removed when the tab closes.

        Raises DesignError if the tab is closed, since nothing would remove a new folder.
        """
        if self._folder is None and self.closed:
            raise DesignError("the page is gone; open it again")
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="drapery-studio-"))
        return self._folder

    def take_folder(self) -> Path | None:
        """The tab's folder, if it has one, which then remains when the tab closes."""
        folder, self._folder = self._folder, None
        return folder

    def packs(self) -> Packs:
        """The packs of the settings; opened again only when the settings name others.

        Raises PackError.
        """
        return self._opened(self.settings)

    def _opened(self, settings: Settings) -> Packs:
        key = settings.packs, settings.format
        with self._lock:
            if self._packs is None or self._packs[0] != key:
                self._packs = key, open_packs(settings.packs, format=settings.format)
            return self._packs[1]

    def edit(self, sketch: Sketch) -> None:
        """Replace the design, as a step that the editor can undo; notifies "sketch", "laid"."""
        self.take(sketch)
        self.notify("laid")

    def name(self, title: str) -> None:
        """Give the design a title; as `edit`."""
        self.edit(replace(self.sketch, title=title[:MAX_TITLE].strip()))

    def take(self, sketch: Sketch) -> None:
        """Take the design of the editor; notifies "sketch" if it is another one."""
        if sketch == self.sketch:
            return
        self.sketch = sketch
        self.notify("sketch")

    def adjust(self, **options: Any) -> None:
        """Change options of the picture; notifies "settings", and "packs" if those changed.

        Raises OptionError, or PackError for packs that cannot be opened; then nothing changes.
        """
        before, after = self.settings, self.settings.changed(**options)
        new_packs = (after.packs, after.format) != (before.packs, before.format)
        if new_packs:
            self._opened(after)
        self.settings = after
        if new_packs:
            self.notify("packs")
        if after != before:
            self.notify("settings")

    def listen(self, call: Callable[[], object], *events: Event) -> None:
        """Call this at each event of these names."""
        for event in events:
            self._listeners[event].append(call)

    def follow(self, call: Callable[[], object], *events: Event) -> None:
        """Call this now and at each event of these names."""
        call()
        self.listen(call, *events)

    def notify(self, event: Event) -> None:
        """Call all listeners of an event."""
        for call in [*self._listeners[event]]:
            call()

    def on_close(self, call: Callable[[], object]) -> None:
        """Call this when the tab closes; at once if it is already closed."""
        if self.closed:
            call()
        else:
            self._at_close.append(call)

    def close(self) -> None:
        """Stop all that runs for the tab and remove its files. A second call does nothing."""
        if self.closed:
            return
        self.closed = True
        for call in reversed(self._at_close):
            try:
                call()
            except Exception:  # all else must still stop
                LOG.exception("a tab was not closed cleanly")
        self._at_close.clear()
        self._listeners.clear()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
