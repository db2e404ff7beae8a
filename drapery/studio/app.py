"""The studio's server: its page, the routes of its sessions, and the guard."""

import asyncio
import socket
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from urllib.parse import urlencode

import uvicorn
from fastapi import FastAPI
from nicegui import app as nicegui_app, core, ui
from starlette.concurrency import run_in_threadpool

from drapery.serve.server import address_of, listen
from drapery.studio import page, routes
from drapery.studio.guard import LOOPBACK, Guard
from drapery.studio.kernel_build import KernelBuild
from drapery.studio.session import Sessions, StudioConfig

RECONNECT = 2.0
"""How long a session waits for its tab to come back [s]."""
BUSY = 120.0
"""How long a page may be too busy to answer [s]. A closed tab closes its socket at once, and the
server's own pings find a network that is gone."""
PRUNE_INTERVAL = 60.0
"""How often old kept work is dropped [s]."""


def make_app(
    studio: StudioConfig, *, hosts: frozenset[str] | None = LOOPBACK, token: str | None
) -> Guard:
    """The studio as an ASGI application. One per process: its page framework is global."""
    sessions = Sessions(studio)
    building = KernelBuild(sessions)

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        core.sio.eio.ping_timeout = BUSY
        pruning = asyncio.create_task(prune_regularly(sessions, PRUNE_INTERVAL))
        making = asyncio.create_task(run_in_threadpool(sessions.make_first_scene))
        yield
        pruning.cancel()
        await making
        await building.stop()
        sessions.close_all()

    app = FastAPI(
        docs_url=None,
        redoc_url=None,
        openapi_url=None,
        lifespan=lifespan,
        redirect_slashes=False,  # a redirect would lead to whatever host the request names
    )
    nicegui_app.router.redirect_slashes = False
    routes.add_routes(app, sessions, building)
    page.add_page(sessions)
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
    # A bar across the page for each file that is sent; the field of the file has one with a name.
    nicegui_app.config.quasar_config["loadingBar"]["skipHijack"] = True
    return Guard(app, hosts, token)


async def prune_regularly(sessions: Sessions, interval: float) -> None:
    """Drop work that was kept for long enough, every `interval` seconds."""
    while True:
        await asyncio.sleep(interval)
        sessions.prune()


def run(
    studio: StudioConfig,
    *,
    host: str,
    port: int,
    token: str | None,
    ready: Callable[[str], None],
) -> None:
    """Serve until the process is stopped. Raises OutputError for a port that is in use.

    ready: a callable; it gets the page's address as soon as the server answers.
    """
    local = host in LOOPBACK
    guarded = make_app(studio, hosts=LOOPBACK if local else None, token=token)
    config = uvicorn.Config(
        guarded,
        log_level="error",
        ws_max_size=1 << 20,
        timeout_graceful_shutdown=1,
        server_header=False,
    )
    listening = listen(host, port)
    query = f"?{urlencode({'token': token})}" if token else ""
    address = f"{address_of(listening)}/{query}"
    # It takes uvloop, which `asyncio.run` would not, and which sends a frame at half the cost.
    _Server(config, lambda: ready(address)).run(sockets=[listening])


class _Server(uvicorn.Server):
    """A server that calls `ready` as soon as it answers."""

    def __init__(self, config: uvicorn.Config, ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._ready = ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """See `uvicorn.Server`."""
        await super().startup(sockets)
        if self.started:
            self._ready()
