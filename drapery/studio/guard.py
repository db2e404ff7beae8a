"""Who may speak to the studio: its own page, from a name that is its own, with the token if any.

A page of another site can reach a server on this machine through its visitor's browser: by a name
that is re-bound to 127.0.0.1, or by a websocket, which no same-origin policy keeps. So the Host
must be ours, and the Origin, where there is one, must be that Host.
"""

import hashlib
import hmac
from collections.abc import Awaitable, Callable, Mapping, MutableMapping
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qsl, urlencode, urlsplit

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Any]]
Send = Callable[[Any], Awaitable[None]]
AsgiApp = Callable[[Scope, Receive, Send], Awaitable[None]]

LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})

_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-frame-options", b"DENY"),
    # The page's framework compiles its templates in the browser; all else is ours or nobody's.
    (
        b"content-security-policy",
        b"default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:;"
        b" style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:;"
        b" worker-src 'self' blob:; connect-src 'self'; frame-ancestors 'none'; base-uri 'none';"
        b" form-action 'self'",
    ),
)


class Guard:
    """Lets through to `app` what may pass; all else is 403.

    hosts: the names under which the studio may be called; None is any, which wants a token.
    token: what a visitor must bring, once as `?token=` and from then on as a cookie.
    """

    def __init__(self, app: AsgiApp, hosts: frozenset[str] | None, token: str | None) -> None:
        self.app = app
        self.hosts = hosts
        self.token = token

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        headers = _headers(scope)
        if not self._is_ours(headers):
            await _refuse(scope, receive, send, "the studio answers only to its own page")
        elif self._is_known(headers):
            await self.app(scope, receive, _hardened(send))
        elif self._brings_token(scope):
            await self._welcome(scope, send)
        else:
            await _refuse(scope, receive, send, "give the token: open the address that was printed")

    def _is_ours(self, headers: Mapping[str, str]) -> bool:
        host = headers.get("host", "")
        if self.hosts is not None and host_name(host) not in self.hosts:
            return False
        origin = headers.get("origin")
        return origin is None or urlsplit(origin).netloc.lower() == host.lower()

    def _is_known(self, headers: Mapping[str, str]) -> bool:
        if self.token is None:
            return True
        try:
            cookies = SimpleCookie(headers.get("cookie", ""))
        except CookieError:
            return False
        cookie = cookies.get(_cookie_name(headers.get("host", "")))
        return cookie is not None and _same(cookie.value, _pass_of(self.token))

    def _brings_token(self, scope: Scope) -> bool:
        given = dict(_query(scope)).get("token", "")
        return scope["type"] == "http" and self.token is not None and _same(given, self.token)

    async def _welcome(self, scope: Scope, send: Send) -> None:
        """The same address without the token, which so stays out of the history, and a cookie."""
        rest = urlencode([(key, value) for key, value in _query(scope) if key != "token"])
        # A path of two slashes would lead to another host.
        path = "/" + scope["path"].lstrip("/\\")
        name, value = _cookie_name(_headers(scope).get("host", "")), _pass_of(self.token or "")
        cookie = f"{name}={value}; Path=/; HttpOnly; SameSite=Lax"
        location = f"{path}?{rest}" if rest else path
        fields = [(b"location", location.encode()), (b"set-cookie", cookie.encode())]
        await send({"type": "http.response.start", "status": 303, "headers": fields})
        await send({"type": "http.response.body"})


def host_name(host: str) -> str:
    """The name of a Host header, without its port: `[::1]:8080` gives `::1`."""
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""


def _headers(scope: Scope) -> dict[str, str]:
    return {key.decode("latin-1"): value.decode("latin-1") for key, value in scope["headers"]}


def _query(scope: Scope) -> list[tuple[str, str]]:
    return parse_qsl(scope.get("query_string", b"").decode("latin-1"), keep_blank_values=True)


def _same(given: str, wanted: str) -> bool:
    return hmac.compare_digest(given.encode(), wanted.encode())


def _pass_of(token: str) -> str:
    """What the cookie holds: not the token itself, which is shown to people."""
    return hashlib.sha256(b"drapery studio\0" + token.encode()).hexdigest()


def _cookie_name(host: str) -> str:
    # Cookies do not tell ports apart; two studios on one machine would take turns.
    port = host.rpartition(":")[2]
    return f"drapery-studio-{port if port.isdigit() else '80'}"


def _hardened(send: Send) -> Send:
    async def send_with_headers(message: Any) -> None:
        if message["type"] == "http.response.start":
            message["headers"] = [*message.get("headers", ()), *_HEADERS]
        await send(message)

    return send_with_headers


async def _refuse(scope: Scope, receive: Receive, send: Send, why: str) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": why})
        return
    plain = [(b"content-type", b"text/plain; charset=utf-8")]
    await send({"type": "http.response.start", "status": 403, "headers": plain})
    await send({"type": "http.response.body", "body": f"drapery studio: {why}\n".encode()})
