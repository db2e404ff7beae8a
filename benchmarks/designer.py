"""The designer: how much its page loads, and the times of its previews in headless Chromium.

`python -m benchmarks.designer` needs Chromium, its driver and selenium, and the kernels of
`python -m drapery.web.wasm.build`.
"""

import argparse
import sys
import tempfile
import threading
import time
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from shutil import which
from typing import Any

from selenium.webdriver import Chrome, ChromeOptions, ChromeService

from benchmarks.quick import add_quick, needs
from benchmarks.web_page import FLAGS, SETTINGS
from drapery import Settings
from drapery.web.designer_page import write_designer
from drapery.web.wasm.module import is_module_built
from release.site import loaded_first, sent_bytes

READY = "return !!document.querySelector('drapery-designer')?.shadowRoot?.querySelector('.app')"
EDIT = """
const done = arguments[0];
const root = document.querySelector("drapery-designer").shadowRoot;
const start = performance.now();
root.querySelector('[data-pattern="border"]').click();
requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now() - start)));
"""
WORK = """
const root = document.querySelector("drapery-designer").shadowRoot;
const times = [];
for (const dye of root.querySelectorAll(".dye")) {
  const request = window.requestAnimationFrame;
  const asked = [];
  window.requestAnimationFrame = (call) => asked.push(call);
  const start = performance.now();
  dye.click();
  window.requestAnimationFrame = request;
  asked.forEach((call) => call(start));
  times.push(performance.now() - start);
}
return times.sort((a, b) => a - b)[8];
"""


class Quiet(SimpleHTTPRequestHandler):
    """Serves a folder and prints nothing."""

    def log_message(self, format: str, *args: Any) -> None:
        pass


def main() -> int:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    add_quick(parser)
    quick = parser.parse_args().quick
    needs(which("chromium") and which("chromedriver"), "Chromium or its driver")
    needs(is_module_built(), "The module of `drapery.web.wasm.build`")
    settings = Settings(**SETTINGS) if quick else Settings(size=(320, 480))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_designer(folder, settings)
        found = sent_bytes(folder)
        for file, size in found.items():
            print(f"{file:24} {size:7}")
        print(
            f"loaded at first: {loaded_first(found)} bytes gzipped;"
            f" with pictures and walls {sum(found.values())}"
        )
        server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=name))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        options = ChromeOptions()
        for flag in FLAGS:
            options.add_argument(flag)
        options.binary_location = str(which("chromium"))
        driver = Chrome(options=options, service=ChromeService(str(which("chromedriver"))))
        driver.get(f"http://127.0.0.1:{server.server_port}/")
        while not driver.execute_script(READY):
            time.sleep(0.05)
        print(
            f"a dye chosen, with all previews: {driver.execute_script(WORK):.1f} ms of the thread"
        )
        print(f"a layer added, until it is seen: {driver.execute_async_script(EDIT):.0f} ms")
        driver.quit()
        server.shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())
