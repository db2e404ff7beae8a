"""Pages of a folder in a browser, and what their live cloth shows."""

import base64
import io
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from studio_browser import WIDE, resize, wait_until

ELEMENT = "document.querySelector('drapery-banner')"
CANVAS = "shadowRoot.querySelector('canvas')"
NO_WASM = "default-src 'self' data:; script-src 'self' 'unsafe-inline'; style-src 'unsafe-inline'"


class Handler(SimpleHTTPRequestHandler):
    """Serves a folder; a query is the content security policy of the answer."""

    def end_headers(self) -> None:
        if "?" in self.path:
            self.send_header("Content-Security-Policy", NO_WASM)
        super().end_headers()

    def log_message(self, format: str, *args: Any) -> None:
        pass


def served(folder: Path) -> Iterator[str]:
    """The address of a folder."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()


def open_site(
    browser: Any, address: str, *, moves: bool = True, ready: bool = True, script: str = ""
) -> None:
    """Load a page and wait for its cloth. moves: without a wish for less motion. script: before."""
    resize(browser, WIDE, moves=moves)
    browser.get_log("browser")
    command = "Page.addScriptToEvaluateOnNewDocument"
    added = browser.execute_cdp_cmd(command, {"source": script}) if script else {}
    browser.get(address)
    for identifier in added.values():
        remove = "Page.removeScriptToEvaluateOnNewDocument"
        browser.execute_cdp_cmd(remove, {"identifier": identifier})
    if ready:
        wait_until(lambda: is_live(browser))


def is_live(browser: Any, element: str = ELEMENT) -> bool:
    """Whether an element shows its cloth; it may not be there yet, or its module not loaded."""
    canvas = f"{element}?.shadowRoot?.querySelector('canvas')"
    return bool(browser.execute_script(f"return {canvas}?.hidden === false"))


def picture(browser: Any, element: str = ELEMENT) -> np.ndarray:
    """The pixels of an element's canvas, shape [H, W, 4]."""
    url = browser.execute_script(f"return {element}.{CANVAS}.toDataURL()")
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(url.partition(",")[2]))))


def first_picture(browser: Any, element: str = ELEMENT) -> np.ndarray:
    wait_until(lambda: picture(browser, element)[..., 3].any())
    return picture(browser, element)


def changes(browser: Any, before: np.ndarray, element: str = ELEMENT) -> bool:
    """Whether a part of an element's picture differs from an earlier one."""
    now = picture(browser, element)
    return now.shape == before.shape and bool((now != before).any(axis=2).mean() > 0.005)


def warnings(browser: Any) -> list[str]:
    """The lines of ours on the console."""
    logged = (entry["message"] for entry in browser.get_log("browser"))
    return [line.partition("drapery: ")[2] for line in logged if "drapery: " in line]
