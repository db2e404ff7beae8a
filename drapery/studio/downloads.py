"""What a tab may fetch: its finished export, the library, and its packs side by side."""

from urllib.parse import quote

from fastapi import FastAPI, HTTPException, Response
from fastapi.responses import FileResponse

from drapery.banner.packs import Packs, open_packs
from drapery.errors import DraperyError
from drapery.studio.art import face_png, pattern_sheet
from drapery.studio.exports import exports_of
from drapery.studio.pack_store import shelf_of
from drapery.studio.session import Session, find_session
from drapery.studio.sketch import banner_of

COLUMNS = 9
"""Patterns in a row of those that are compared."""
CELL = (20, 40)
"""Width and height of one pattern in a sheet of them [pixels]."""
GAP = 2

KINDS = {
    ".png": "image/png",
    ".apng": "image/apng",
    ".gif": "image/gif",
    ".webp": "image/webp",
    ".mp4": "video/mp4",
    ".glb": "model/gltf-binary",
    ".json": "application/json",
}


def add_routes(app: FastAPI) -> None:
    """All of them want the token of an open session; nothing else of an address names a file."""

    @app.get("/export/{token}/{number}")
    def export(token: str, number: int) -> Response:
        work = exports_of(_session(token)).finished(number)
        if work is None:
            raise HTTPException(404, "no such export: make it again")
        return FileResponse(
            work.path, media_type=KINDS[work.path.suffix], headers=_named(work.name)
        )

    @app.get("/library/{token}")
    def library(token: str) -> Response:
        from drapery.studio.page import house
        from drapery.studio.shared_library import library_at

        _session(token)
        try:
            data = library_at(house.library).dump()
        except DraperyError as error:
            raise HTTPException(409, str(error)) from None
        return Response(data, media_type=KINDS[".json"], headers=_named("drapery-library.json"))

    @app.get("/compare/{token}/{pack}/{what}.png")
    def compare(
        token: str, pack: str, what: str, base: str = "white", dye: str = "black"
    ) -> Response:
        session = _session(token)
        try:
            data = _compared(session, _packs(session, pack), what, base, dye)
        except DraperyError as error:
            raise HTTPException(422, shelf_of(session).in_plain_words(str(error))) from None
        return Response(data, media_type=KINDS[".png"], headers={"Cache-Control": "no-store"})


def _session(token: str) -> Session:
    session = find_session(token)
    if session is None:
        raise HTTPException(404, "no such session: reload the page")
    return session


def _named(name: str) -> dict[str, str]:
    disposition = f"attachment; filename*=UTF-8''{quote(name, safe='')}"
    return {"Content-Disposition": disposition, "Cache-Control": "no-store"}


def _packs(session: Session, pack: str) -> Packs:
    """`now` is what the page draws with, `own` our own art, a number one pack by itself."""
    if pack == "now":
        return session.packs()
    paths = [] if pack == "own" else [shelf_of(session).path_of(_number(pack))]
    return open_packs(paths, format=session.settings.format)


def _number(text: str) -> int:
    return int(text) if text.isascii() and text.isdigit() and len(text) < 9 else -1


def _compared(session: Session, packs: Packs, what: str, base: str, dye: str) -> bytes:
    if what == "face":
        return face_png(banner_of(session.sketch), packs)
    if what == "patterns":
        return _rows(pattern_sheet(packs, base, dye))
    raise HTTPException(404, "no such picture")


def _rows(sheet: bytes) -> bytes:
    """A sheet of patterns side by side, in rows of COLUMNS."""
    import numpy as np

    from drapery.banner.packs.png import read_png
    from drapery.render.encode.png import png_bytes

    texels = read_png(sheet, "the patterns")
    width, height = CELL
    cells = texels.reshape(height, -1, width, 4).swapaxes(0, 1)
    rows = -(-len(cells) // COLUMNS)
    page = np.zeros((rows * (height + GAP), COLUMNS * (width + GAP), 4), np.uint8)
    for number, cell in enumerate(cells):
        top, left = number // COLUMNS * (height + GAP), number % COLUMNS * (width + GAP)
        page[top : top + height, left : left + width] = cell
    return png_bytes(page)
