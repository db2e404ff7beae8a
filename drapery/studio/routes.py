"""What a tab fetches and sends over HTTP: pictures, files and designs.

Every address holds the token of an open session; no part of an address is a file's path.
"""

import gzip
from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType
from typing import Annotated, Literal
from urllib.parse import quote

from fastapi import FastAPI, HTTPException, Query, Request, Response
from fastapi.responses import FileResponse, JSONResponse, PlainTextResponse
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect

from drapery import DesignError, DraperyError, OptionError
from drapery.file_formats import KIND_NAMES, format_of
from drapery.packs import Packs, open_packs
from drapery.studio.art import pattern_names, style_png
from drapery.studio.components import viewer_module
from drapery.studio.kernel_build import KernelBuild
from drapery.studio.played import SceneFile, kernel_file, scene_file
from drapery.studio.session import Session, Sessions
from drapery.studio.sketch import banner_of
from drapery.studio.translation import translated
from drapery.studio.uploads import PURPOSES, shown_bytes, shown_name
from drapery.styles import style_names
from drapery.web.face_file import face_bytes
from drapery.web.wasm.image import WasmBuildError

CACHING = "private, max-age=3600"
"""The addresses of pictures change whenever their content does."""

RENDERED = "A picture by the renderer, which cannot be turned or pulled."

Text = Annotated[str, Query(max_length=4000)]
Scale = Annotated[int, Query(ge=1, le=8)]


def add_routes(app: FastAPI, sessions: Sessions, building: KernelBuild) -> None:
    """Serve the open sessions; an unknown token gets status 404.

    building: what makes the module of kernels where there is none.
    """

    def session_of(token: str) -> Session:
        session = sessions.find(token)
        if session is None:
            raise HTTPException(404, "no such session: reload the page")
        return session

    _add_pictures(app, session_of)
    _add_live(app, sessions, session_of, building)
    _add_player(app)
    _add_downloads(app, session_of)
    _add_uploads(app, session_of)


SessionOf = Callable[[str], Session]
"""The session with this token; raises HTTPException."""


def _add_pictures(app: FastAPI, session_of: SessionOf) -> None:
    @app.get("/faces/{token}/{kind}.bin")
    def faces(token: str, kind: Literal["banner", "shield"], pack: str = "now") -> Response:
        session = session_of(token)
        try:
            packs = _packs(session, pack)
            data = face_bytes(kind, packs, pattern_names(packs))
        except DraperyError as error:
            return _not_shown(session, error)
        return _compressed(data, "application/octet-stream")

    @app.get("/styles/{token}/{name}.png")
    def style(token: str, name: str) -> Response:
        session = session_of(token)
        if name not in style_names():  # `find_style` would read a file
            raise HTTPException(404, "no such style")
        banner = banner_of(session.sketch)

        def draw() -> bytes:
            return style_png(banner, session.packs(), name, lambda: not session.closed)

        return _picture(session, draw)


def _add_live(
    app: FastAPI, sessions: Sessions, session_of: SessionOf, building: KernelBuild
) -> None:
    """What the viewer plays, and pictures of what cannot be played."""

    async def scene(session: Session, make: Callable[[], SceneFile]) -> Response:
        try:
            file = await run_in_threadpool(make)
        except WasmBuildError:
            return PlainTextResponse(translated(await building.start(), session.language), 422)
        except OptionError:  # it is not the user's fault
            return PlainTextResponse(translated(RENDERED, session.language), 422)
        except DraperyError as error:
            return _not_shown(session, error)
        return _compressed(file.data, "application/octet-stream", {"Kernels": file.kernels})

    @app.get("/live/{key}.bin")
    async def shared_scene(key: str) -> Response:
        for session in sessions:
            shown = session.viewport.shared_scene(key)
            if shown is not None:  # whatever this tab shows when it is made
                return await scene(session, partial(scene_file, key, shown))
        return Response(status_code=204)

    @app.get("/live/{token}/{key}.bin")
    async def own_scene(token: str, key: str) -> Response:
        viewport = session_of(token).viewport
        if not viewport.shows(key):
            return Response(status_code=204)
        return await scene(session_of(token), partial(viewport.scene, key))

    @app.get("/live/{token}/{key}.{ending}")
    def picture(token: str, key: str, ending: str) -> Response:
        session = session_of(token)
        if not session.viewport.shows(key):
            return Response(status_code=204)
        try:
            kind = format_of(f"{key}.{ending}", "still", "loop").media_type
            data = session.viewport.picture(key)
        except DraperyError as error:
            if not session.viewport.shows(key):  # another picture took its place meanwhile
                return Response(status_code=204)
            return _not_shown(session, error)
        return Response(data, media_type=kind, headers={"Cache-Control": CACHING})


