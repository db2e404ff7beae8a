"""The studio in Firefox: its page is clicked and typed in, its cloth waves, and files are made."""

import os
from collections.abc import Iterator
from pathlib import Path
from urllib.request import urlopen

import numpy as np
import pytest
from firefox_browser import Firefox
from PIL import Image
from studio_browser import Studio, wait_until

from drapery import Banner, Settings
from drapery.banner import write_banner

ENTER, TAB = "\ue007", "\ue004"
"""Keys in WebDriver."""
SHOTS = os.environ.get("DRAPERY_STUDIO_SHOTS")


@pytest.fixture
def page(firefox: Firefox, studio: Studio) -> Iterator[Firefox]:
    firefox.errors.clear()  # those of pages before
    firefox.open(studio.address)
    wait_until(lambda: firefox.ask("!!window.studio?.ready"))
    yield firefox
    if SHOTS:
        Path(SHOTS).mkdir(parents=True, exist_ok=True)
        Image.fromarray(firefox.screenshot()).save(f"{SHOTS}/firefox.png")
    assert firefox.errors == []
    firefox.open("about:blank")


def is_now(page: Firefox, design: str) -> None:
    wanted = write_banner(Banner.parse(design), "give")
    wait_until(lambda: page.ask("document.getElementById('written').value") == wanted)


def positions(page: Firefox) -> np.ndarray:
    """Where the vertices of the live cloth are, shape [3 V]."""
    player = "document.querySelector('.viewer').viewer?.players[0]"
    return np.asarray(page.ask(f"[...({player}?.drawing.scene.positions ?? [])]"))


def test_a_banner_is_designed_waves_and_becomes_a_file(page: Firefox) -> None:
    wait_until(lambda: positions(page).size)
    before = positions(page)
    wait_until(lambda: np.abs(positions(page) - before).max() > 0.02)
    seen = page.screenshot()
    wait_until(lambda: (page.screenshot() != seen).any(axis=2).mean() > 0.001)
    page.click(".live-bar button[aria-label=Pause]")
    page.click("[data-dye=black]")
    page.press("/", *"pirate", ENTER)
    is_now(page, "black skull:white")
    page.click("input.title")
    page.press(*"Jolly Roger", TAB)
    wait_until(lambda: page.ask("document.title").startswith("Jolly Roger - "))
    page.click(".group[aria-controls=tabs-2]")
    page.click("#tab-export")
    page.click("#panel-export button[aria-label='Export the file']")
    link = "document.querySelector('#panel-export .export-link')"
    wait_until(lambda: page.ask(f"{link}.innerText").startswith("jolly-roger.png, "))
    file = page.downloads / "jolly-roger.png"
    made = urlopen(page.ask(f"{link}.href"), timeout=30).read()
    wait_until(lambda: file.exists() and file.read_bytes() == made)
    assert Image.open(file).size == Settings().size
