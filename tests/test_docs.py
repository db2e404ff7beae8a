"""Every command, package, link and picture that the docs name exists."""

import json
import re
import runpy
import tomllib
from pathlib import Path

import pytest
import typer.main
import yaml

from drapery.commands.app import command_line
from drapery.settings import NAMED_OPTIONS

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
PAGES = sorted(
    path.relative_to(ROOT).as_posix() for path in [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]
)


def test_the_reference_describes_every_command_and_option() -> None:
    text = (ROOT / "docs/reference/commands.md").read_text("utf-8")
    for name, command in typer.main.get_command(command_line()).commands.items():  # type: ignore[attr-defined]
        for inner in getattr(command, "commands", {"": command}):
            assert f"\n## {f'drapery {name} {inner}'.strip()}\n" in text
    listed = (ROOT / "docs/reference/options.md").read_text("utf-8")
    assert all(f"`{option.command_flag}`" in listed for option in NAMED_OPTIONS.values())


def test_the_generated_parts_of_pages_are_as_the_sources_say(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """They can be read in a checkout, where no builder of a site adds anything."""
    monkeypatch.syspath_prepend(ROOT / "docs")
    tables = runpy.run_path(str(ROOT / "docs" / "tables.py"))
    written = dict(tables["pages"]())
    assert len(written) > 16
    stale = [path.name for path, text in written.items() if path.read_text("utf-8") != text]
    assert stale == [], "run `python docs/tables.py`"


def test_lines_on_parameters_become_a_list() -> None:
    with_lists = runpy.run_path(str(ROOT / "docs" / "parameter_lists.py"))["with_lists"]
    text = "Draws.\n\na: one\n    number.\nb: one\ntoo.\nNote: it is slow.\nRaises X."
    made = "Draws.\n\n- `a`: one number.\n- `b`: one too.\n\nNote: it is slow.\nRaises X."
    assert with_lists(text, {"a", "b"}) == made


def test_the_page_of_packages_names_every_one() -> None:
    text = (ROOT / "docs/explanation/packages.md").read_text("utf-8")
    packages = {path.parent for path in (ROOT / "drapery").glob("*/__init__.py")}
    for package in packages:
        assert f"`{package.relative_to(ROOT).as_posix()}/`" in text


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page: str) -> None:
    path = ROOT / page
    for target in re.findall(r"\]\((?!https?:)([^)#]+)", path.read_text("utf-8")):
        assert (path.parent / target).exists(), target


def linked_from(pages: set[str]) -> set[str]:
    """The pages of the docs to which some pages link in their text."""
    found = set()
    for page in pages:
        folder = (ROOT / "docs" / page).parent
        for target in re.findall(
            r"\]\((?!https?:)([^)#]+\.md)", (ROOT / "docs" / page).read_text("utf-8")
        ):
            path = (folder / target).resolve()
            if path.is_relative_to(ROOT / "docs"):
                found.add(path.relative_to(ROOT / "docs").as_posix())
    return found


def test_each_guide_is_at_most_two_clicks_from_the_first_page() -> None:
    first = linked_from({"index.md"})
    reached = first | linked_from(first)
    guides = {path.relative_to(ROOT / "docs").as_posix() for path in ROOT.glob("docs/guides/*.md")}
    assert guides - reached == set()
    text = (ROOT / "docs/index.md").read_text("utf-8")
    for kind in ("a style", "a garment", "a solver", "a golden test"):
        assert f"[{kind}](" in text


def test_every_picture_of_the_docs_has_its_command() -> None:
    folder = ROOT / "docs" / "pictures"
    page = (ROOT / "docs" / "reference" / "pictures.md").read_text("utf-8")
    named = set(re.findall(r"`([\w/-]+\.(?:png|webp|gif))`", page))
    shown = {path.relative_to(folder).as_posix() for path in folder.rglob("*.*")}
    galleries = re.compile(r"^(styles|garments)/[\w-]+\.png$")
    assert named == {galleries.sub(r"\1/NAME.png", name) for name in shown}
    drawn = {path.stem for path in (folder / "garments").iterdir()}
    assert drawn == {path.stem for path in ROOT.glob("drapery/garments/files/*.toml")}


@pytest.mark.parametrize("page", sorted(ROOT.glob("docs/guides/*.md")), ids=lambda page: page.stem)
def test_a_guide_opens_with_its_picture_and_ends_with_where_to_go(page: Path) -> None:
    if page.stem == "index":
        return
    _, picture, *_, last = page.read_text("utf-8").split("\n\n")
    assert picture.startswith("![") and last.startswith("Where to go: "), page


def test_every_extra_is_explained() -> None:
    page = (ROOT / "docs/reference/extras.md").read_text("utf-8")
    explained = re.findall(r"(?m)^\| `([\w-]+)` \|", page)
    assert sorted(explained) == sorted(PROJECT["optional-dependencies"])


def test_the_site_is_built_with_what_breaks_signatures_into_lines() -> None:
    """Without it mkdocstrings says nothing, and leaves each signature in one line."""
    assert "separate_signature: true" in (ROOT / "mkdocs.yml").read_text("utf-8")
    assert any(each.startswith("ruff") for each in PROJECT["optional-dependencies"]["docs"])


def test_the_forms_of_issues_can_be_filled_in() -> None:
    folder = ROOT / ".github" / "ISSUE_TEMPLATE"
    forms = [path for path in folder.glob("*.yml") if path.stem != "config"]
    assert len(forms) >= 7
    for path in forms:
        form = yaml.safe_load(path.read_text("utf-8"))
        assert form["name"] and form["description"]
        fields = [field for field in form["body"] if field["type"] != "markdown"]
        assert all(field["attributes"]["label"] for field in fields)
        assert len({field["id"] for field in fields}) == len(fields)


def test_the_container_installs_what_the_gate_installs() -> None:
    container = json.loads((ROOT / ".devcontainer" / "devcontainer.json").read_text("utf-8"))
    command = container["postCreateCommand"]
    assert ".[dev,docs]" in command
    assert ".[dev,docs]" in (ROOT / ".ci" / "run").read_text("utf-8")


def test_the_archive_for_npm_is_named_after_the_version() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    texts = [path.read_text("utf-8") for path in (ROOT / "docs").rglob("*.md")]
    found = {name for text in texts for name in re.findall(r"drapery-banner-[^ `/]*\.tgz", text)}
    assert found == {f"drapery-banner-{project['version']}.tgz"}
