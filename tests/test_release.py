"""What a release publishes agrees: the version, the dependencies, the changelog."""

import re
import tomllib
from importlib import metadata
from pathlib import Path

import yaml
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


def test_files_that_repeat_the_version_have_that_of_the_package() -> None:
    """`pyproject.toml` has the version; these formats cannot read it from there."""
    version = PROJECT["version"]
    assert version == metadata.version("drapery")
    pinned = [*ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/*/.*.yaml")]
    pinned += ROOT.glob("examples/*/.github/workflows/*.yml")
    text = "".join(path.read_text("utf-8") for path in pinned)
    found = re.findall(r"drapery/drapery@v([\d.]+)|rev: v([\d.]+)", text)
    assert len(found) > 4 and {"".join(each) for each in found} == {version}


def test_the_changelog_has_the_form_of_keep_a_changelog() -> None:
    text = (ROOT / "CHANGELOG.md").read_text("utf-8")
    versions = re.findall(r"(?m)^## (.*)$", text)
    for version in versions:
        assert re.fullmatch(r"\[(Unreleased|\d+\.\d+\.\d+\] - \d{4}-\d\d-\d\d)\]?", version), (
            version
        )
        name = version[1:].partition("]")[0]
        assert f"\n[{name}]: https://" in text
    assert "[Unreleased]" in versions[:1] or versions[0].startswith(f"[{PROJECT['version']}]")
    kinds = set(re.findall(r"(?m)^### (.*)$", text))
    assert kinds <= {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"}
    lines = text[text.index("\n### ") :].splitlines()
    stray = [line for line in lines if not re.match(r"#|- |  \S|\[|$", line)]
    assert not stray


def test_the_citation_has_the_version_of_the_package() -> None:
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert cited["version"] == metadata.version("drapery")
    assert cited["cff-version"] == "1.2.0" and cited["title"] and cited["authors"]
    licence = metadata.metadata("drapery")["License-Expression"]
    assert " AND ".join(cited["license"]) == licence


def test_the_conda_recipe_needs_what_the_package_needs() -> None:
    recipe = yaml.safe_load((ROOT / "release/conda/recipe.yaml").read_text("utf-8"))
    assert recipe["context"]["version"] == PROJECT["version"]
    assert recipe["about"]["license"] == PROJECT["license"]
    assert recipe["build"]["python"]["entry_points"] == [
        f"{name} = {place}" for name, place in PROJECT["scripts"].items()
    ]
    python, *run = recipe["requirements"]["run"]
    least = python.replace("${{ python_min }}", recipe["context"]["python_min"])
    assert least == f"python {PROJECT['requires-python']}"
    needed = [Requirement(text) for text in PROJECT["dependencies"]]
    listed = {name: SpecifierSet(bounds) for name, bounds in (line.split(" ") for line in run)}
    assert listed == {each.name: each.specifier for each in needed}
