"""What the docs say is so: every command, room, link and picture that they name is there."""

import re
from pathlib import Path

import pytest
import typer.main

from drapery.cli import app

ROOT = Path(__file__).parent.parent
PAGES = sorted(
    path.relative_to(ROOT).as_posix() for path in [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md")]
)


def test_the_readme_lists_every_command() -> None:
    listed = re.findall(r"^\| `drapery (\w+)", (ROOT / "README.md").read_text(), re.MULTILINE)
    assert sorted(listed) == sorted(typer.main.get_command(app).commands)  # type: ignore[attr-defined]


def test_the_house_names_every_room() -> None:
    house = (ROOT / "docs/architecture.md").read_text()
    rooms = {path.parent for path in (ROOT / "drapery").glob("*/__init__.py")}
    for room in rooms:
        assert f"`{room.relative_to(ROOT).as_posix()}/`" in house


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page: str) -> None:
    path = ROOT / page
    for target in re.findall(r"\]\((?!https?:)([^)#]+)", path.read_text()):
        assert (path.parent / target).exists(), target
