"""A page with live cloth in Firefox: it waves, turns and pauses by keyboard."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from firefox_browser import Firefox
from studio_browser import wait_until

from drapery import Banner
from drapery.settings import Settings
from drapery.web.page import write_page

ELEMENT = "document.querySelector('drapery-banner')"
ENTER_PAGE, RIGHT = "\ue004", "\ue014"
"""The keys Tab and arrow right in WebDriver."""


def differs(browser: Firefox, before: np.ndarray) -> bool:
    return bool((browser.screenshot() != before).any(axis=2).mean() > 0.002)


def test_a_page_waves_turns_and_pauses(
    firefox: Firefox, playable: Callable[..., Settings], tmp_path: Path
) -> None:
    page = tmp_path / "banner.html"
    write_page(page, Banner.parse("white creeper:lime border:black"), playable(size=(320, 480)))
    firefox.open(page.as_uri())
    wait_until(lambda: firefox.ask(f"!{ELEMENT}.shadowRoot.querySelector('canvas').hidden"))
    before = firefox.screenshot()
    wait_until(lambda: differs(firefox, before))
    firefox.press(ENTER_PAGE, " ")
    assert firefox.ask(f"document.activeElement === {ELEMENT} && {ELEMENT}.paused")
    firefox.screenshot()
    still = firefox.screenshot()
    assert not differs(firefox, still)
    firefox.press(*[RIGHT] * 4)
    wait_until(lambda: differs(firefox, still))
    firefox.press(" ")
    assert not firefox.ask(f"{ELEMENT}.paused")
