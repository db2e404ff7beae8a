"""axe-core finds no fault on any tab of the studio, light or dark, narrow or wide.

One of the six pages is looked at; `DRAPERY_STUDIO_AXE=all` looks at all of them.
"""

import os
from pathlib import Path
from typing import Any

import pytest
from pack_maker import BANNER, META, mcmeta, noise, png, zip_pack
from studio_browser import WIDE, Studio, open_page, resize, wait_until

AXE = Path(__file__).parents[1] / "js" / "node_modules" / "axe-core" / "axe.min.js"
PAGES = [(320, True)]
if os.environ.get("DRAPERY_STUDIO_AXE") == "all":
    PAGES = [(width, dark) for width in (320, 768, 1280) for dark in (False, True)]

RUN = """
const [where, done] = arguments;
const told = ({ id, impact, nodes }) =>
  `${id} (${impact}): ` + nodes.map((node) => node.html.slice(0, 160)).join("\\n  ");
axe.run(where, { resultTypes: ["violations"] }).then((found) => done(found.violations.map(told)));
"""


def seen_faults(page: Any, where: str) -> list[str]:
    """What axe calls a fault below an element."""
    # A page whose connection was lost for too long has been loaded again.
    if not page.execute_script("return !!window.axe"):
        page.execute_script(AXE.read_text(encoding="utf-8"))
    return list(page.execute_async_script(RUN, where))


@pytest.mark.skipif(not AXE.is_file(), reason="npm --prefix tests/js ci installs axe-core")
@pytest.mark.parametrize(("width", "dark"), PAGES)
def test_axe_finds_no_fault(
    chromium: Any, studio: Studio, tmp_path: Path, width: int, dark: bool
) -> None:
    resize(chromium, (width, 800), dark=dark)
    open_page(chromium, studio, "?design=red+creeper:lime+border:black")
    chromium.find_element("css selector", ".live-bar button[aria-label=Pause]").click()
    pack = zip_pack(tmp_path / "a.zip", {META: mcmeta(), f"{BANNER}creeper.png": png(noise(1))})
    send = chromium.find_element("css selector", "#panel-packs input[type=file]")
    send.send_keys(str(pack))
    names = chromium.execute_script(
        "return [...document.querySelectorAll('.tab')].map((e) => e.dataset.panel)"
    )
    assert len(names) >= 10
    wait_until(lambda: chromium.find_elements("css selector", ".pack[data-pack]"))
    faults = seen_faults(chromium, "html")
    for name in names:
        chromium.execute_script("studio.tab(arguments[0])", name)
        faults += seen_faults(chromium, f"#panel-{name}")
    resize(chromium, WIDE)
    assert not faults, "\n".join(dict.fromkeys(faults))
