"""The studio's server: its page, the pictures and streams of its sessions, and the guard."""

import asyncio
import socket
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path
from urllib.parse import urlencode

import uvicorn
from fastapi import FastAPI, HTTPException, Response
from nicegui import ui

from drapery.errors import DraperyError, OutputError
from drapery.settings import Settings
from drapery.studio import page
from drapery.studio.art import face_png, pattern_sheet
from drapery.studio.guard import LOOPBACK, Guard
from drapery.studio.session import Session, close_all, find_session
from drapery.studio.sketch import banner_of
from drapery.studio.upload_queue import incoming_of

RECONNECT = 2.0
"""How long a session waits for its tab to come back [s]."""

ROUTES: tuple[str, ...] = (
    "downloads",
    "uploads",
    "upload_queue",
    "stream",
)
"""Modules of this room with an `add_routes(app)` of their own."""


@dataclass(frozen=True)
class StudioConfig:
    """What the studio was started with.

    settings: what every session begins with. library: the file of saved designs.
    """

    settings: Settings = field(default_factory=Settings)
    library: Path | None = None


def make_app(
    house: StudioConfig, *, hosts: frozenset[str] | None = LOOPBACK, token: str | None
) -> Guard:
    """The studio as an ASGI application; one in a process."""
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None, lifespan=_until_the_end)
    _add_pictures(app)
    for name in ROUTES:
        import_module(f"drapery.studio.{name}").add_routes(app)
    page.house = house
    ui.run_with(
        app,
        root=None,
        title="Drapery Studio",
        dark=None,
        language="en-US",
        favicon="🏳️",
        tailwind=False,
        reconnect_timeout=RECONNECT,
        show_welcome_message=False,
    )
    return Guard(app, hosts, token)


@asynccontextmanager
async def _until_the_end(_: FastAPI) -> AsyncIterator[None]:
    yield
    close_all()


def session_of(token: str) -> Session:
    """The session of a request's token; unknown ones are 404."""
    session = find_session(token)
    if session is None:
        raise HTTPException(404, "no such session: reload the page")
    return session


def _add_pictures(app: FastAPI) -> None:
    @app.get("/face/{token}.png")
    def face(token: str) -> Response:
        session = session_of(token)
        return _picture(lambda: face_png(banner_of(session.sketch), session.packs()), "no-store")

    @app.get("/steps/{token}/{count}.png")
    def step(token: str, count: int) -> Response:
        session = session_of(token)
        whole = banner_of(session.sketch)
        part = replace(whole, layers=whole.layers[: max(0, count)])
        return _picture(lambda: face_png(part, session.packs(), 2), "no-store")

    @app.get("/found/{token}/{number}.png")
    def found(token: str, number: int) -> Response:
        session = session_of(token)
        banners = incoming_of(session).found
        if not 0 <= number < len(banners):
            raise HTTPException(404, "no such banner")
        return _picture(lambda: face_png(banners[number].banner, session.packs(), 2), "no-store")

    @app.get("/patterns/{token}.png")
    def patterns(token: str, base: str, dye: str) -> Response:
        session = session_of(token)
        return _picture(lambda: pattern_sheet(session.packs(), base, dye), "private, max-age=3600")


def _picture(draw: Callable[[], bytes], keep: str) -> Response:
    try:
        return Response(draw(), media_type="image/png", headers={"Cache-Control": keep})
    except DraperyError as error:
        raise HTTPException(422, str(error)) from None


def run(
    house: StudioConfig,
    *,
    host: str,
    port: int,
    token: str | None,
    ready: Callable[[str], None],
) -> None:
    """Serve until the process is told to stop. Raises OutputError for a port that is taken.

    ready: takes the page's address as soon as it answers.
    """
    local = host in LOOPBACK
    guarded = make_app(house, hosts=LOOPBACK if local else None, token=token)
    config = uvicorn.Config(
        guarded,
        log_level="error",
        ws_max_size=1 << 20,
        timeout_graceful_shutdown=1,
        server_header=False,
        # Positions of a moving cloth hardly shrink, and shrinking them takes longer than sending.
        ws_per_message_deflate=False,
    )
    listening = _listen(host, port)
    named = f"[{host}]" if ":" in host else host
    query = f"?{urlencode({'token': token})}" if token else ""
    address = f"http://{named}:{listening.getsockname()[1]}/{query}"
    asyncio.run(_serve(uvicorn.Server(config), listening, lambda: ready(address)))


async def _serve(
    server: uvicorn.Server, listening: socket.socket, ready: Callable[[], None]
) -> None:
    serving = asyncio.create_task(server.serve([listening]))
    while not (server.started or serving.done()):
        await asyncio.sleep(0.01)
    if server.started:
        ready()
    await serving


def _listen(host: str, port: int) -> socket.socket:
    try:
        return socket.create_server(
            (host, port), family=socket.AF_INET6 if ":" in host else socket.AF_INET
        )
    except (OSError, UnicodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "no address"
        raise OutputError(f"{host}:{port}: {why}; use another --port or --host") from None
