"""The site: the designer at its root leads to the docs and back, under any path."""

import io
import re
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from pathlib import Path
from typing import Any
from urllib.parse import urljoin
from urllib.request import urlopen

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


@pytest.mark.parametrize(
    ("name", "size", "page", "fault"),
    [
        ("cloth.bin", 260_001, 0, "the designer loads 260001 bytes at first: over 260000"),
        ("wall.bin", 260_001, 300_001, "a page of one file has 300001 bytes: over 300000"),
        ("index.html", 260_001, 0, None),  # it is sent gzipped
    ],
)
def test_large_pages_are_refused(
    tmp_path: Path, name: str, size: int, page: int, fault: str | None
) -> None:
    (tmp_path / name).write_bytes(bytes(size))
    with pytest.raises(SystemExit, match=fault) if fault else nullcontext():
        site.check_sizes(tmp_path, page * "x")


def test_a_server_of_another_user_may_read_the_site(tmp_path: Path) -> None:
    out = tmp_path / "site"
    out.mkdir(mode=0o755)
    with tempfile.TemporaryDirectory() as name:
        Path(name, PAGE).touch()
        site.put_files(Path(name), out)
    assert (out / PAGE).is_file() and out.stat().st_mode & 0o055 == 0o055


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


@pytest.fixture(scope="module")
def docs(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Path, str]]:
    """The folder of the docs under a prefix and its address; without live cloth and plugins."""
    pytest.importorskip("mkdocs", reason="the builder of the docs is not installed")
    from mkdocs.commands.build import build
    from mkdocs.config import load_config

    root = tmp_path_factory.mktemp("docs")
    folder = root / PREFIX / site.DOCS
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("drapery.web.wasm.module.module_places", lambda: [root / "none"])
        patch.syspath_prepend(ROOT / "docs")
        build(load_config(str(ROOT / "mkdocs.yml"), plugins=[], site_dir=str(folder)))
    for each in served(root):
        yield folder, f"{each}/{PREFIX}/{site.DOCS}/"


def links(folder: Path, target: str) -> Iterator[tuple[str, str]]:
    """Each page of the built docs, and what it links to of a kind, by a pattern."""
    for page in sorted(folder.rglob("*.html")):
        for found in re.findall(rf'<a [^>]*href="({target})"', page.read_text("utf-8")):
            yield page.relative_to(folder).as_posix(), found


def test_files_to_which_pages_link_can_be_loaded(docs: tuple[Path, str]) -> None:
    folder, address = docs
    loaded = {}
    for page, target in links(folder, r"(?:\.\./)*files/[^\"]+"):
        place = urljoin(address + page, target)
        with urlopen(place) as answer:
            loaded[place.partition("/files/")[2]] = answer.read()
    for name in ("release/compose.yaml", "release/Containerfile", "examples/crowd.py"):
        assert loaded[name] == (ROOT / name).read_bytes()
    assert loaded["release/blender/drapery_banners.py"] == packages.ADD_ON.read_bytes()
    with zipfile.ZipFile(io.BytesIO(loaded["examples/pack.zip"])) as archive:
        cases = ROOT / "examples" / "pack" / "cases.toml"
        assert archive.read("pack/cases.toml") == cases.read_bytes()
        assert "pack/.gitlab-ci.yml" in archive.namelist()


def test_a_page_that_names_a_file_of_the_repository_links_to_it(docs: tuple[Path, str]) -> None:
    """Explanations and notes are about the sources and name many; a command is typed, no link."""
    folder, _ = docs
    bare = []
    for page in sorted(folder.rglob("*.html")):
        name = page.relative_to(folder).as_posix()
        text = re.sub(r"(?s)<a .*?</a>|<pre.*?</pre>", "", page.read_text("utf-8"))
        for code in re.findall(r"<code>([\w.-]+/[\w./-]+)</code>", text):
            if (ROOT / code).exists() and not name.startswith(("explanation/", "notes/")):
                bare.append((name, code))
    assert bare == []


def test_no_link_of_a_page_leads_nowhere(docs: tuple[Path, str]) -> None:
    folder, _ = docs
    relative = r"(?![a-z]+:|#|/)[^\"#]+(?=[\"#])"
    missing = [
        (page, target)
        for page, target in links(folder, relative)
        if not (folder / page).parent.joinpath(target).exists()
    ]
    assert missing == []
