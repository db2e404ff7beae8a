"""A Firefox, driven by WebDriver BiDi, which it speaks without a driver of its own.

See "WebDriver BiDi", W3C working draft: https://www.w3.org/TR/webdriver-bidi/. It draws on the
screen of an Xvfb, because a headless Firefox has no WebGL without a graphics card.
"""

import base64
import io
import json
import os
import re
import shutil
import subprocess
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

FIREFOX = shutil.which("firefox-esr") or shutil.which("firefox")
XVFB = shutil.which("Xvfb")
PREFERENCES = {
    "app.normandy.enabled": False,
    "app.update.enabled": False,
    "browser.download.alwaysOpenPanel": False,
    "browser.download.folderList": 2,
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "network.captive-portal-service.enabled": False,
    "network.connectivity-service.enabled": False,
    "services.settings.server": "data:,",
    "ui.prefersReducedMotion": 0,
    "webgl.forbid-software": False,
    "webgl.force-enabled": True,
}


@pytest.fixture(scope="session")
def firefox(playable: object) -> "Iterator[Firefox]":
    """A browser of its own profile; skipped only where Firefox, Xvfb or the client is missing, or
    the compiler for the kernels of pages."""
    pytest.importorskip("websocket", reason="websocket-client is not installed (selenium needs it)")
    if FIREFOX is None or XVFB is None:
        pytest.skip("Firefox and Xvfb are not installed (apt: firefox-esr, xvfb)")
    # Firefox may still write into its profile while it ends.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        browser = Firefox(Path(folder))
        yield browser
        browser.close()


class Firefox:
    """A Firefox with a profile of its own in a folder.

    downloads: the folder of what it downloads. errors: what pages wrote into its console as errors.
    """

    def __init__(self, folder: Path) -> None:
        self.downloads = folder / "downloads"
        self.errors: list[str] = []
        own = PREFERENCES | {"browser.download.dir": str(self.downloads)}
        lines = [f"user_pref({json.dumps(k)}, {json.dumps(v)});\n" for k, v in own.items()]
        (folder / "user.js").write_text("".join(lines), encoding="utf-8")
        screen = [str(XVFB), "-displayfd", "1", "-screen", "0", "1280x1024x24"]
        self.screen = subprocess.Popen(screen, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        assert self.screen.stdout is not None
        late = threading.Timer(60, self.screen.kill)
        late.daemon = True
        late.start()
        number = self.screen.stdout.readline().decode().strip()
        late.cancel()
        if not number:
            raise AssertionError(f"Xvfb did not start; it ended with {self.screen.wait(20)}")
        shown = os.environ | {"DISPLAY": f":{number}"}
        options = ["--no-remote", "--remote-debugging-port", "0", "--profile", str(folder)]
        command = [str(FIREFOX), *options, "about:blank"]
        self.process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=shown)
        self.reader: threading.Thread | None = None
        try:
            self._connect()
        except BaseException:
            self._end()
            raise

    def _connect(self) -> None:
        from websocket import create_connection

        # A Firefox that says nothing for a minute is ended, which ends the reading of its lines.
        late = threading.Timer(60, self.process.kill)
        late.daemon = True
        late.start()
        address = self._address()
        late.cancel()
        self.reader = threading.Thread(target=self._drain, daemon=True)
        self.reader.start()
        self.socket = create_connection(f"{address}/session", timeout=60, suppress_origin=True)
        self.count = 0
        self.send("session.new", capabilities={})
        # A tab of its own has the focus, without which fields do not report what is typed.
        self.context = self.send("browsingContext.create", type="tab")["context"]
        self.send("session.subscribe", events=["log.entryAdded"])

    def _address(self) -> str:
        assert self.process.stderr is not None
        for line in self.process.stderr:
            if found := re.search(r"BiDi listening on (ws://\S+)", line):
                return found[1]
        raise AssertionError("Firefox did not start")

    def _drain(self) -> None:
        assert self.process.stderr is not None
        with self.process.stderr as lines:
            for _ in lines:
                pass

    def send(self, method: str, **parameters: Any) -> Any:
        """The result of a command."""
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self.socket.recv())
            entry = answer.get("params", {})
            if answer.get("method") == "log.entryAdded" and entry["level"] == "error":
                self.errors.append(entry["text"])
            if answer.get("id") == self.count:
                assert answer["type"] == "success", answer
                return answer["result"]

    def open(self, address: str) -> None:
        """Load a page."""
        self.send("browsingContext.navigate", context=self.context, url=address, wait="complete")

    def ask(self, expression: str) -> Any:
        """The value of an expression in the page."""
        words = {"expression": f"JSON.stringify({expression})", "awaitPromise": False}
        found = self.send("script.evaluate", target={"context": self.context}, **words)
        assert found["type"] == "success", found
        return json.loads(found["result"].get("value", "null"))

    def press(self, *keys: str) -> None:
        """Press and release keys, one after the other."""
        actions = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        source = {"type": "key", "id": "keys", "actions": actions}
        self.send("input.performActions", context=self.context, actions=[source])

    def click(self, selector: str) -> None:
        """Click in the middle of the first element that a CSS selector finds."""
        found = f"document.querySelector({json.dumps(selector)})"
        self.ask(f"{found}.scrollIntoView({{ block: 'center' }})")
        box = self.ask(f"{found}.getBoundingClientRect()")
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        move = {"type": "pointerMove", "x": round(x), "y": round(y)}
        press = [{"type": kind, "button": 0} for kind in ("pointerDown", "pointerUp")]
        source = {"type": "pointer", "id": "mouse", "actions": [move, *press]}
        self.send("input.performActions", context=self.context, actions=[source])

    def screenshot(self) -> np.ndarray:
        """What is seen of the page, shape [H, W, 4]."""
        data = self.send("browsingContext.captureScreenshot", context=self.context)["data"]
        return np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGBA"))

    def close(self) -> None:
        """End the browser and its screen."""
        self.socket.close()
        self._end()

    def _end(self) -> None:
        for process in (self.process, self.screen):
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        if self.screen.stdout is not None:
            self.screen.stdout.close()
        if self.reader is not None:
            self.reader.join(20)  # it closes the pipe of the browser
