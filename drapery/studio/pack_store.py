"""The packs of a tab: the list, its order, and which packs are on."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from drapery import DesignError, DraperyError, PackError
from drapery.packs import open_packs
from drapery.studio.document import Document
from drapery.studio.uploads import Uploads

OWN_ART = "taken from our own art"
"""Words of the warning that names what a pack lacks; the summary says that already."""


@dataclass(frozen=True)
class PackContents:
    """What a pack has. summary: in a few words. warnings: one line each, as of the commands."""

    summary: str = ""
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class PackEntry:
    """One pack.

    name: what the user calls it: the path that was given, or the name of the uploaded file.
    upload: the number of the uploaded file, 0 if the studio was started with the pack.
    on: whether it is used.
    """

    number: int
    name: str
    path: Path
    upload: int = 0
    on: bool = True
    contents: PackContents = PackContents()

    @property
    def title(self) -> str:
        """The name without folders."""
        return Path(self.name).name or self.name


class PackStore:
    """The packs of one tab, lowest first; later ones have priority. Sets `settings.packs`."""

    def __init__(self, document: Document, uploads: Uploads) -> None:
        self._document = document
        self._uploads = uploads
        self._last = 0
        self.entries: tuple[PackEntry, ...] = ()
        for pack in document.settings.pack_paths:
            self.entries += (PackEntry(self._next(), str(pack), Path(pack)),)

    @property
    def names(self) -> dict[str, str]:
        """The user's names of the packs, by their path."""
        return {str(entry.path): entry.name for entry in self.entries}

    def with_names(self, line: str) -> str:
        """A line in which the user's names replace the paths of uploaded files."""
        for entry in self.entries:
            if entry.upload:
                line = line.replace(str(entry.path), entry.name)
        return line

    def check(self, number: int) -> PackContents:
        """Read everything in an uploaded file that a banner or a shield may need.

        Raises PackError with the same line as the commands; the line has the user's file name.
        """
        upload = self._uploads.get(number, "pack")
        try:
            return contents_of(upload.path, upload.name, self._document.settings.format)
        except DraperyError as error:
            raise PackError(str(error).replace(str(upload.path), upload.name)) from None

    def adopt(self, number: int, contents: PackContents = PackContents()) -> PackEntry:
        """Put an uploaded file on top of the others. Raises DesignError or PackError."""
        upload = self._uploads.get(number, "pack")
        entry = PackEntry(self._next(), upload.name, upload.path, number, contents=contents)
        self._replace((*self.entries, entry))
        return entry

    def contents_as(self, format: int | None) -> dict[int, PackContents]:
        """What each pack has, by its number, if it is read as packs of this format.

        It reads all textures, so call it in a thread.
        """
        return {entry.number: _contents_or_fault(entry, format) for entry in self.entries}

    def read_as(self, format: int | None, contents: Mapping[int, PackContents]) -> None:
        """Read the packs as the game of this pack format does; None is each pack's own format.

        contents: of `contents_as`. Notifies "packs". Raises OptionError or PackError; then nothing
        changes.
        """
        before, is_same = self.entries, format == self._document.settings.format
        self.entries = tuple(
            replace(entry, contents=contents.get(entry.number, entry.contents)) for entry in before
        )
        try:
            self._document.adjust(format=format)
        except DraperyError as error:
            self.entries = before
            raise PackError(self.with_names(str(error))) from None
        if is_same:  # so `adjust` has not notified
            self._document.notify("packs")

    def restore(self, entries: Iterable[PackEntry]) -> None:
        """Take over the packs of another tab, in place of those here, with its uploaded files.

        Raises DesignError or PackError.
        """
        restored = []
        for entry in entries:
            if entry.upload:
                upload = self._uploads.adopt(entry.path, "pack", entry.name)
                entry = replace(entry, path=upload.path, upload=upload.number)
            restored.append(replace(entry, number=self._next()))
        self._replace(tuple(restored))

    def refuse(self, number: int) -> None:
        """Remove an uploaded file that is not a pack."""
        self._uploads.remove(number)

    def switch(self, number: int) -> None:
        """Switch a pack on or off. Raises PackError, DesignError."""
        place = self._place(number)
        entry = replace(self.entries[place], on=not self.entries[place].on)
        self._replace((*self.entries[:place], entry, *self.entries[place + 1 :]))

    def move(self, number: int, by: int) -> None:
        """Move a pack up by some places, or down if negative. Raises PackError, DesignError."""
        place = self._place(number)
        rest = [*self.entries]
        entry = rest.pop(place)
        rest.insert(max(0, min(len(rest), place + by)), entry)
        self._replace(tuple(rest))

    def remove(self, number: int) -> None:
        """Remove a pack, and its uploaded file. Raises PackError, DesignError."""
        gone = self.entries[self._place(number)]
        self._replace(tuple(entry for entry in self.entries if entry is not gone))
        if gone.upload:
            self._uploads.remove(gone.upload)

    def path_of(self, number: int) -> Path:
        """The path of a pack. Raises DesignError."""
        return self.entries[self._place(number)].path

    def _replace(self, entries: tuple[PackEntry, ...]) -> None:
        before, self.entries = self.entries, entries
        try:
            self._document.adjust(packs=tuple(entry.path for entry in entries if entry.on))
        except DraperyError as error:
            line = self.with_names(str(error))
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


def _contents_or_fault(entry: PackEntry, format: int | None) -> PackContents:
    try:
        return contents_of(entry.path, entry.name, format)
    except DraperyError:  # the live cloth, which reads the pack too, says why
        return PackContents("cannot be read whole")


def contents_of(path: Path, name: str, format: int | None) -> PackContents:
    """A pack's contents for banners and shields; reads every texture once. Raises PackError.

    name: what the warnings call the pack.
    """
    packs = open_packs([path], format=format)
    names = packs.patterns()
    for pattern in names:
        packs.sheet(pattern)
        if packs.level(pattern, "shield") == 1:  # a pack may have none for shields
            packs.sheet(pattern, "shield")
    packs.base_sheet()
    packs.base("shield_base")
    own = sum(packs.level(pattern) == 1 for pattern in names)
    warnings = (line.replace(str(path), name) for line in packs.warnings() if OWN_ART not in line)
    return PackContents(f"Patterns: {own}", tuple(warnings))
