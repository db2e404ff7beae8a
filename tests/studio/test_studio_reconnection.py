"""What a page shows after its connection was lost."""

import asyncio
from typing import Any

import pytest

pytest.importorskip("nicegui")

from fastapi import Request
from nicegui import Client, core, ui
from nicegui.page import page

from drapery.studio.page import send_current_states

SCOPE = {"type": "http", "method": "GET", "path": "/", "query_string": b"", "headers": []}


def test_what_a_page_missed_does_not_replace_what_is_newer(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: dict[int, Any] = {}

    async def browser(kind: str, data: dict[Any, Any], **_: Any) -> None:
        if kind == "update":
            shown.update(data)

    async def connect(client: Client, name: str, expects: int) -> None:
        await client.handle_handshake(name, "tab", None, "document", expects)
        await asyncio.sleep(0.3)

    async def run() -> None:
        monkeypatch.setattr(core, "loop", asyncio.get_running_loop())
        monkeypatch.setattr(core.sio, "emit", browser)
        for name, value in (("message_history_length", 100), ("reconnect_timeout", 3.0)):
            monkeypatch.setattr(core.app.config, name, value, raising=False)  # as `ui.run` does
        client = Client(page("/"), request=Request(SCOPE))
        client.on_connect(send_current_states)
        sending = asyncio.create_task(client.outbox.loop())
        with client:
            label = ui.label("white")
            gone = ui.label("gone")
        await connect(client, "first", 0)
        expects = client.outbox.next_message_id
        label.set_text("red")
        gone.delete()
        await asyncio.sleep(0.3)
        shown.clear()  # the page hears nothing of it
        client.handle_disconnect("first")
        label.set_text("lime")
        await connect(client, "second", expects)
        assert shown[label.id]["text"] == "lime"
        assert shown[gone.id] is None
        client.outbox.stop()
        await sending
        client.delete()

    asyncio.run(run())
