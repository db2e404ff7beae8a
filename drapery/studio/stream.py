"""The socket between a viewer and the live cloth of its tab.

The server sends `messages`; the viewer says when it has drawn one, and no more than two are under
way, so a slow viewer sees fewer moments and nothing piles up. What the viewer says is a little
JSON each; what does not fit ends the connection.
"""

import asyncio
import json
import math
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
from fastapi import FastAPI, WebSocket, WebSocketDisconnect

from drapery.errors import DraperyError, OptionError
from drapery.studio.live import Ray
from drapery.studio.messages import Told
from drapery.studio.session import find_session
from drapery.studio.viewport import Viewport, in_thread, stage_of
from drapery.studio.wind_controls import KEYS

UNDER_WAY = 2
"""Messages that a viewer has not yet said to have drawn."""
MAX_TEXT = 2048
MAX_VIEWERS = 8
"""Viewers of one tab at once."""
UNKNOWN, ENOUGH, WRONG, BROKEN = 4404, 4429, 4400, 1011
"""Why the server closes a socket: no such tab, too many viewers, a message that does not fit, a
fault of its own."""


class Viewer:
    """One connection's share: what it has been told and what it has drawn."""

    def __init__(self, stage: Viewport, which: str) -> None:
        self.stage = stage
        self.told = Told(which)
        self.hidden = False
        self.sent = self.drawn = 0
        self._line = ""
        self._shaped = False
        self._ready = asyncio.Event()

    def hear(self, said: dict[str, Any]) -> None:
        """Take one message of the viewer. Raises ValueError for what does not fit."""
        for word, value in said.items():
            if word not in _HEARD:
                raise ValueError(word)
            _HEARD[word](self, value)
        self._ready.set()

    async def talk(self, socket: WebSocket) -> None:
        """Send each new moment as soon as the viewer is ready for it."""
        try:
            await self._talk(socket)
        except Exception:
            # Of a viewer that has gone, or a fault of ours: then it may come back and see it anew.
            with suppress(Exception):
                await socket.close(BROKEN)

    async def _talk(self, socket: WebSocket) -> None:
        seen = -1
        while True:
            await self._credit()
            await self.stage.after(seen)
            if self.stage.closed:
                await socket.close(UNKNOWN)
                return
            seen = self.stage.version
            line = self.stage.fault or self.stage.note
            if line != self._line:
                self._line = line
                await socket.send_text(json.dumps({"line": line}))
            for message in await in_thread(self._messages):
                self.sent += 1
                await socket.send_bytes(message)

    async def _credit(self) -> None:
        """Wait until the viewer is there, has said how large it is, and has drawn."""
        while self.hidden or not self._shaped or self.sent - self.drawn >= UNDER_WAY:
            self._ready.clear()
            await self._ready.wait()

    def _messages(self) -> list[bytes]:
        shown = self.stage.shown()
        try:
            return [] if shown is None else self.told.messages(shown)
        except DraperyError as error:
            self.stage.fault = str(error)
            return []

    def _drawn(self, value: Any) -> None:
        self.drawn = min(self.sent, self.drawn + int(_number(value, 0, 16)))

    def leave(self) -> None:
        """The viewer has gone."""
        if not self.hidden:
            self.stage.leave()
        self.hidden = True

    def _hide(self, value: Any) -> None:
        if value and not self.hidden:
            self.stage.leave()
        elif self.hidden and not value:
            self.stage.enter()
        self.hidden = bool(value)

    def _shape(self, value: Any) -> None:
        columns, rows = (int(_number(side, 1, 16384)) for side in _list(value, 2))
        self.stage.size = columns, rows
        self.told.reframe((columns, rows))
        self._shaped = True
        self.stage.do(lambda live: None)  # seen anew, if time stands too

    def _press(self, value: Any) -> None:
        keys, azimuth = _list(value, 2)
        held = tuple(key for key in KEYS if key in str(keys))
        self.stage.press(held, _number(azimuth, -1e4, 1e4))

    def _switch(self, value: Any) -> None:
        self.stage.switch()

    def _grab(self, value: Any) -> None:
        ray = _ray(value)
        self.stage.do(lambda live: live.grab(ray))

    def _pull(self, value: Any) -> None:
        ray = _ray(value)
        self.stage.do(lambda live: live.pull(ray))

    def _drop(self, value: Any) -> None:
        self.stage.do(lambda live: live.release())


_HEARD: dict[str, Callable[[Viewer, Any], None]] = {
    "drawn": Viewer._drawn,
    "hidden": Viewer._hide,
    "shape": Viewer._shape,
    "keys": Viewer._press,
    "switch": Viewer._switch,
    "grab": Viewer._grab,
    "pull": Viewer._pull,
    "drop": Viewer._drop,
}


def add_routes(app: FastAPI) -> None:
    """The live cloths of all sessions."""
    app.add_api_websocket_route("/live/{token}", live_socket)


async def live_socket(socket: WebSocket, token: str, which: str = "all") -> None:
    """Serve one viewer until it goes; then nothing of it is left."""
    session = find_session(token)
    await socket.accept()
    if session is None:
        await socket.close(UNKNOWN)
        return
    stage = stage_of(session)
    if stage.viewers >= MAX_VIEWERS:
        await socket.close(ENOUGH)
        return
    viewer = Viewer(stage, which if which in ("left", "right") else "all")
    stage.viewers += 1
    stage.enter()
    talking = asyncio.create_task(viewer.talk(socket), name="live socket")
    try:
        await _listen(socket, viewer)
    except (WebSocketDisconnect, RuntimeError):
        pass  # it has gone
    except (ValueError, TypeError, OptionError):
        await socket.close(WRONG)
    finally:
        # Without a pause in between: whoever cancels this task may not stop its end.
        talking.cancel()
        stage.do(lambda live: live.release())
        stage.press((), 0.0)
        stage.viewers -= 1
        viewer.leave()
        await asyncio.gather(talking, return_exceptions=True)


async def _listen(socket: WebSocket, viewer: Viewer) -> None:
    while True:
        text = await socket.receive_text()
        if len(text) > MAX_TEXT:
            raise ValueError("too long")
        said = json.loads(text)
        if not isinstance(said, dict):
            raise ValueError("no object")
        viewer.hear(said)


def _ray(value: Any) -> Ray:
    numbers = np.array([_number(x, -1e4, 1e4) for x in _list(value, 9)]).reshape(3, 3)
    if not (numbers[1:] ** 2).sum(axis=1).all():
        raise ValueError("no direction")
    return Ray(*numbers)


def _list(value: Any, count: int) -> list[Any]:
    if not isinstance(value, list) or len(value) != count:
        raise ValueError("no list")
    return value


def _number(value: Any, least: float, most: float) -> float:
    number = float(value)
    if not (math.isfinite(number) and least <= number <= most):
        raise ValueError("out of range")
    return number
