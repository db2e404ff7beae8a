"""A studio in its own process, and a headless Chromium that opens it."""

import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from base64 import b64encode
from collections.abc import Callable, Iterator
from glob import glob
from pathlib import Path
from typing import Any, TypeVar

import pytest
from compile_kernels import single
from tracing import untraced_environment

from drapery import Banner, draw

T = TypeVar("T")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
DRIVER = shutil.which("chromedriver")

FLAGS = (
    *("--headless=new", "--no-sandbox", "--no-first-run", "--disable-dev-shm-usage"),
    *("--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),
    *("--disable-quic", "--disable-sync", "--disable-component-update"),
    *("--disable-background-networking", "--force-prefers-reduced-motion"),
    "--no-proxy-server",
)

PASTE = """
const data = new DataTransfer();
data.setData("text/plain", arguments[0]);
document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true }));
"""
DROP = """
const bytes = Uint8Array.from(atob(arguments[1]), (c) => c.charCodeAt(0));
const data = new DataTransfer();
data.items.add(new File([bytes], arguments[0]));
const options = { dataTransfer: data, bubbles: true, cancelable: true };
document.querySelector(arguments[2]).dispatchEvent(new DragEvent("drop", options));
"""

SEEN = """
window.seenNotices = [];
const seen = new WeakSet();
new MutationObserver(() => {
  for (const each of document.querySelectorAll(".q-notification")) {
    if (seen.has(each)) continue;
    seen.add(each);
    window.seenNotices.push([each.getAttribute("role"), each.innerText]);
  }
}).observe(document, { childList: true, subtree: true });
"""
"""Keeps the notices of a page, which go by themselves while a loaded machine looks elsewhere."""

WIDE = (1280, 800)
PHONE = (390, 844)


class Studio:
    """A studio that runs. address: of its page. folder: where it may write. library: its file."""

    def __init__(self, folder: Path, *options: str) -> None:
        self.folder = folder
        command = [sys.executable, "-m", "drapery", "studio", "--no-open", "--port", "0"]
        self.library = folder / "library.sqlite"
        command += ["--library", str(self.library)]
        # A tracer would slow down what pages wait for.
        environment = untraced_environment() | {"TMPDIR": str(folder), "XDG_DATA_HOME": str(folder)}
        self.process = subprocess.Popen(
            [*command, *options], stderr=subprocess.PIPE, text=True, env=environment
        )
        self.log: list[str] = []
        self.address = self._address()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _address(self) -> str:
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self.log.append(line)
            if found := re.search(r"the studio is at (http://\S+?);", line):
                return found.group(1)
        raise AssertionError("the studio did not start: " + "".join(self.log))

    def _read(self) -> None:
        # A pipe that nobody reads fills up and holds the server.
        assert self.process.stderr is not None
        with self.process.stderr as lines:
            self.log.extend(lines)

    def stop(self) -> int:
        """Ask it to end, and its exit code."""
        self.process.send_signal(signal.SIGTERM)
        try:
            return self.process.wait(60)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        finally:
            self._reader.join(10)  # it closes the pipe


@pytest.fixture(scope="session")
def compiled_kernels() -> None:
    """Fill the kernel cache, so that no deadline of a page's test includes a compiler's time."""
    single()
    draw(Banner.parse("red creeper:lime"), view="hero", shadow=True, wind=4.0)


@pytest.fixture(scope="session")
def running_studio(compiled_kernels: None) -> Iterator[Studio]:
    """A studio at a free port."""
    pytest.importorskip("nicegui")
    with tempfile.TemporaryDirectory() as folder:
        studio = Studio(Path(folder))
        yield studio
        studio.stop()


@pytest.fixture
def studio(running_studio: Studio) -> Studio:
    """A studio with an empty library, whatever other tests have saved there."""
    from drapery.studio.library import Library

    library = Library(running_studio.library)
    for design in library.search(limit=1000)[0]:
        library.remove(design.number)
    return running_studio


@pytest.fixture(scope="session")
def chromium(playable: object) -> Iterator[Any]:
    """A browser of its own profile; skipped only where there is no Chromium or driver, or no
    compiler for the kernels of pages."""
    if CHROMIUM is None or DRIVER is None:
        pytest.skip("Chromium and its driver are not installed (apt: chromium, chromium-driver)")
    with tempfile.TemporaryDirectory() as folder:
        driver = open_browser(Path(folder))
        yield driver
        driver.quit()


def open_browser(folder: Path) -> Any:
    """A Chromium whose profile and downloads lie in a folder."""
    from selenium.webdriver import Chrome, ChromeOptions, ChromeService

    options = ChromeOptions()
    options.binary_location = str(CHROMIUM)
    for flag in (*FLAGS, f"--user-data-dir={folder / 'profile'}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    downloads = {"download.default_directory": str(folder / "downloads")}
    options.add_experimental_option("prefs", downloads)
    driver = Chrome(options=options, service=ChromeService(str(DRIVER)))
    driver.set_script_timeout(30)
    driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": SEEN})
    resize(driver, WIDE)
    return driver


def resize(driver: Any, size: tuple[int, int], *, dark: bool = False, moves: bool = False) -> None:
    """The size of what is seen [CSS pixels], whether the system's theme is dark, and whether its
    user wants motion: cloth that waves, drawn without a graphics card here, takes the time of all
    else."""
    metrics = {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    theme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
    motion = {"name": "prefers-reduced-motion", "value": "no-preference" if moves else "reduce"}
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [theme, motion]})


def open_page(driver: Any, studio: Studio, query: str = "") -> None:
    """Load the page anew and wait until it answers."""
    open_address(driver, studio.address + query)


def open_address(driver: Any, address: str) -> None:
    """Load a page of a studio by its whole address and wait until it answers."""
    # To open the address that is shown already means to load it again, which keeps its work.
    driver.get("about:blank")
    driver.get_log("browser")
    driver.get(address)
    wait_until(lambda: driver.execute_script("return !!window.studio?.ready"))


def open_tab(driver: Any, name: str) -> Any:
    """Click a tab, after its group; returns its panel."""
    tab = driver.find_element("id", f"tab-{name}")
    group = tab.find_element("xpath", "..").get_property("id")
    driver.find_element("css selector", f".group[aria-controls={group}]").click()
    tab.click()
    panel = driver.find_element("id", f"panel-{name}")
    wait_until(panel.is_displayed)
    return panel


def paste(driver: Any, text: str) -> None:
    """What Ctrl+V does when no field has the focus."""
    driver.execute_script(PASTE, text)


def drop(driver: Any, name: str, data: bytes, on: str = ".viewport") -> None:
    """What a file does that is dropped on a part of the page."""
    driver.execute_script(DROP, name, b64encode(data).decode(), on)


def wait_until(condition: Callable[[], T], seconds: float = 60.0) -> T:
    """The first true value of the condition. Raises AssertionError after this time [s].

    To ask takes processor time of three processes, so it asks seldom what takes long.
    """
    pause, end = 0.02, time.monotonic() + seconds
    while time.monotonic() < end:
        if answer := condition():
            return answer
        time.sleep(pause)
        pause = min(1.4 * pause, 0.12)
    raise AssertionError(f"still not so after {seconds} s")


def notices(driver: Any, role: str = "") -> list[str]:
    """All notices since the page was opened. role: `alert` for those that are read at once."""
    shown = driver.execute_script("return window.seenNotices")
    return [text for its_role, text in shown if role in ("", its_role)]


def lying(folder: Path, pattern: str) -> set[Path]:
    """The files of a folder that fit, of which some may be going at this moment."""
    # A path's own glob minds folders that go while it looks.
    found = glob(f"{folder}/{pattern}", recursive=True, include_hidden=True)  # noqa: PTH207
    return set(map(Path, found))


def console_errors(driver: Any) -> list[str]:
    """What the browser's console calls severe since the page was opened."""
    return [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
