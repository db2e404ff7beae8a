"""The work of tabs that were closed a short time ago, for a page that is loaded again."""

import shutil
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from drapery.studio.pack_store import PackEntry

KEEP = 600.0
"""How long the work of a closed tab is kept [s]."""
MAX_KEPT = 32
"""The most closed tabs whose work is kept."""
MAX_BYTES = 1 << 30
"""The most bytes of their files, all together."""


@dataclass(frozen=True)
class Work:
    """What a tab can go on from.

    packs: lowest first. garments: the names of garments and skins that were sent, by their paths.
    entries, tags: as in `Session`. The page keeps what can be undone.
    """

    packs: tuple[PackEntry, ...]
    garments: dict[str, str]
    entries: dict[int, int]
    tags: dict[int, str]


@dataclass(frozen=True)
class _Kept:
    work: Work
    until: float
    folder: Path | None
    size: int


class KeptWork:
    """The work of closed tabs by the tab's token, oldest first. clock: gives the time [s]."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._kept: dict[str, _Kept] = {}

    def __len__(self) -> int:
        return len(self._kept)

    def add(self, token: str, work: Work, folder: Path | None) -> None:
        """Keep a tab's work. folder: of all its files; from now on they are removed from here."""
        size = 0
        for path in folder.rglob("*") if folder else ():
            with suppress(OSError):  # the thread of an export may still remove its file
                size += path.stat().st_size if path.is_file() else 0
        self._kept[token] = _Kept(work, self._clock() + KEEP, folder, size)
        self.prune()

    def find(self, token: str) -> Work | None:
        """The work of a tab, or None if it is not kept."""
        self.prune()
        kept = self._kept.get(token)
        return None if kept is None else kept.work

    def prune(self) -> None:
        """Drop what is too old or too much."""
        while self._kept:
            token, oldest = next(iter(self._kept.items()))
            size = sum(kept.size for kept in self._kept.values())
            if oldest.until > self._clock() and len(self) <= MAX_KEPT and size <= MAX_BYTES:
                return
            self.drop(token)

    def drop(self, token: str) -> None:
        """Forget the work of a tab and remove its files."""
        kept = self._kept.pop(token, None)
        if kept is not None and kept.folder is not None:
            shutil.rmtree(kept.folder, ignore_errors=True)

    def clear(self) -> None:
        """Drop everything, such as when the server stops."""
        for token in [*self._kept]:
            self.drop(token)