def _add_player(app: FastAPI) -> None:
    """What plays the scenes: their kernels, and the module of the viewer."""

    @app.get("/cloth.wasm")
    def kernels(module: str, kernels: Text) -> Response:
        try:
            return _compressed(kernel_file(module, kernels), "application/wasm")
        except (KeyError, WasmBuildError):
            raise HTTPException(404, "no such kernels: reload the page") from None

    @app.get("/viewer.js")
    def viewer() -> Response:
        return _compressed(gzip.compress(viewer_module().encode(), mtime=0), "text/javascript")


def _compressed(data: bytes, kind: str, more: Mapping[str, str] = MappingProxyType({})) -> Response:
    headers = {"Cache-Control": CACHING, "Content-Encoding": "gzip", **more}
    return Response(data, media_type=kind, headers=headers)


def _not_shown(session: Session, error: DraperyError) -> Response:
    line = translated(session.pack_store.with_names(str(error)), session.language)
    return PlainTextResponse(line, 422)


def _picture(session: Session, draw: Callable[[], bytes]) -> Response:
    try:
        return Response(draw(), media_type="image/png", headers={"Cache-Control": CACHING})
    except DraperyError as error:
        raise HTTPException(422, session.pack_store.with_names(str(error))) from None


def _packs(session: Session, pack: str) -> Packs:
    """`now`: all packs of the tab; `own`: only Drapery's art; a number: only that pack."""
    if pack == "now":
        return session.packs()
    paths = [] if pack == "own" else [session.pack_store.path_of(_number(pack))]
    return open_packs(paths, format=session.settings.format)


def _number(text: str) -> int:
    return int(text) if text.isascii() and text.isdigit() and len(text) < 9 else -1


def _add_downloads(app: FastAPI, session_of: SessionOf) -> None:
    @app.get("/export/{token}/{number}")
    def export(token: str, number: int) -> Response:
        export = session_of(token).exports.finished(number)
        if export is None:
            raise HTTPException(404, "no such export: make it again")
        media_type = format_of(export.path, *KIND_NAMES).media_type
        return FileResponse(export.path, media_type=media_type, headers=_attachment(export.name))

    @app.get("/library/{token}")
    def library(token: str) -> Response:
        session = session_of(token)
        try:
            data = session.library().dump()
        except DraperyError as error:
            raise HTTPException(409, str(error)) from None
        headers = _attachment("drapery-library.json")
        return Response(data, media_type="application/json", headers=headers)


def _attachment(name: str) -> dict[str, str]:
    disposition = f"attachment; filename*=UTF-8''{quote(name, safe='')}"
    return {"Content-Disposition": disposition, "Cache-Control": "no-store"}


def _add_uploads(app: FastAPI, session_of: SessionOf) -> None:
    @app.post("/upload/{token}/{purpose}")
    async def upload(token: str, purpose: str, request: Request, name: str = "") -> JSONResponse:
        try:
            session = session_of(token)
            if purpose not in PURPOSES:
                raise HTTPException(404, "no such purpose")
            _check_length(request, purpose, shown_name(name))
            upload = await session.uploads.receive(request.stream(), purpose, name)
        except HTTPException as error:
            return _refusal(error.detail, error.status_code)
        except DraperyError as error:
            return _refusal(str(error), 413)
        except ClientDisconnect:
            return _refusal("the file was not sent whole; send it again", 400)
        except OSError as error:
            return _refusal(f"the file cannot be stored: {error.strerror}", 507)
        return JSONResponse({"number": upload.number})


def _refusal(line: str, status: int) -> JSONResponse:
    # Otherwise the server would read and discard the rest of the body.
    return JSONResponse({"line": line}, status, {"Connection": "close"})


def _check_length(request: Request, purpose: str, name: str) -> None:
    """Refuse a body that is too long according to its header. Raises DesignError."""
    length, maximum = request.headers.get("content-length", ""), PURPOSES[purpose].max_bytes
    if length.isdigit() and int(length[:20]) > maximum:
        raise DesignError(f"{name} is over {shown_bytes(maximum)}; send a smaller one")
