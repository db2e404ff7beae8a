"""The address of a page without a server holds a design, which the page shows."""

from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import quote

from studio_browser import WIDE, resize, wait_until

from drapery import Banner
from drapery.banner import alt_text
from drapery.settings import Settings
from drapery.studio.embeds import EmbedPlaces, page_link
from drapery.web.page import write_page

OWN = Banner.parse("white creeper:lime border:black")


def test_a_link_shows_its_design_and_a_wrong_one_says_why(
    chromium: Any, playable: Callable[..., Settings], tmp_path: Path
) -> None:
    page = tmp_path / "banner.html"
    write_page(page, OWN, playable(size=(160, 240)))

    def asked(what: str) -> Any:
        return chromium.execute_script(f"return {what}")

    def label() -> str:
        canvas = "document.querySelector('drapery-banner').shadowRoot.querySelector('canvas')"
        return str(asked(f"{canvas}.ariaLabel"))

    resize(chromium, WIDE)
    link = page_link(EmbedPlaces(page.as_uri()), Banner.parse("blue globe:white"))
    chromium.get(link)
    wait_until(lambda: label() == "blue banner, white globe")
    wait_until(lambda: chromium.title == "blue banner, white globe")
    give = '/give @p minecraft:red_banner[banner_patterns=[{pattern:"flow",color:"black"}]]'
    chromium.execute_script(f"location.hash = '#{quote(give)}'")
    wait_until(lambda: chromium.title == "red banner, black flow")
    chromium.execute_script("location.hash = '#red%20creper:lime'")
    wait_until(lambda: "unknown pattern 'creper'" in asked("fault.textContent"))
    assert asked("!fault.hidden")
    own = "document.querySelector('drapery-banner').getAttribute('design')"
    wait_until(lambda: asked(own) == "white creeper:lime border:black")
    wait_until(lambda: chromium.title == label() == alt_text(OWN))
    chromium.execute_script("location.hash = ''")
    wait_until(lambda: asked("fault.hidden") and chromium.title == label() != "")
    assert "creeper" in label().lower()
