"""The package for conda: what it holds of a wheel, and that it needs what pyproject.toml says."""

import hashlib
import json
import tomllib
import zipfile
from pathlib import Path

import pytest
from conda_package_streaming.package_streaming import CondaComponent, stream_conda_component
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

from release import conda

PROJECT = tomllib.loads((Path(__file__).parent.parent / "pyproject.toml").read_text("utf-8"))[
    "project"
]
FOLDER = f"drapery_mc-{PROJECT['version']}.dist-info"
SOURCE = b"VALUE = 1\n"


def a_wheel(folder: Path, *more: str, tag: str = "py3-none-any") -> Path:
    """A wheel with one module and the metadata of pyproject.toml. more: lines of the metadata."""
    lines = [
        "Metadata-Version: 2.4",
        f"Name: {PROJECT['name']}",
        f"Version: {PROJECT['version']}",
        f"Summary: {PROJECT['description']}",
        f"License-Expression: {PROJECT['license']}",
        f"Requires-Python: {PROJECT['requires-python']}",
        *(f"Requires-Dist: {each}" for each in PROJECT["dependencies"]),
        'Requires-Dist: av>=18; extra == "video"',
        *more,
    ]
    commands = [f"{name} = {place}" for name, place in PROJECT["scripts"].items()]
    path = folder / f"drapery_mc-{PROJECT['version']}-{tag}.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("drapery/__init__.py", SOURCE)
        archive.writestr(f"{FOLDER}/METADATA", "\n".join(lines))
        text = "\n".join(["[console_scripts]", *commands, "[pytest11]", "drapery = drapery.plugin"])
        archive.writestr(f"{FOLDER}/entry_points.txt", text)
        for name in PROJECT["license-files"]:
            archive.writestr(f"{FOLDER}/licenses/{name}", name)
    return path


def part(package: Path, component: CondaComponent) -> dict[str, bytes]:
    """The names and contents of one of the two archives in a package."""
    held = {}
    for archive, member in stream_conda_component(package, component=component):
        file = archive.extractfile(member)
        assert file is not None and member.mode == 0o644
        held[member.name] = file.read()
    return held


@pytest.fixture
def package(tmp_path: Path) -> Path:
    return conda.build(a_wheel(tmp_path), tmp_path / "conda")


def test_the_package_needs_what_pyproject_says(package: Path) -> None:
    index = json.loads(part(package, CondaComponent.info)["info/index.json"])
    assert package.name == f"{index['name']}-{index['version']}-{index['build']}.conda"
    assert (index["name"], index["version"]) == (PROJECT["name"], PROJECT["version"])
    assert (index["noarch"], index["subdir"]) == ("python", "noarch")
    assert index["license"] == PROJECT["license"]
    python, *others = index["depends"]
    assert python == f"python {PROJECT['requires-python']}"
    listed = {name: SpecifierSet(bounds) for name, bounds in (each.split(" ") for each in others)}
    needed = [Requirement(text) for text in PROJECT["dependencies"]]
    assert listed == {each.name: each.specifier for each in needed}


def test_the_installer_makes_the_commands_of_pyproject(package: Path) -> None:
    link = json.loads(part(package, CondaComponent.info)["info/link.json"])
    commands = [f"{name} = {place}" for name, place in PROJECT["scripts"].items()]
    assert link["noarch"] == {"type": "python", "entry_points": commands}


def test_the_package_holds_and_lists_the_files_of_the_wheel(package: Path) -> None:
    info, files = (part(package, each) for each in (CondaComponent.info, CondaComponent.pkg))
    module = "site-packages/drapery/__init__.py"
    assert files[module] == SOURCE and f"site-packages/{FOLDER}/METADATA" in files
    assert info["info/files"].decode().splitlines() == [*files] == sorted(files)
    paths = {each["_path"]: each for each in json.loads(info["info/paths.json"])["paths"]}
    assert paths.keys() == files.keys()
    assert paths[module]["sha256"] == hashlib.sha256(SOURCE).hexdigest()
    assert paths[module]["size_in_bytes"] == len(SOURCE)
    for name in PROJECT["license-files"]:
        assert info[f"info/licenses/{name}"].decode() == name


def test_a_package_has_the_same_bytes_at_any_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    made = conda.build(a_wheel(tmp_path), tmp_path / "conda")
    first = made.read_bytes()
    monkeypatch.setattr("time.time", lambda: 1_800_000_000.0)
    assert conda.build(a_wheel(tmp_path), tmp_path / "conda") == made
    assert made.read_bytes() == first
    with zipfile.ZipFile(made) as archive:
        assert {each.date_time for each in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_a_wheel_of_one_platform_is_refused(tmp_path: Path) -> None:
    wheel = a_wheel(tmp_path, tag="py3-none-win_amd64")
    with pytest.raises(SystemExit, match="is no plain wheel; give one of py3-none-any"):
        conda.build(wheel, tmp_path)


def test_a_dependency_of_one_platform_is_refused(tmp_path: Path) -> None:
    wheel = a_wheel(tmp_path, "Requires-Dist: colorama; sys_platform == 'win32'")
    with pytest.raises(SystemExit, match="a package for any platform cannot need colorama"):
        conda.build(wheel, tmp_path)
