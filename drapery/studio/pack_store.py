"""The packs of a tab: which there are, in which order, and which of them count."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from drapery.banner.packs import open_packs
from drapery.errors import DesignError, DraperyError, PackError
from drapery.studio.session import Session
from drapery.studio.uploads import uploads_of


@dataclass(frozen=True)
class Entry:
    """One pack.

    name: what the user calls it: the path that was given, or the name of the file that was sent.
    upload: the number of the file that was sent, 0 where the studio was started with the pack.
    on: whether it counts. summary: what it holds, in a few words.
    """

    number: int
    name: str
    path: Path
    upload: int = 0
    on: bool = True
    summary: str = ""

    @property
    def title(self) -> str:
        """The name without folders."""
        return Path(self.name).name or self.name


class PackStore:
    """The packs of one session, the lowest first; later ones win. It keeps `settings.packs`."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._last = 0
        self.entries: tuple[Entry, ...] = ()
        for pack in session.settings.pack_paths:
            entry = Entry(self._next(), str(pack), Path(pack))
            self.entries += (replace(entry, summary=_summary(entry)),)

    @property
    def called(self) -> dict[str, str]:
        """What packs are called, by their path."""
        return {str(entry.path): entry.name for entry in self.entries}

    def in_plain_words(self, line: str) -> str:
        """A line with the names that people know in place of paths of ours."""
        for entry in self.entries:
            if entry.upload:
                line = line.replace(str(entry.path), entry.name)
        return line

    def check(self, number: int) -> str:
        """Read all of a file that was sent that a banner may need; what it holds, in words.

        Raises PackError in the words that the commands use, by the name the user knows.
        """
        upload = uploads_of(self._session).get(number, "pack")
        try:
            return _contents(upload.path, self._session.settings.format)
        except DraperyError as error:
            raise PackError(str(error).replace(str(upload.path), upload.name)) from None

    def adopt(self, number: int, summary: str = "") -> Entry:
        """Lay a file that was sent on top of the others. Raises DesignError or PackError."""
        upload = uploads_of(self._session).get(number, "pack")
        entry = Entry(self._next(), upload.name, upload.path, number, summary=summary)
        self._keep((*self.entries, entry))
        return entry

    def refuse(self, number: int) -> None:
        """Forget a file that was sent and is no pack."""
        uploads_of(self._session).remove(number)

    def switch(self, number: int) -> None:
        """Let a pack count, or no longer. Raises PackError, DesignError."""
        self._change(number, lambda entry: replace(entry, on=not entry.on))

    def move(self, number: int, by: int) -> None:
        """Put a pack higher by so many places, or lower. Raises PackError, DesignError."""
        place = self._place(number)
        rest = [*self.entries]
        entry = rest.pop(place)
        rest.insert(max(0, min(len(rest), place + by)), entry)
        self._keep(tuple(rest))

    def remove(self, number: int) -> None:
        """Take a pack away; a file that was sent goes. Raises PackError, DesignError."""
        gone = self.entries[self._place(number)]
        self._keep(tuple(entry for entry in self.entries if entry is not gone))
        if gone.upload:
            uploads_of(self._session).remove(gone.upload)

    def path_of(self, number: int) -> Path:
        """Where a pack lies. Raises DesignError."""
        return self.entries[self._place(number)].path

    def _change(self, number: int, change: Callable[[Entry], Entry]) -> None:
        place = self._place(number)
        changed = change(self.entries[place])
        self._keep((*self.entries[:place], changed, *self.entries[place + 1 :]))

    def _keep(self, entries: tuple[Entry, ...]) -> None:
        before, self.entries = self.entries, entries
        try:
            self._session.adjust(packs=tuple(entry.path for entry in entries if entry.on))
        except DraperyError as error:
            line = self.in_plain_words(str(error))
            self.entries = before
            raise PackError(line) from None

    def _place(self, number: object) -> int:
        for place, entry in enumerate(self.entries):
            if entry.number == number:
                return place
        raise DesignError("the pack is not here any more; send it again")

    def _next(self) -> int:
        self._last += 1
        return self._last


_SHELVES: dict[str, PackStore] = {}


def shelf_of(session: Session) -> PackStore:
    """The packs of a session."""
    if session.token not in _SHELVES:
        _SHELVES[session.token] = PackStore(session)
        session.on_close(lambda: _SHELVES.pop(session.token, None))
    return _SHELVES[session.token]


def _summary(entry: Entry) -> str:
    try:
        return _contents(entry.path, None)
    except DraperyError:
        return "cannot be read whole"


def _contents(path: Path, format: int | None) -> str:
    """What a pack holds of banners, in a few words; every texture is read once. PackError."""
    packs = open_packs([path], format=format)
    names = packs.patterns()
    for name in names:
        packs.sheet(name)
    packs.base_sheet()
    own = sum(packs.level(name) == 1 for name in names)
    return "1 pattern" if own == 1 else f"{own or 'no'} patterns"
