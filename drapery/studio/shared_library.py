"""The library that all tabs of a studio share."""

import threading
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drapery.studio.library import Library


class SharedLibrary:
    """A library that is opened at first use, because its database module is slow to import.

    path: its file; None means the user's library.
    """

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._lock = threading.Lock()
        self._library: Library | None = None

    def open(self) -> "Library":
        """The library; all threads get the same object. Raises OutputError."""
        from drapery.studio.library import Library, default_place

        with self._lock:
            if self._library is None:
                self._library = Library(self._path or default_place())
            return self._library
