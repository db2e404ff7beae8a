"""The tabs that make designs from words and from pictures."""

from pathlib import Path
from typing import Any

import pytest
from selenium.webdriver import Keys
from selenium.webdriver.common.by import By
from studio_browser import WIDE, Studio, console_errors, open_page, open_tab, resize, wait_until

from drapery import Banner, draw_face
from drapery.banner import letter_banners, write_banner


@pytest.fixture
def page(chromium: Any, studio: Studio) -> Any:
    resize(chromium, WIDE)
    open_page(chromium, studio)
    chromium.find_element(By.CSS_SELECTOR, ".live-bar button[aria-label=Pause]").click()
    return chromium


def value(page: Any, element_id: str) -> str:
    return page.execute_script(f"return document.getElementById('{element_id}').value")


def test_a_word_is_written_and_a_letter_opened(page: Any) -> None:
    panel = open_tab(page, "letters")
    word = panel.find_element(By.CSS_SELECTOR, "input[type=text]")
    word.send_keys(Keys.CONTROL + "a")
    word.send_keys("go 4", Keys.TAB)
    banners = letter_banners("GO 4")
    wait_until(
        lambda: value(page, "letters-text") == "\n".join(write_banner(b, "give") for b in banners)
    )
    letters = panel.find_elements(By.CSS_SELECTOR, ".letters button")
    names = [letter.get_attribute("aria-label") for letter in letters]
    assert len(names) == 4 and names[2] == "Banner: White"
    letters[0].click()
    wait_until(lambda: value(page, "written") == write_banner(banners[0], "give"))
    assert not console_errors(page)


def test_a_picture_becomes_candidates_and_one_is_opened(page: Any, tmp_path: Path) -> None:
    design = Banner.parse("red cross:white")
    draw_face(design, scale=2).save(tmp_path / "face.png")
    (tmp_path / "words.png").write_text("not a picture")
    panel = open_tab(page, "picture")
    panel.find_element(By.CSS_SELECTOR, "input[type=file]").send_keys(str(tmp_path / "face.png"))
    wait_until(lambda: "click one" in panel.find_element(By.CSS_SELECTOR, ".hint").text)
    pictures = panel.find_elements(By.CSS_SELECTOR, ".candidates button")
    assert pictures[0].get_attribute("aria-label") == ("the same: 1: Banner: Red; Cross, White")
    pictures[0].click()
    wait_until(lambda: value(page, "written") == write_banner(design, "give"))
    panel.find_element(By.CSS_SELECTOR, "input[type=file]").send_keys(str(tmp_path / "words.png"))
    said = "words.png is not a picture"
    wait_until(lambda: said in page.find_element(By.TAG_NAME, "body").text)
