"""The service on a socket: uvicorn, with limits on silent connections and on their number."""

import asyncio
import ipaddress
import socket
from collections.abc import Sequence
from typing import Any

import uvicorn
from fastapi import FastAPI
from uvicorn.protocols.http.h11_impl import H11Protocol

from drapery.errors import OptionError, OutputError

HEAD_TIMEOUT = 10.0
"""How long a client may take to send the head of a request [s]."""
SEND_TIMEOUT = 30.0
"""How long a client may take to read what waits to be sent, about 48 kB [s]."""
MAX_HEAD = 48 << 10
"""The most bytes of the head of a request."""
MAX_CONNECTIONS = 512
MAX_CONNECTIONS_OF_CLIENT = 128
"""The most connections from one address, except from a trusted proxy."""
STOP_TIMEOUT = 5
"""How long unfinished answers may take after SIGTERM [s]; the workers end after that."""


class LimitedProtocol(H11Protocol):
    """Closes connections that do not send a request head or read an answer in time, or too many.

    uvicorn's timeout starts only after the first response, and its concurrency limit refuses every
    client while silent connections are open.
    """

    _head_timer: asyncio.TimerHandle | None = None
    _send_timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """Accept a connection, or close it if there are too many."""
        super().connection_made(transport)
        self._watch_head()
        host = self.client[0] if self.client else ""
        same = sum(1 for other in self.connections if _host(other) == host)
        limited = not self.config.proxy_headers and same > MAX_CONNECTIONS_OF_CLIENT
        if limited or len(self.connections) > MAX_CONNECTIONS:
            transport.abort()

    def data_received(self, data: bytes) -> None:
        """Read a part of a request."""
        super().data_received(data)
        self._watch_head()

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the timers."""
        self._stop_timer()
        self._stop_send_timer()
        super().connection_lost(exc)

    def pause_writing(self) -> None:
        """Wait for a client that reads too slowly, but not for ever."""
        super().pause_writing()
        self._send_timer = self.loop.call_later(SEND_TIMEOUT, self.transport.abort)

    def resume_writing(self) -> None:
        """Go on: the client has read almost everything."""
        self._stop_send_timer()
        super().resume_writing()

    def _stop_send_timer(self) -> None:
        if self._send_timer is not None:
            self._send_timer.cancel()
            self._send_timer = None

    def _watch_head(self) -> None:
        answering = self.cycle is not None and not self.cycle.response_complete
        if answering:
            self._stop_timer()
        elif self._head_timer is None:
            self._head_timer = self.loop.call_later(HEAD_TIMEOUT, self.transport.close)

    def _stop_timer(self) -> None:
        if self._head_timer is not None:
            self._head_timer.cancel()
            self._head_timer = None


def _host(connection: Any) -> str:
    host: str = connection.client[0] if connection.client else ""
    return host


def listen(host: str, port: int) -> socket.socket:
    """A listening socket; port 0 chooses a free one. Raises OutputError."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family, backlog=2048)
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or "no such address"
        raise OutputError(
            f"cannot listen at {host}:{port}: {reason}; choose another --host or --port"
        ) from None


def address_of(listening: socket.socket) -> str:
    """The address of a listening socket as a URL that others can open."""
    host, port = listening.getsockname()[:2]
    host = reachable(host)
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def reachable(host: str) -> str:
    """A host that others can open: this machine's own address for the one that means all of them.

    It is the address of the network through which the machine reaches others; nothing is sent.
    """
    outside = {"0.0.0.0": (socket.AF_INET, "192.0.2.1"), "::": (socket.AF_INET6, "2001:db8::1")}
    if host not in outside:
        return host
    family, other = outside[host]
    try:
        with socket.socket(family, socket.SOCK_DGRAM) as probe:
            probe.connect((other, 9))
            return str(probe.getsockname()[0])
    except OSError:  # there is no such network
        return "127.0.0.1" if family == socket.AF_INET else "::1"


def check_proxies(proxies: Sequence[str]) -> list[str]:
    """Check addresses or networks of trusted proxies. Raises OptionError."""
    for text in proxies:
        try:
            ipaddress.ip_network(text)
        except ValueError:
            raise OptionError(
                f"trusted proxy {text[:60]!r} is not an address; write 10.0.0.1 or 10.0.0.0/8"
            ) from None
    return list(proxies)


def run_server(app: FastAPI, listening: socket.socket, proxies: Sequence[str] = ()) -> None:
    """Answer requests until SIGTERM or SIGINT, then end within ten seconds; see `make_server`."""
    server = make_server(app, proxies)
    server.run(sockets=[listening])
    if not server.started:
        raise SystemExit(3)


def make_server(app: Any, proxies: Sequence[str] = ()) -> uvicorn.Server:
    """A server for an ASGI application.

    proxies: the addresses or networks whose X-Forwarded-For is trusted; all others are ignored.
    """
    config = uvicorn.Config(
        app,
        http=LimitedProtocol,
        ws="none",
        log_level="warning",
        access_log=False,
        server_header=False,
        proxy_headers=bool(proxies),
        forwarded_allow_ips=check_proxies(proxies),
        h11_max_incomplete_event_size=MAX_HEAD,
        timeout_graceful_shutdown=STOP_TIMEOUT,
    )
    return uvicorn.Server(config)
