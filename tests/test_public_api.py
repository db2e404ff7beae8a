"""The public API: every change is announced, and every name is documented."""

import pydoc
from importlib import import_module

from public_api import (
    PACKAGES,
    ROOT,
    announced,
    changed,
    load,
    public_objects,
    read_record,
    signatures,
)

import drapery


def test_every_change_of_a_public_signature_is_in_the_changelog() -> None:
    names = announced((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"))
    silent = [
        name
        for name in changed(read_record(), signatures())
        if not names & set(name.split(".")[1:])
    ]
    assert not silent, f"write in CHANGELOG.md, in backquotes, what changed of: {', '.join(silent)}"


def test_a_changed_signature_is_noticed() -> None:
    before = {"drapery.draw": "function(banner: Banner)", "drapery.Gone": "class()"}
    now = {"drapery.draw": "function(banner: str)", "drapery.New": "class()"}
    assert changed(before, now) == ["drapery.Gone", "drapery.New", "drapery.draw"]


def test_only_the_newest_section_of_the_changelog_announces() -> None:
    text = "# Changes\n\n## 0.2\n- `draw(banner=)` is new\n\n## 0.1\n- `old`\n"
    assert announced(text) == {"draw", "banner"}


def test_every_public_name_has_a_docstring() -> None:
    bare = [name for name, found in public_objects(load()) if not found.has_docstring]
    assert not bare, f"document: {', '.join(bare)}"


def test_help_shows_arrays_by_the_names_of_their_types() -> None:
    found = [
        f"{package.__name__}.{name}: {line.strip()}"
        for package in map(import_module, PACKAGES)
        for name in package.__all__
        if not isinstance(getattr(package, name), str)
        for line in pydoc.plaintext.document(getattr(package, name), name).splitlines()
        if "ndarray[" in line.lower()
    ]
    assert not found, "\n".join(["use a type of drapery.arrays:", *found])


def test_every_public_package_is_in_the_reference_and_in_the_text_of_drapery() -> None:
    pages = {path.stem for path in (ROOT / "docs/reference/python").glob("*.md")}
    assert pages == {name.rpartition(".")[2] for name in PACKAGES}
    nav = (ROOT / "mkdocs.yml").read_text("utf-8")
    assert all(f"reference/python/{page}.md" in nav for page in pages)
    assert all(f"`{name}`" in str(drapery.__doc__) for name in PACKAGES if name != "drapery")


def test_a_public_name_has_one_meaning() -> None:
    meanings: dict[str, list[object]] = {}
    for package in map(import_module, PACKAGES):
        for name in package.__all__:
            meanings.setdefault(name, []).append(getattr(package, name))
    several = [name for name, found in meanings.items() if any(each != found[0] for each in found)]
    assert not several
