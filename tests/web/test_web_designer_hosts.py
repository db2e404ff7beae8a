"""The designer wherever it lies: under a strict policy, in a frame, from a file, on a slow line."""

import threading
from collections.abc import Callable, Iterator
from functools import partial
from http.server import ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest
from studio_browser import resize, wait_until
from web_sites import Handler

from drapery.settings import Settings
from drapery.web.bundle import DESIGNER_ENTRY, DESIGNER_PUBLIC, bundled_module, within
from drapery.web.designer_page import MODULE, write_designer

STRICT = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; "
    "style-src 'none'; img-src 'none'; frame-src 'self'; require-trusted-types-for 'script'"
)
HEAD = "<!doctype html><html lang='en'><meta charset='utf-8'><link rel='icon' href='data:,'>"
PLAIN = f"{HEAD}<title>Host</title><script type='module' src='{MODULE}'></script>"
TAG = "<drapery-designer design='white creeper:lime' linked></drapery-designer>"
FRAME = f"{HEAD}<title>Frame</title><iframe src='host.html' width='800' height='700'></iframe>"
ROOT = "document.querySelector('drapery-designer').shadowRoot"
LIVE = f"{ROOT}?.querySelector('drapery-banner')?.shadowRoot.querySelector('canvas').hidden"
SLOW = {
    "offline": False,
    "latency": 150,
    "downloadThroughput": 187_500,
    "uploadThroughput": 187_500,
}
"""150 ms and 1.5 Mbit/s."""
FAST = {"offline": False, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1}
REPORTS = """
window.blocked = [];
addEventListener("securitypolicyviolation", ({ violatedDirective, blockedURI }) =>
  window.blocked.push([violatedDirective, blockedURI]));
"""

EARLY = """
document.addEventListener("readystatechange", () => {
  const designer = document.querySelector("drapery-designer");
  if (document.readyState !== "interactive" || !designer) return;
  window.isDefined = !!customElements.get("drapery-designer");
  const [dataTransfer, clipboardData] = [new DataTransfer(), new DataTransfer()];
  const more = { bubbles: true, cancelable: true };
  clipboardData.setData("text/plain", "blue skull:white");
  document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, ...more }));
  dataTransfer.items.add(new File(["nothing"], "early.zip"));
  const events = ["dragover", "drop"].map((type) => new DragEvent(type, { dataTransfer, ...more }));
  window.stays = events.map((event) => !designer.dispatchEvent(event));
});
"""
"""What comes when the document is parsed and the module has not come yet."""


class StrictHandler(Handler):
    """Serves a folder under a strict content security policy."""

    def end_headers(self) -> None:
        self.send_header("Content-Security-Policy", STRICT)
        super().end_headers()


@pytest.fixture(scope="module")
def folder(playable: Callable[..., Settings], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("hosts")
    write_designer(folder, playable(size=(160, 240)))
    (folder / "host.html").write_text(PLAIN + TAG, encoding="utf-8")
    (folder / "frame.html").write_text(FRAME, encoding="utf-8")
    places = within({path.name: path.read_bytes() for path in folder.glob("*.bin")})
    module = bundled_module(DESIGNER_ENTRY, DESIGNER_PUBLIC, places)
    script = f"<script type='module'>{module}</script>"
    (folder / "file.html").write_text(f"{HEAD}<title>File</title>{script}{TAG}", encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def strict(folder: Path) -> Iterator[str]:
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(StrictHandler, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()


@pytest.fixture
def page(chromium: Any) -> Iterator[Any]:
    resize(chromium, (1000, 800))
    added = chromium.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": REPORTS})
    yield chromium
    chromium.switch_to.default_content()
    chromium.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)
    chromium.execute_cdp_cmd("Network.emulateNetworkConditions", FAST)
    chromium.get("about:blank")


def edits(page: Any) -> None:
    """The cloth is live, and an edit, its undo and the command work."""
    wait_until(lambda: page.execute_script(f"return {LIVE}") is False)
    page.execute_script(f"{ROOT}.querySelector('[data-pattern=\"border\"]').click()")
    host = "document.querySelector('drapery-designer')"
    assert page.execute_script(f"return {host}.design") == "white creeper:lime border:black"
    assert "border" in page.execute_script(f"return {ROOT}.querySelector('.command').value")
    page.execute_script(f"{ROOT}.querySelector('[aria-keyshortcuts=\"Control+Z\"]').click()")
    assert page.execute_script(f"return {host}.design") == "white creeper:lime"
    assert (
        page.execute_script(f"return {ROOT}.querySelectorAll('.fault:not([hidden])').length") == 0
    )


def test_a_strict_policy_blocks_nothing_in_a_page_or_a_frame(page: Any, strict: str) -> None:
    page.get(f"{strict}/host.html")
    edits(page)
    icon = [each for each in page.execute_script("return blocked") if each[0] != "img-src"]
    assert icon == []
    page.get(f"{strict}/frame.html")
    page.switch_to.frame(0)
    edits(page)


def test_what_comes_before_the_module_is_read(page: Any, strict: str) -> None:
    page.execute_cdp_cmd("Network.enable", {})
    page.execute_cdp_cmd("Network.emulateNetworkConditions", SLOW)
    added = page.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": EARLY})
    try:
        page.get(f"{strict}/index.html")
        assert page.execute_script("return [isDefined, stays]") == [False, [True, True]]
        told = f"{ROOT}.querySelector('.pack')?.textContent ?? ''"
        wait_until(lambda: page.execute_script(f"return {told}").startswith("early.zip is no zip"))
        host = "document.querySelector('drapery-designer')"
        assert page.execute_script(f"return {host}.design") == "blue skull:white"
    finally:
        page.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)


def test_a_page_of_one_file_needs_no_server(page: Any, folder: Path) -> None:
    page.get((folder / "file.html").as_uri())
    edits(page)


def test_a_slow_line_loads_it_and_edits_need_no_line(page: Any, strict: str) -> None:
    page.execute_cdp_cmd("Network.enable", {})
    page.execute_cdp_cmd("Network.emulateNetworkConditions", SLOW)
    page.execute_cdp_cmd("Network.setCacheDisabled", {"cacheDisabled": True})
    page.get(f"{strict}/host.html")
    edits(page)
    page.execute_cdp_cmd("Network.emulateNetworkConditions", {**SLOW, "offline": True})
    edits(page)
    page.execute_cdp_cmd("Network.setCacheDisabled", {"cacheDisabled": False})
