"""Designs that come from outside: pasted text, and files dropped on the page."""

import warnings
from collections.abc import Callable
from pathlib import Path, PurePosixPath
from urllib.parse import parse_qsl, urlsplit

from fastapi import FastAPI, HTTPException, Request, Response
from starlette.concurrency import run_in_threadpool

from drapery.banner.formats import read_designs
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.registry import parse_banners
from drapery.errors import DraperyError
from drapery.studio.session import Session, find_session
from drapery.studio.share import read_link
from drapery.studio.sketch import banner_of

MAX_FILE = 64 << 20
"""The largest file of designs [bytes]; a region with all its chunks is about 16 MiB."""

MAX_ADDRESS = 20_000
"""The longest link that is read as one."""

MAX_FOUND = 200
"""The most banners of one file that are offered."""

_SUFFIXES = (
    *(".json", ".mcfunction", ".snbt", ".txt"),
    *(".dat", ".litematic", ".mca", ".mcstructure", ".nbt", ".schem", ".schematic"),
)


class UploadQueue:
    """What was read last.

    found: the banners. line: what was wrong. notes: what was warned of. name: of the file, or "".
    beside: whether it was read from the field beside which the line is shown.
    """

    def __init__(self) -> None:
        self.found: tuple[FoundBanner, ...] = ()
        self.line = ""
        self.notes: tuple[str, ...] = ()
        self.name = ""
        self.beside = False
        self._listeners: list[Callable[[], None]] = []

    def listen(self, call: Callable[[], None]) -> None:
        """Call this whenever something has been read."""
        self._listeners.append(call)

    def read_text(self, text: str, *, beside: bool = False) -> None:
        """Read a text in any form; never a file of this machine, whatever the text says."""
        self.beside = beside
        self._take("", *_read(lambda: _of_text(text)))

    async def read_file(self, path: Path, name: str) -> None:
        """Read a file that came under a name."""
        self.beside = False
        found, line, notes = await run_in_threadpool(_read, lambda: read_designs(path))
        self._take(name, found, line.replace(str(path), name).replace(path.name, name), notes)

    def _take(self, name: str, found: list[FoundBanner], line: str, notes: list[str]) -> None:
        self.found, self.line, self.name = tuple(found), line, name
        self.notes = tuple(notes[:3])
        for call in self._listeners:
            call()


def _of_text(text: str) -> list[FoundBanner]:
    """The banners of a text in any form, or of a link to a design of a studio."""
    address = text.strip()
    if address.startswith(("http://", "https://")) and len(address) < MAX_ADDRESS:
        query = dict(parse_qsl(urlsplit(address).query))
        if set(query) == {"d"}:
            return [FoundBanner(banner_of(read_link(query["d"])[0]))]
    return parse_banners(text)


def _read(read: Callable[[], list[FoundBanner]]) -> tuple[list[FoundBanner], str, list[str]]:
    """What was found, what was wrong, and what was warned of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        try:
            found, line = read(), ""
        except DraperyError as error:
            found, line = [], str(error)
    return found, line, [str(each.message) for each in caught]


_INCOMING: dict[str, UploadQueue] = {}


def incoming_of(session: Session) -> UploadQueue:
    """What came into a session."""
    if session.token not in _INCOMING:
        _INCOMING[session.token] = UploadQueue()
        session.on_close(lambda: _INCOMING.pop(session.token, None))
    return _INCOMING[session.token]


def add_routes(app: FastAPI) -> None:
    """Take files: the body of a POST, under our own name and within a limit."""

    @app.post("/designs/{token}")
    async def take(request: Request, token: str, name: str = "") -> Response:
        session = find_session(token)
        if session is None:
            raise HTTPException(404, "no such session: reload the page")
        incoming = incoming_of(session)
        shown = PurePosixPath(name.replace("\\", "/")).name[:80] or "the file"
        suffix = PurePosixPath(shown).suffix.lower()
        path = session.folder / f"design{suffix if suffix in _SUFFIXES else ''}"
        if await _write(request, path):
            await incoming.read_file(path, shown)
        else:
            incoming._take(shown, [], f"{shown} is over {MAX_FILE >> 20} MiB: cut it down", [])
        path.unlink(missing_ok=True)
        return Response(status_code=204)


async def _write(request: Request, path: Path) -> bool:
    """The request's body as a file; False where it is too long."""
    length = 0
    with path.open("wb") as file:
        async for chunk in request.stream():
            length += len(chunk)
            if length > MAX_FILE:
                return False
            file.write(chunk)
    return True
