"""Tabs of a studio without a browser: a page with its socket."""

import re
import urllib.request
import uuid
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

websockets = pytest.importorskip("websockets.sync.client")


@contextmanager
def open_tab(address: str) -> Iterator[str]:
    """A tab of the studio at this address, by its token."""
    page = urllib.request.urlopen(address, timeout=30).read().decode()
    token = re.search(r"data-token[^A-Za-z0-9_-]+([A-Za-z0-9_-]{32})", page)
    client = re.search(r"'client_id': '([0-9a-f-]+)'", page)
    assert token and client
    words = {"client_id": client[1], "tab_id": uuid.uuid4(), "document_id": uuid.uuid4()}
    words |= {"EIO": 4, "transport": "websocket", "implicit_handshake": "true"}
    words |= {"next_message_id": 0}
    sockets = address.replace("http", "ws")
    line = "&".join(f"{key}={value}" for key, value in words.items())
    with websockets.connect(f"{sockets}_nicegui_ws/socket.io/?{line}") as socket:
        assert socket.recv(60).startswith("0")
        socket.send("40")
        assert socket.recv(60).startswith("40")
        yield token[1]
