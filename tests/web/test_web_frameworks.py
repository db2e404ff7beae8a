"""The element in plain HTML, React and Vue: each example in a browser follows its input."""

import os
import shutil
import subprocess
import threading
from collections.abc import Callable, Iterator
from functools import partial
from http.server import ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest
from selenium.webdriver import Keys
from selenium.webdriver.common.by import By
from studio_browser import wait_until
from web_sites import Handler, changes, first_picture, is_live, open_site

from drapery import Banner
from drapery.settings import Settings
from drapery.web import package
from drapery.web.gallery import ITEMS, gallery_text
from drapery.web.page import write_page

EXAMPLES = Path(__file__).parents[2] / "examples" / "web"
MODULES = Path(__file__).parents[1] / "js" / "node_modules"
AXE = MODULES / "axe-core" / "axe.min.js"
BUNDLED = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Example</title>
<body><script type="module" src="drapery-banner/NAME.js"></script></body></html>
"""
FAULTS = """
const [done] = arguments;
const told = ({ id, nodes }) => [id, ...nodes.map((node) => node.html.slice(0, 160))];
axe.run({ resultTypes: ["violations"] }).then((found) => done(found.violations.map(told)));
"""

pytestmark = pytest.mark.skipif(
    not (MODULES / "vue").is_dir(), reason="the frameworks are missing (npm --prefix tests/js ci)"
)


@pytest.fixture(scope="module")
def examples(
    playable: Callable[..., Settings], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[str]:
    """The address of a folder with the examples, a gallery and a page of one file."""
    folder = tmp_path_factory.mktemp("examples")
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(package, "POSES", {})  # players need other kernels
        package.write_component(folder / "drapery-banner", playable())
    shutil.copy(EXAMPLES / "plain.html", folder)
    for source in (EXAMPLES / "react.jsx", EXAMPLES / "vue.js"):
        bundle(source, folder / "drapery-banner")
        text = BUNDLED.replace("NAME", source.stem)
        (folder / f"{source.stem}.html").write_text(text, encoding="utf-8")
    (folder / "gallery.html").write_text(gallery_text(playable(), ITEMS[:2]), encoding="utf-8")
    write_page(folder / "banner.html", Banner.parse("white creeper:lime"), playable())
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()


def bundle(source: Path, package: Path) -> None:
    """Put an example, its framework and the element into one module beside the element's files."""
    command = [
        *(MODULES / ".bin" / "esbuild", source, "--bundle", "--format=esm", "--jsx=automatic"),
        *("--define:__VUE_OPTIONS_API__=false", "--define:__VUE_PROD_DEVTOOLS__=false"),
        "--define:__VUE_PROD_HYDRATION_MISMATCH_DETAILS__=false",
        "--define:process.env.NODE_ENV='production'",
        *("--log-level=warning", f"--alias:drapery-banner={package / 'drapery-banner.js'}"),
        f"--outfile={package / source.stem}.js",
    ]
    environment = os.environ | {"NODE_PATH": str(MODULES)}
    subprocess.run(list(map(str, command)), env=environment, check=True, timeout=60)


@pytest.mark.parametrize("name", ["plain", "react", "vue"])
def test_an_example_shows_what_is_typed(chromium: Any, examples: str, name: str) -> None:
    open_site(chromium, f"{examples}/{name}.html", moves=False, ready=False)
    wait_until(lambda: chromium.find_elements(By.CSS_SELECTOR, "drapery-banner"))
    wait_until(lambda: is_live(chromium))
    status = chromium.find_element(By.CSS_SELECTOR, "[role=status]")
    wait_until(lambda: status.text == "Ready")
    lime = first_picture(chromium)
    field = chromium.find_element(By.CSS_SELECTOR, "input")
    field.send_keys("x")
    wait_until(lambda: "unknown" in status.text)
    assert not changes(chromium, lime), "what was seen stays"
    field.send_keys(Keys.BACKSPACE + " border:black")
    wait_until(lambda: changes(chromium, lime))


@pytest.mark.parametrize("name", ["plain", "banner", "gallery"])
def test_axe_finds_no_fault(chromium: Any, examples: str, name: str) -> None:
    open_site(chromium, f"{examples}/{name}.html", moves=False)
    chromium.execute_script(AXE.read_text(encoding="utf-8"))
    assert chromium.execute_async_script(FAULTS) == []
