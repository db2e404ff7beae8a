"""Who may use the studio: only its own page, under a permitted host name, with the token if set.

A page of another site can reach a server on this machine through its visitor's browser: with a
host name that is re-bound to 127.0.0.1, or with a websocket, which no same-origin policy protects.
So the Host must be one of the studio's names, and the Origin, if present, must match the Host.

Starlette's TrustedHostMiddleware checks only the Host. The check of the Origin needs the same
parsed Host, and a refused websocket needs a close frame, so this module makes both checks.
"""

import hashlib
import hmac
from urllib.parse import urlencode, urlsplit

from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

HEALTH = "/healthz"
"""Answers without a token while the server runs, for those who restart it."""
LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})

_HEADERS = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "x-frame-options": "DENY",
    # The page's framework compiles its templates in the browser, which needs 'unsafe-eval'.
    "content-security-policy": (
        "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:;"
        " style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:;"
        " worker-src 'self' blob:; connect-src 'self'; frame-ancestors 'none'; base-uri 'none';"
        " form-action 'self'"
    ),
}


class Guard:
    """Passes permitted requests to `app`; answers all others with status 403.

    hosts: the permitted host names; None permits all, and then a token is required.
    token: what a visitor must send, first as `?token=` and from then on as a cookie.
    """

    def __init__(self, app: ASGIApp, hosts: frozenset[str] | None, token: str | None) -> None:
        self.app = app
        self.hosts = hosts
        self.token = token

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        request = HTTPConnection(scope)
        if not self._is_own_page(request):
            await _refuse(scope, receive, send, "the studio answers only to its own page")
        elif scope["type"] == "http" and scope["path"] == HEALTH:
            await PlainTextResponse("ok\n")(scope, receive, send)
        elif self._has_cookie(request):
            await self.app(scope, receive, _hardened(send))
        elif self._brings_token(request):
            await self._welcome(request)(scope, receive, send)
        else:
            await _refuse(scope, receive, send, "give the token: open the address that was printed")

    def _is_own_page(self, request: HTTPConnection) -> bool:
        host = request.headers.get("host", "")
        if self.hosts is not None and host_name(host) not in self.hosts:
            return False
        origin = request.headers.get("origin")
        return origin is None or urlsplit(origin).netloc.lower() == host.lower()

    def _has_cookie(self, request: HTTPConnection) -> bool:
        if self.token is None:
            return True
        cookie = request.cookies.get(_cookie_name(request), "")
        return _equal(cookie, _cookie_value(self.token))

    def _brings_token(self, request: HTTPConnection) -> bool:
        given = request.query_params.get("token", "")
        is_page = request.scope["type"] == "http"
        return is_page and self.token is not None and _equal(given, self.token)

    def _welcome(self, request: HTTPConnection) -> RedirectResponse:
        """Set the cookie and redirect to the address without the token.

        The token must not remain in the browser's history.
        """
        query = request.query_params.multi_items()
        rest = urlencode([(key, value) for key, value in query if key != "token"])
        # A browser reads a path that begins with two slashes as another host. A proxy that removes
        # the beginning of paths names it in this header, which the page's framework reads too.
        prefix = request.headers.get("x-forwarded-prefix", "").strip("/\\")
        path = f"/{prefix}/" if prefix else "/"
        path += request.scope["path"].lstrip("/\\")
        response = RedirectResponse(f"{path}?{rest}" if rest else path, 303)
        value = _cookie_value(self.token or "")
        response.set_cookie(_cookie_name(request), value, httponly=True, samesite="lax")
        return response


def host_name(host: str) -> str:
    """The name of a Host header, without its port: `[::1]:8080` gives `::1`."""
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""


def _equal(given: str, wanted: str) -> bool:
    return hmac.compare_digest(given.encode(), wanted.encode())


def _cookie_value(token: str) -> str:
    """The value of the cookie; it differs from the token, which is visible in addresses."""
    return hashlib.sha256(b"drapery studio\0" + token.encode()).hexdigest()


def _cookie_name(request: HTTPConnection) -> str:
    # All ports of a host share cookies: with equal names, two studios would overwrite each other's.
    port = request.headers.get("host", "").rpartition(":")[2]
    return f"drapery-studio-{port if port.isdigit() else '80'}"


def _hardened(send: Send) -> Send:
    async def send_with_headers(message: Message) -> None:
        if message["type"] == "http.response.start":
            message.setdefault("headers", [])
            MutableHeaders(scope=message).update(_HEADERS)
        await send(message)

    return send_with_headers


async def _refuse(scope: Scope, receive: Receive, send: Send, why: str) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": why})
        return
    await PlainTextResponse(f"drapery studio: {why}\n", 403)(scope, receive, send)
