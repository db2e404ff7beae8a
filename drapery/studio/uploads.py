"""Files that a tab sends: counted and measured while they stream in, and named by us.

They lie in the session's own folder and go with it. What the sender calls a file is only ever
shown, never opened.
"""

from collections.abc import AsyncIterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.responses import JSONResponse

from drapery.errors import DesignError, DraperyError
from drapery.studio.session import Session, find_session


@dataclass(frozen=True)
class Purpose:
    """What files are sent for. most: bytes of one. count: how many may be kept at once."""

    most: int
    count: int


PURPOSES = {
    "pack": Purpose(256 << 20, 16),
    "library": Purpose(64 << 20, 1),
}
MAX_SESSION = 1 << 30
"""Bytes that one session may keep."""
MAX_NAME = 80


@dataclass(frozen=True)
class Upload:
    """A file that came in whole. name: what its sender calls it, fit to be shown."""

    number: int
    purpose: str
    name: str
    path: Path
    size: int


class Uploads:
    """The files of one session."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._folder = session.folder
        self._kept: dict[int, Upload] = {}
        self._coming: dict[int, tuple[str, int]] = {}
        self._last = 0

    async def receive(self, chunks: AsyncIterator[bytes], purpose: str, name: str) -> Upload:
        """Write a stream to a file. Raises DesignError for one beyond the limits; nothing stays."""
        shown = shown_name(name)
        limit = self._begin(purpose, shown)
        self._last += 1
        number = self._last
        path = self._folder / f"{purpose}-{number}"
        self._coming[number] = purpose, 0
        try:
            size = await self._write(chunks, path, number, limit, shown)
        except BaseException:
            path.unlink(missing_ok=True)
            raise
        finally:
            del self._coming[number]
        if self._session.closed:
            path.unlink(missing_ok=True)
            raise DesignError(f"{shown}: the page is gone; open it again")
        self._kept[number] = Upload(number, purpose, shown, path, size)
        return self._kept[number]

    def get(self, number: object, purpose: str) -> Upload:
        """The upload of a number, sent for this. Raises DesignError."""
        kept = self._kept.get(number) if isinstance(number, int) else None
        if kept is None or kept.purpose != purpose:
            raise DesignError("the file is not here any more; send it again")
        return kept

    def remove(self, number: int) -> None:
        """Forget an upload, and its file."""
        kept = self._kept.pop(number, None)
        if kept is not None:
            with suppress(OSError):  # one that a drawing still reads goes with the session
                kept.path.unlink()

    def _begin(self, purpose: str, name: str) -> int:
        """The most bytes that may come now. Raises DesignError where nothing may."""
        kept = [(upload.purpose, upload.size) for upload in self._kept.values()]
        kept += self._coming.values()
        bounds = PURPOSES[purpose]
        if sum(each == purpose for each, _ in kept) >= bounds.count:
            raise DesignError(
                f"{name}: {bounds.count} files for a {purpose} are here already; remove one first"
            )
        return bounds.most

    async def _write(
        self, chunks: AsyncIterator[bytes], path: Path, number: int, limit: int, name: str
    ) -> int:
        purpose, size = self._coming[number]
        with path.open("xb") as file:
            async for chunk in chunks:
                size += len(chunk)
                self._coming[number] = purpose, size
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
        return sum(u.size for u in self._kept.values()) + sum(n for _, n in self._coming.values())


_UPLOADS: dict[str, Uploads] = {}


def uploads_of(session: Session) -> Uploads:
    """The files that a session was sent."""
    if session.token not in _UPLOADS:
        _UPLOADS[session.token] = Uploads(session)
        session.on_close(lambda: _UPLOADS.pop(session.token, None))
    return _UPLOADS[session.token]


def shown_name(name: str) -> str:
    """A file's name as its sender gave it, without folders and on one short line."""
    last = name.replace("\\", "/").rsplit("/", 1)[-1].strip()
    plain = "".join(letter for letter in last if letter.isprintable())[:MAX_NAME]
    return plain if plain.strip(".") else "the file"


def shown_bytes(count: int) -> str:
    """`256 MiB`."""
    return f"{count >> 20} MiB" if count >= 1 << 20 else f"{count} bytes"


def add_routes(app: FastAPI) -> None:
    """`POST /upload/{token}/{purpose}?name=…` with the file as its body."""

    @app.post("/upload/{token}/{purpose}")
    async def upload(token: str, purpose: str, request: Request, name: str = "") -> JSONResponse:
        session = find_session(token)
        if session is None or purpose not in PURPOSES:
            return _refusal("no such page any more: reload it", 404)
        try:
            _check_length(request, purpose, shown_name(name))
            kept = await uploads_of(session).receive(request.stream(), purpose, name)
        except DraperyError as error:
            return _refusal(str(error), 413)
        except OSError as error:
            return _refusal(f"the file cannot be kept: {error.strerror}", 507)
        return JSONResponse({"number": kept.number})


def _refusal(line: str, status: int) -> JSONResponse:
    # Else the server would go on to take in the rest of the body, if only to drop it.
    return JSONResponse({"line": line}, status, {"Connection": "close"})


def _check_length(request: Request, purpose: str, name: str) -> None:
    """Refuse what says by itself that it is too long, before it comes; it may still lie."""
    length, most = request.headers.get("content-length", ""), PURPOSES[purpose].most
    if length.isdigit() and int(length[:20]) > most:
        raise DesignError(f"{name} is over {shown_bytes(most)}; send a smaller one")
