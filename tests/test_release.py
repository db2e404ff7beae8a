"""What a release publishes agrees: the version, the dependencies, the changelog."""

import re
import subprocess
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml

import drapery
from release import repository

ROOT = Path(__file__).parent.parent
THIS = "tests/test_release.py"
TEXTS = {".cff", ".json", ".md", ".po", ".py", ".sh", ".toml", ".txt", ".yaml", ".yml", ""}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


def test_files_that_repeat_the_version_have_that_of_the_package() -> None:
    """`pyproject.toml` has the version; these formats cannot read it from there."""
    version = PROJECT["version"]
    assert version == drapery.__version__
    text = "".join(path.read_text("utf-8") for path in repository.examples())
    found = re.findall(r"/drapery@v([\d.]+)|rev: v([\d.]+)", text)
    assert len(found) > 4 and {"".join(each) for each in found} == {version}


def test_the_extra_of_a_release_has_what_its_build_needs() -> None:
    """It is built without isolation, and a new environment has no setuptools."""
    needed = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["build-system"]["requires"]
    assert set(needed) <= set(PROJECT["optional-dependencies"]["release"])


def test_the_changelog_has_the_form_of_keep_a_changelog() -> None:
    text = (ROOT / "CHANGELOG.md").read_text("utf-8")
    versions = re.findall(r"(?m)^## (.*)$", text)
    for version in versions:
        assert re.fullmatch(r"\[(Unreleased|\d+\.\d+\.\d+\] - \d{4}-\d\d-\d\d)\]?", version), (
            version
        )
        name = version[1:].partition("]")[0]
        assert (f"\n[{name}]: {repository.ADDRESS}/" in text) == bool(repository.ADDRESS)
    assert "[Unreleased]" in versions[:1] or versions[0].startswith(f"[{PROJECT['version']}]")
    kinds = set(re.findall(r"(?m)^### (.*)$", text))
    assert kinds <= {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"}
    lines = text[text.index("\n### ") :].splitlines()
    stray = [line for line in lines if not re.match(r"#|- |  \S|\[|$", line)]
    assert not stray


def test_the_address_of_the_repository_stands_in_one_place() -> None:
    """Without an owner no file names an address, which would be somebody else's."""
    example = "https://github.com/somebody/drapery"
    plain, named = dict(repository.files("")), dict(repository.files(example))
    assert len(plain) > 6 and plain.keys() == named.keys()
    for path, text in repository.files(repository.ADDRESS):
        assert path.read_text("utf-8") == text, "run python -m release.repository"
        assert "somebody/drapery" in named[path] and "somebody" not in plain[path], path


def test_the_address_that_is_taken_out_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plain = dict(repository.files(""))
    for path, text in repository.files("https://github.com/somebody/drapery"):
        copy = tmp_path / path.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(text, "utf-8")
    monkeypatch.setattr(repository, "ROOT", tmp_path)
    again = {ROOT / path.relative_to(tmp_path): text for path, text in repository.files("")}
    assert again == plain


def known_texts() -> Iterator[tuple[str, str]]:
    """The name and text of each text file of the project."""
    listed = ["git", "-C", str(ROOT), "ls-files", "-z"]
    names = subprocess.run(listed, capture_output=True, text=True, check=True).stdout
    for name in filter(None, names.split("\0")):
        if Path(name).suffix in TEXTS and (ROOT / name).is_file():
            yield name, (ROOT / name).read_text("utf-8")


def test_nothing_installs_the_package_of_somebody_else() -> None:
    """`drapery` on the package index is another project; ours is `drapery-mc`."""
    assert PROJECT["name"] == "drapery-mc"
    asked = r"(?:pipx?|tool) install[^\n`&;#]*[ \"']drapery(?![\w.-])"
    pages = r"pypi\.org/project/drapery(?!-)"
    other = re.compile(rf"{asked}|uvx drapery(?!-)|\bdrapery\\?\[[a-z]|{pages}")
    assert other.search("pip install drapery") and other.search('"drapery[video]"')
    assert not other.search("pip install drapery-mc") and not other.search('"drapery-mc[gl]"')
    assert [name for name, text in known_texts() if name != THIS and other.search(text)] == []


def test_each_page_installs_from_a_checkout_first() -> None:
    """The index has no package of ours yet."""
    for path in [ROOT / "README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/*/*.md")]:
        text = path.read_text("utf-8")
        if published := re.search(r"pip install \"?drapery-mc", text):
            local = re.search(r"pip install \"?\.", text)
            assert local and local.start() < published.start(), path


def test_what_names_a_release_says_that_it_comes_with_the_first_one() -> None:
    """There is none yet: a reader would ask for a version or package that is not there."""
    released = re.compile(r"drapery@v\d|rev: v\d|pip install \"?drapery-mc")
    folders = (*ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/**/*"), ROOT / "README.md")
    named = [
        path
        for path in folders
        if path.suffix in (".md", ".yml", ".yaml") and released.search(path.read_text("utf-8"))
    ]
    assert {path.name for path in named} >= {"tutorial.md", "banners.yml", ".gitlab-ci.yml"}
    unsaid = [
        path for path in named if "first release" not in path.read_text("utf-8").replace("\n", " ")
    ]
    assert unsaid == []


def test_the_citation_has_the_version_of_the_package() -> None:
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert cited["version"] == PROJECT["version"]
    assert cited["cff-version"] == "1.2.0" and cited["title"] and cited["authors"]
    assert " AND ".join(cited["license"]) == PROJECT["license"]
