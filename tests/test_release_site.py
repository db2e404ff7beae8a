"""The site: the designer at its root leads to the docs and back, under any path."""

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from selenium.webdriver.common.by import By
from studio_browser import wait_until
from web_sites import is_live, open_site, served, warnings

from drapery.settings import Settings
from drapery.web.designer_page import PAGE, write_designer
from release import packages, site

ROOT = Path(__file__).parent.parent
PREFIX = "under/a/prefix"
INNER = "document.querySelector('drapery-designer')?.shadowRoot?.querySelector('drapery-banner')"


def test_each_link_of_the_designer_is_a_page_of_the_docs() -> None:
    for target in site.LINKS:
        if target != f"{packages.FOLDER}/index.html":
            assert (ROOT / target).with_suffix(".md").is_file(), target
            assert target.startswith(f"{site.DOCS}/"), "relative, so that any prefix works"


def test_the_first_page_of_the_docs_has_the_words_that_become_links() -> None:
    texts = re.findall(r'(?m)^\w+_GUIDE = "(.*)"$', (ROOT / "docs/hooks.py").read_text("utf-8"))
    first = (ROOT / "docs/index.md").read_text("utf-8")
    assert len(texts) == 2 and all(text in first for text in texts)


@pytest.fixture(scope="module")
def address(
    playable: Callable[..., Settings], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[str]:
    """The designer of the site, and a page in place of each page of the docs."""
    root = tmp_path_factory.mktemp("site")
    folder = root / PREFIX
    write_designer(folder, playable(size=(320, 480)))
    page = folder / PAGE
    page.write_text(site.linked(page.read_text("utf-8")), "utf-8")
    for target in site.LINKS:
        (folder / target).parent.mkdir(parents=True, exist_ok=True)
        (folder / target).write_text(f'<title>{target}</title><a href="{site.DESIGNER}">x</a>')
    for each in served(root):
        yield f"{each}/{PREFIX}/"


def test_the_designer_leads_to_the_docs_under_a_prefix(chromium: Any, address: str) -> None:
    for target, title in site.LINKS.items():
        open_site(chromium, address, ready=False)
        wait_until(lambda: is_live(chromium, INNER))
        assert warnings(chromium) == []
        chromium.find_element(By.LINK_TEXT, title).click()
        wait_until(lambda target=target: chromium.title == target)
    open_site(chromium, f"{address}docs/index.html", ready=False)
    chromium.find_element(By.LINK_TEXT, "x").click()
    wait_until(lambda: is_live(chromium, INNER))
