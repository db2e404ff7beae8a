"""Every command, package, link and picture that the docs name exists."""

import re
from pathlib import Path

import pytest
import typer.main

from drapery.cli import app

ROOT = Path(__file__).parent.parent
PAGES = sorted(
    path.relative_to(ROOT).as_posix() for path in [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]
)


def test_the_readme_lists_every_command() -> None:
    listed = re.findall(r"^\| `drapery (\w+)", (ROOT / "README.md").read_text(), re.MULTILINE)
    assert sorted(listed) == sorted(typer.main.get_command(app).commands)  # type: ignore[attr-defined]


def test_the_architecture_page_names_every_package() -> None:
    text = (ROOT / "docs/explanation/architecture.md").read_text()
    packages = {path.parent for path in (ROOT / "drapery").glob("*/__init__.py")}
    for package in packages:
        assert f"`{package.relative_to(ROOT).as_posix()}/`" in text


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page: str) -> None:
    path = ROOT / page
    for target in re.findall(r"\]\((?!https?:)([^)#]+)", path.read_text()):
        assert (path.parent / target).exists(), target


def test_every_picture_of_the_docs_has_its_command() -> None:
    folder = ROOT / "docs" / "pictures"
    page = (ROOT / "docs" / "reference" / "pictures.md").read_text("utf-8")
    named = set(re.findall(r"`([\w/-]+\.(?:png|webp|gif))`", page.replace("NAME", "cel")))
    shown = {p.relative_to(folder).as_posix() for p in folder.rglob("*.*")}
    assert named == {name for name in shown if not name.startswith("styles/")} | {"styles/cel.png"}
