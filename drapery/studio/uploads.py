"""Files that a tab sends: the studio checks count and size while they arrive, and names them.

The studio stores them in the tab's folder and removes them with it. It shows the sender's name of a
file and takes the ending from it, if the purpose has this ending; it never opens that name.
"""

import os
import shutil
from collections.abc import AsyncIterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from drapery import DesignError
from drapery.errors import counted
from drapery.file_formats import endings_read
from drapery.match import PICTURE_FORMATS
from drapery.studio.document import Document


@dataclass(frozen=True)
class Purpose:
    """What files are sent for.

    max_bytes: the limit of one file. max_count: the most files at the same time. endings: the
    endings that a stored file may have; some readers choose a form by the ending.
    """

    max_bytes: int
    max_count: int
    endings: frozenset[str] = frozenset()


_DESIGN_ENDINGS = frozenset(
    (
        *(".json", ".mcfunction", ".snbt", ".txt"),
        *(".dat", ".litematic", ".mca", ".mcstructure", ".nbt", ".schem", ".schematic"),
    )
)

MAX_LIBRARY = 64 << 20
"""The largest JSON export of a library [bytes]."""
PURPOSES = {
    "pack": Purpose(256 << 20, 16),
    "library": Purpose(MAX_LIBRARY, 1),
    "garment": Purpose(1 << 16, 1, frozenset((".toml",))),
    "skin": Purpose(4 << 20, 1, frozenset((".png",))),
    "picture": Purpose(64 << 20, 2, frozenset(endings_read(PICTURE_FORMATS))),
    # A region file with all its chunks is about 16 MiB.
    "design": Purpose(64 << 20, 8, _DESIGN_ENDINGS),
}
MAX_SESSION = 1 << 30
"""The most bytes of all files of one tab."""
MAX_NAME = 80


@dataclass(frozen=True)
class Upload:
    """A file that has arrived completely. name: the sender's name for it, safe to show."""

    number: int
    purpose: str
    name: str
    path: Path
    size: int


class Uploads:
    """The files of one tab."""

    def __init__(self, document: Document) -> None:
        self._document = document
        self._stored: dict[int, Upload] = {}
        self._arriving: dict[int, tuple[str, int]] = {}
        self._last = 0

    async def receive(self, chunks: AsyncIterator[bytes], purpose: str, name: str) -> Upload:
        """Write a stream to a new file.

        Raises DesignError for a stream that exceeds the limits; then removes the file.
        """
        shown = shown_name(name)
        self._check_open(shown)
        limit = self._check_count(purpose, shown)
        self._last += 1
        number = self._last
        ending = PurePosixPath(shown).suffix.lower()
        stored = ending if ending in PURPOSES[purpose].endings else ""
        path = self._document.folder / f"{purpose}-{number}{stored}"
        self._arriving[number] = purpose, 0
        try:
            size = await self._write(chunks, path, number, limit, shown)
        except BaseException:
            path.unlink(missing_ok=True)
            raise
        finally:
            del self._arriving[number]
        if self._document.closed:
            path.unlink(missing_ok=True)
        self._check_open(shown)
        self._stored[number] = Upload(number, purpose, shown, path, size)
        return self._stored[number]

    def adopt(self, path: Path, purpose: str, name: str) -> Upload:
        """The file that another tab has received, in this tab's folder too.

        Raises DesignError if there are too many files, or if the file is gone.
        """
        self._check_open(name)
        self._check_count(purpose, name)
        self._last += 1
        target = self._document.folder / f"{purpose}-{self._last}{path.suffix}"
        try:
            link_or_copy(path, target)
        except OSError:
            raise DesignError(f"{name}: the file is not here any more; send it again") from None
        upload = Upload(self._last, purpose, name, target, target.stat().st_size)
        self._stored[upload.number] = upload
        return upload

    def get(self, number: object, purpose: str) -> Upload:
        """The upload with this number and purpose. Raises DesignError if there is none."""
        upload = self._stored.get(number) if isinstance(number, int) else None
        if upload is None or upload.purpose != purpose:
            raise DesignError("the file is not here any more; send it again")
        return upload

    def remove(self, number: int) -> None:
        """Forget an upload, and delete its file."""
        upload = self._stored.pop(number, None)
        if upload is not None:
            with suppress(OSError):  # if a thread still reads it, closing the tab removes it
                upload.path.unlink()

    def _check_open(self, name: str) -> None:
        if self._document.closed:
            raise DesignError(f"{name}: the page is gone; open it again")

    def _check_count(self, purpose: str, name: str) -> int:
        """The most bytes that may arrive now. Raises DesignError if there are too many files."""
        present = [upload.purpose for upload in self._stored.values()]
        present += [each for each, _ in self._arriving.values()]
        bounds = PURPOSES[purpose]
        if present.count(purpose) >= bounds.max_count:
            raise DesignError(
                f"{name}: {bounds.max_count} files of this kind are here already; remove one first"
            )
        return bounds.max_bytes

    async def _write(
        self, chunks: AsyncIterator[bytes], path: Path, number: int, limit: int, name: str
    ) -> int:
        purpose, size = self._arriving[number]
        with path.open("xb") as file:
            async for chunk in chunks:
                size += len(chunk)
                self._arriving[number] = purpose, size
                if size > limit:
                    raise DesignError(f"{name} is over {shown_bytes(limit)}; send a smaller one")
                if self._total() > MAX_SESSION:
                    raise DesignError(
                        f"{name}: this page's files are over {shown_bytes(MAX_SESSION)} together;"
                        " remove some first"
                    )
                file.write(chunk)
        if not size:
            raise DesignError(f"{name} is empty; send it again")
        return size

    def _total(self) -> int:
        stored = sum(upload.size for upload in self._stored.values())
        return stored + sum(size for _, size in self._arriving.values())


def link_or_copy(source: Path, target: Path) -> None:
    """Give a received file a second path. It never changes, so a link serves, without delay.

    Raises OSError.
    """
    try:
        os.link(source, target)
    except OSError:  # the folder's file system has no links
        shutil.copyfile(source, target)


def shown_name(name: str) -> str:
    """The sender's name of a file, without folders and on one short line."""
    last = name.replace("\\", "/").rsplit("/", 1)[-1].strip()
    plain = "".join(letter for letter in last if letter.isprintable())[:MAX_NAME]
    return plain if plain.strip(".") else "the file"


def shown_bytes(count: int) -> str:
    """A size as text, for example `256 MiB`."""
    return f"{count >> 20} MiB" if count >= 1 << 20 else counted(count, "byte")
