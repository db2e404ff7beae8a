"""Designs that come from outside: pasted text, and files dropped on the page."""

from collections.abc import Callable
from dataclasses import replace

from starlette.concurrency import run_in_threadpool

from drapery import DraperyError, FoundBanner, parse_banners, read_designs
from drapery.banner import ItemDetails
from drapery.studio.document import Document
from drapery.studio.sketch import MAX_TITLE
from drapery.studio.uploads import Uploads
from drapery.studio.warning_log import collected_warnings

MAX_FOUND = 200
"""The most banners of one file that the user can choose from."""

MAX_NOTES = 3
"""The most warnings of one file that are shown."""


class UploadQueue:
    """The result of the last read.

    found: the banners. line: the error, or "". notes: the warnings. name: the file's name, or "".
    beside: whether the text field was read; then the page shows the line next to that field.
    details: what a text says of its item beside the design, or None.
    """

    def __init__(self, document: Document, uploads: Uploads) -> None:
        self._document = document
        self.found: tuple[FoundBanner, ...] = ()
        self.line = ""
        self.notes: tuple[str, ...] = ()
        self.name = ""
        self.beside = False
        self.details: ItemDetails | None = None
        self._uploads = uploads

    def read_text(self, text: str, *, beside: bool = False) -> None:
        """Read a text in any form; the text is never used as the path of a file."""
        found, line, notes = _read(lambda: parse_banners(text))
        self._finish("", found, line, notes, beside=beside)

    @property
    def title(self) -> str:
        """The name of the item in the text, or ""."""
        title = self.details.title.strip()[:MAX_TITLE] if self.details else ""
        return title if title.isprintable() else ""

    async def read_file(self, number: int) -> None:
        """Read an uploaded file and remove it. Raises DesignError if there is none."""
        upload = self._uploads.get(number, "design")
        path, name = upload.path, upload.name
        try:
            found, line, notes = await run_in_threadpool(_read, lambda: read_designs(path))
        finally:
            self._uploads.remove(number)
        found = [replace(each, where=each.where.replace(path.name, name)) for each in found]
        self._finish(name, found, line.replace(str(path), name).replace(path.name, name), notes)

    def _finish(
        self,
        name: str,
        found: list[FoundBanner],
        line: str,
        notes: list[str],
        *,
        beside: bool = False,
    ) -> None:
        self.found, self.line, self.name = tuple(found), line, name
        self.details = found[0].details if len({each.banner for each in found}) == 1 else None
        self.notes, self.beside = tuple(notes[:MAX_NOTES]), beside
        self._document.notify("read")


def _read(read: Callable[[], list[FoundBanner]]) -> tuple[list[FoundBanner], str, list[str]]:
    """The banners that were found, the error, and the warnings."""
    with collected_warnings() as notes:
        try:
            return read(), "", notes
        except DraperyError as error:
            return [], str(error), notes
