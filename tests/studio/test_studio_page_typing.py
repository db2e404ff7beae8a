"""What is typed on the page arrives, however slow the network is."""

import os
from collections.abc import Iterator
from typing import Any

import pytest
from network_delay import delayed
from selenium.webdriver import ActionChains, Keys
from studio_browser import WIDE, Studio, console_errors, open_address, resize, wait_until

from drapery.settings import Settings
from drapery.studio.share import read_link

DELAY = float(os.environ.get("DRAPERY_STUDIO_DELAY", "0.15"))
"""How late each message is [s]."""
PACES = (0.06, 0.16)
"""How long each key takes [s]."""
COUNT = int(os.environ.get("DRAPERY_STUDIO_TYPED", "6"))
"""How many values are typed."""


@pytest.fixture
def page(chromium: Any, studio: Studio) -> Iterator[Any]:
    resize(chromium, WIDE)
    with delayed(studio.address, DELAY) as address:
        open_address(chromium, address)
        # A cloth that waves is drawn without a graphics card here, and takes the time of all else.
        chromium.find_element("css selector", ".live-bar button[aria-label=Pause]").click()
        yield chromium
        chromium.get("about:blank")


def field(page: Any, panel: str, label: str) -> Any:
    """The field of a panel whose label begins with these words."""
    path = f"//section[@id='panel-{panel}']//label[starts-with(normalize-space(.), '{label}')]"
    return page.find_element("xpath", f"{path}//input")


def replace_text(page: Any, words: str, pace: float) -> None:
    """Select what the focused field holds and type other words, one key in `pace` seconds."""
    keys = ActionChains(page, duration=0).key_down(Keys.CONTROL).send_keys("a")
    keys.key_up(Keys.CONTROL)
    for letter in words:
        keys.pause(pace).send_keys(letter)
    keys.perform()


def in_address(page: Any) -> tuple[str, tuple[int, int]]:
    """The title and the size of the picture in the page's address."""
    link = page.current_url.partition("?d=")[2]
    if not link:
        return "", Settings().size
    sketch, settings = read_link(link)
    return sketch.title, settings.size


def test_nothing_typed_is_lost_through_a_slow_network(page: Any) -> None:
    page.execute_script("studio.tab('export')")
    width = wait_until(lambda: field(page, "export", "Width"))
    for number in range(0, COUNT, 3):
        pace = PACES[number // 3 % len(PACES)]
        wide, high, title = 1200 + number, 1080 - number, f"Flag {number}"
        page.execute_script("arguments[0].focus()", width)
        replace_text(page, str(wide), pace)
        ActionChains(page).send_keys(Keys.TAB).perform()
        replace_text(page, str(high), pace)
        page.execute_script("document.querySelector('input.title').focus()")
        replace_text(page, title, pace)
        ActionChains(page).send_keys(Keys.TAB).perform()
        wanted = (title, (wide, high))
        wait_until(lambda wanted=wanted: in_address(page) == wanted)
        shown = [field(page, "export", name).get_property("value") for name in ("Width", "Height")]
        assert shown == [str(wide), str(high)]
    assert console_errors(page) == []


def test_an_undo_reaches_a_field_that_is_not_in_use(page: Any) -> None:
    title = page.find_element("css selector", "input.title")
    title.send_keys("Lime Ghost", Keys.TAB)
    wait_until(lambda: in_address(page)[0] == "Lime Ghost")
    page.find_element("css selector", "button[aria-label=Undo]").click()
    wait_until(lambda: title.get_property("value") == "")
