"""Who may speak to the studio: its own page only, from names that are its own, with the token."""

import asyncio
import ipaddress
import re
from pathlib import Path
from typing import Any

import pytest

from drapery.cli import main
from drapery.serve.server import reachable
from drapery.studio import app
from drapery.studio.guard import LOOPBACK, Guard, host_name

TOKEN = "open sesame & more"


async def _hello(scope: Any, receive: Any, send: Any) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
        return
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": b"hello"})


def call(guard: Guard, kind: str = "http", path: str = "/", query: str = "", **headers: str) -> Any:
    """The first message that the guard lets out."""
    sent: list[Any] = []
    lines = [(key.encode(), value.encode()) for key, value in headers.items()]
    scope = {"type": kind, "path": path, "query_string": query.encode(), "headers": lines}

    async def run() -> None:
        async def receive() -> Any:
            return {"type": f"{kind}.connect"}

        async def send(message: Any) -> None:
            sent.append(message)

        await guard(scope, receive, send)

    asyncio.run(run())
    return sent[0]


def status(*given: Any, **more: Any) -> int | str:
    first = call(*given, **more)
    return first.get("status", first["type"])


@pytest.mark.parametrize("host", ["localhost:8080", "127.0.0.1", "[::1]:8080", "LOCALHOST:1"])
def test_its_own_names_are_let_in(host: str) -> None:
    guard = Guard(_hello, LOOPBACK, None)
    assert status(guard, host=host) == 200
    assert status(guard, host=host, origin=f"http://{host}") == 200
    assert status(guard, kind="websocket", host=host, origin=f"http://{host}") == "websocket.accept"


@pytest.mark.parametrize(
    "host",
    ["evil.example", "localhost.evil.example", "127.0.0.1.evil.example", "", "[", "10.0.0.9"],
)
def test_a_name_that_is_bound_to_us_is_refused(host: str) -> None:
    guard = Guard(_hello, LOOPBACK, None)
    assert status(guard, host=host) == 403
    assert status(guard, kind="websocket", host=host, origin=f"http://{host}") == "websocket.close"


@pytest.mark.parametrize(
    "origin",
    ["https://evil.example", "http://localhost:9999", "null", "http://localhost:8080@evil"],
)
def test_pages_of_others_are_refused(origin: str) -> None:
    guard = Guard(_hello, LOOPBACK, None)
    for kind, refused in (("http", 403), ("websocket", "websocket.close")):
        assert status(guard, kind=kind, host="localhost:8080", origin=origin) == refused


def test_the_token_becomes_a_cookie_and_leaves_the_address() -> None:
    guard = Guard(_hello, None, TOKEN)
    host = "studio.lan:8080"
    assert status(guard, host=host) == 403
    assert status(guard, host=host, query="token=wrong") == 403
    assert status(guard, kind="websocket", host=host) == "websocket.close"
    welcome = call(guard, host=host, path="//evil", query="token=open+sesame+%26+more&design=x")
    headers = dict(welcome["headers"])
    assert welcome["status"] == 303 and headers[b"location"] == b"/evil?design=x"
    cookie, *flags = headers[b"set-cookie"].decode().split("; ")
    assert TOKEN not in cookie and {"httponly", "samesite=lax"} <= {flag.lower() for flag in flags}
    assert status(guard, host=host, cookie=cookie) == 200
    assert status(guard, host=host, cookie=cookie + "0") == 403
    assert status(guard, kind="websocket", host=host, cookie=cookie) == "websocket.accept"
    assert status(Guard(_hello, None, TOKEN + "!"), host=host, cookie=cookie) == 403


def test_a_proxy_names_the_prefix_that_it_removes() -> None:
    guard = Guard(_hello, None, TOKEN)
    query = "token=open+sesame+%26+more&design=x"
    for prefix in ("/studio", "/studio/", "//studio", "studio"):
        welcome = call(guard, host="lan", path="/", query=query, **{"x-forwarded-prefix": prefix})
        assert dict(welcome["headers"])[b"location"] == b"/studio/?design=x"


def test_the_pages_of_a_tab_are_named_relative_to_it() -> None:
    """Behind a prefix an address that begins with a slash leads elsewhere."""
    folder = Path(app.__file__).parent
    text = "".join(path.read_text("utf-8") for path in folder.rglob("*.py"))
    assert re.findall(r'f"/\w+/\{.*', text) == []


def test_health_is_told_to_anyone_who_may_speak_to_it() -> None:
    guard = Guard(_hello, None, TOKEN)
    assert status(guard, host="lan") == 403
    assert status(guard, host="lan", path="/healthz") == 200
    assert status(guard, host="lan", path="/healthz", origin="http://evil") == 403
    assert status(guard, kind="websocket", host="lan", path="/healthz") == "websocket.close"
    assert status(Guard(_hello, LOOPBACK, None), host="evil", path="/healthz") == 403


def test_a_page_may_load_nothing_from_elsewhere() -> None:
    headers = dict(call(Guard(_hello, LOOPBACK, None), host="localhost")["headers"])
    policy = headers[b"content-security-policy"].decode()
    assert "default-src 'self'" in policy and "http" not in policy and "*" not in policy


def test_host_names() -> None:
    assert host_name("[::1]:80") == "::1"
    assert host_name("Local:80") == "local"
    assert host_name("[nonsense") == ""


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--host", "0.0.0.0"], "give a --token"),
        (["--host", "0.0.0.0", "--token", "short"], "at least 8"),
        (["--port", "99999"], "port"),
        (["--pack", "no/such/pack.zip"], "no/such/pack.zip"),
    ],
)
def test_the_command_says_what_is_missing(words, said, monkeypatch, capsys) -> None:
    monkeypatch.setattr("sys.argv", ["drapery", "studio", "--no-open", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 2
    line = capsys.readouterr().err
    assert said in line and line.count("\n") == 1


@pytest.mark.parametrize("host", ["0.0.0.0", "::"])
def test_the_printed_address_can_be_opened_by_others(host: str) -> None:
    assert reachable("192.168.1.2") == "192.168.1.2"
    assert reachable(host) != host
    assert ipaddress.ip_address(reachable(host))
