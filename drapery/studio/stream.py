"""The socket between a viewer and the live cloth of its tab.

The server sends `messages`; the viewer answers when it has drawn one. At most two messages are
unanswered, so a slow viewer sees fewer moments and no queue grows. A viewer's message is a small
JSON object; the server closes the connection if a message is not valid.
"""

import asyncio
import json
import logging
import math
from contextlib import suppress
from typing import Any

import numpy as np
from fastapi import FastAPI, WebSocket, WebSocketDisconnect
from fastapi.websockets import WebSocketState

from drapery import DraperyError, OptionError
from drapery.studio.live import Ray
from drapery.studio.live_threads import in_thread
from drapery.studio.session import Session, Sessions
from drapery.studio.translation import translated
from drapery.studio.wind_controls import KEYS
from drapery.web.messages import MessageEncoder

LOG = logging.getLogger(__name__)
UNDER_WAY = 2
"""The most messages that are sent before the viewer reports that it has drawn them."""
MAX_TEXT = 2048
MAX_VIEWERS = 8
"""The most simultaneous viewers of one tab."""
UNKNOWN, ENOUGH, WRONG, BROKEN = 4404, 4429, 4400, 1011
"""Why the server closes a socket: no such tab, too many viewers, a message that is not valid, a
fault in the program."""


def _has_gone(socket: WebSocket) -> bool:
    """Whether the other end has closed the connection, or this one."""
    return WebSocketState.DISCONNECTED in (socket.client_state, socket.application_state)


class ViewerConnection:
    """The server side of one viewer's connection; it counts the messages sent and drawn."""

    def __init__(self, session: Session, which: str) -> None:
        self.viewport = session.viewport
        self.language = session.language
        self.encoder = MessageEncoder(which)
        self.hidden = False
        self.sent = self.drawn = 0
        self._line = ""
        self._shaped = False
        self._ready = asyncio.Event()

    def receive(self, message: dict[str, Any]) -> None:
        """Handle one message of the viewer. Raises ValueError if it is not valid."""
        for name, value in message.items():
            handle = getattr(self, f"on_{name}", None)
            if handle is None:
                raise ValueError(name)
            handle(value)
        self._ready.set()

    async def send_moments(self, socket: WebSocket) -> None:
        """Send each new moment as soon as the viewer is ready for it."""
        try:
            await self._send(socket)
        except Exception:
            if _has_gone(socket):
                return
            # An error in the program: the viewer may connect again.
            LOG.exception("the connection of a viewer is closed")
            with suppress(WebSocketDisconnect, RuntimeError):  # it may go at this moment
                await socket.close(BROKEN)

    async def _send(self, socket: WebSocket) -> None:
        seen = -1
        while True:
            await self._until_ready()
            await self.viewport.after(seen)
            if self.viewport.closed:
                await socket.close(UNKNOWN)
                return
            seen = self.viewport.version
            line = translated(self.viewport.fault or self.viewport.note, self.language)
            if line != self._line:
                self._line = line
                await socket.send_text(json.dumps({"line": line}))
            for message in await in_thread(self._messages):
                self.sent += 1
                await socket.send_bytes(message)

    async def _until_ready(self) -> None:
        """Wait until the viewer is visible, has sent its size, and has drawn."""
        while self.hidden or not self._shaped or self.sent - self.drawn >= UNDER_WAY:
            self._ready.clear()
            await self._ready.wait()

    def _messages(self) -> list[bytes]:
        shown = self.viewport.shown()
        try:
            return [] if shown is None else self.encoder.messages(shown)
        except DraperyError as error:
            self.viewport.fault = str(error)
            return []

    def on_drawn(self, value: Any) -> None:
        self.drawn = min(self.sent, self.drawn + int(_number(value, 0, 16)))

    def leave(self) -> None:
        """Handle the end of the connection."""
        if not self.hidden:
            self.viewport.leave()
        self.hidden = True

    def on_hidden(self, value: Any) -> None:
        if value and not self.hidden:
            self.viewport.leave()
        elif self.hidden and not value:
            self.viewport.enter()
        self.hidden = bool(value)

    def on_shape(self, value: Any) -> None:
        columns, rows = (int(_number(side, 1, 16384)) for side in _list(value, 2))
        self.viewport.size = columns, rows
        self.encoder.reframe((columns, rows))
        self._shaped = True
        self.viewport.do(lambda live: None)  # draws it again, even while it is paused

    def on_still(self, value: Any) -> None:
        self.viewport.hold_still()

    def on_keys(self, value: Any) -> None:
        keys, azimuth = _list(value, 2)
        held = tuple(key for key in KEYS if key in str(keys))
        self.viewport.press(held, _number(azimuth, -1e4, 1e4))

    def on_switch(self, value: Any) -> None:
        self.viewport.switch()

    def on_grab(self, value: Any) -> None:
        ray = _ray(value)
        self.viewport.do(lambda live: live.grab(ray))

    def on_pull(self, value: Any) -> None:
        ray = _ray(value)
        self.viewport.do(lambda live: live.pull(ray))

    def on_drop(self, value: Any) -> None:
        self.viewport.do(lambda live: live.release())


def add_routes(app: FastAPI, sessions: Sessions) -> None:
    """Serve the live cloths of all sessions."""

    @app.websocket("/live/{token}")
    async def live(socket: WebSocket, token: str, which: str = "all") -> None:
        session = sessions.find(token)
        await socket.accept()
        if session is None:
            await socket.close(UNKNOWN)
        elif session.viewport.viewers >= MAX_VIEWERS:
            await socket.close(ENOUGH)
        else:
            await _serve(socket, session, which if which in ("left", "right") else "all")


async def _serve(socket: WebSocket, session: Session, which: str) -> None:
    """Serve one viewer until it disconnects; then undo all that it did."""
    viewer, viewport = ViewerConnection(session, which), session.viewport
    viewport.viewers += 1
    viewport.enter()
    sending = asyncio.create_task(viewer.send_moments(socket), name="live socket")
    try:
        await _listen(socket, viewer)
    except (WebSocketDisconnect, RuntimeError):
        pass  # the viewer has disconnected
    except (ValueError, TypeError, OptionError):
        await socket.close(WRONG)
    finally:
        # Do not await before the cleanup is complete: a cancellation would interrupt it.
        sending.cancel()
        viewport.do(lambda live: live.release())
        viewport.press((), 0.0)
        viewport.viewers -= 1
        viewer.leave()
        await asyncio.gather(sending, return_exceptions=True)


async def _listen(socket: WebSocket, viewer: ViewerConnection) -> None:
    while True:
        text = await socket.receive_text()
        if len(text) > MAX_TEXT:
            raise ValueError("too long")
        message = json.loads(text)
        if not isinstance(message, dict):
            raise ValueError("not an object")
        viewer.receive(message)


def _ray(value: Any) -> Ray:
    numbers = np.array([_number(x, -1e4, 1e4) for x in _list(value, 9)]).reshape(3, 3)
    if not (numbers[1:] ** 2).sum(axis=1).all():
        raise ValueError("a direction is zero")
    return Ray(*numbers)


def _list(value: Any, count: int) -> list[Any]:
    if not isinstance(value, list) or len(value) != count:
        raise ValueError("not a list of the right length")
    return value


def _number(value: Any, minimum: float, maximum: float) -> float:
    number = float(value)
    if not (math.isfinite(number) and minimum <= number <= maximum):
        raise ValueError("out of range")
    return number
