"""The package for npm: its files, and the same bytes on every run."""

import json
import tarfile
from pathlib import Path

import pytest

from release.check_npm import projects
from release.npm import TEXTS, pack

PACKAGE = {
    "name": "drapery-banner",
    "version": "0.1.0",
    "files": ["*.bin", "drapery-banner.js"],
    "main": "drapery-banner.js",
    "types": "drapery-banner.d.ts",
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """What `drapery web --component` writes, in small, with the licence."""
    made = tmp_path / "package"
    made.mkdir()
    for name in ("cloth.bin", "drapery-banner.js", "drapery-banner.d.ts", *TEXTS):
        (made / name).write_text(name, "utf-8")
    (made / "package.json").write_text(json.dumps(PACKAGE), "utf-8")
    return made


def packed(path: Path) -> dict[str, bytes]:
    """The contents of an archive by name."""
    with tarfile.open(path) as archive:
        members = archive.getmembers()
        assert [each.name for each in members] == sorted(each.name for each in members)
        assert {(each.uid, each.mtime, each.mode) for each in members} == {(0, 1000, 0o644)}
        return {each.name: archive.extractfile(each).read() for each in members}  # type: ignore[union-attr]


def test_the_package_has_its_types_licence_and_readme(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1000")
    first = pack(folder, tmp_path / "dist", "")
    assert first.name == "drapery-banner-0.1.0.tgz"
    assert packed(first) == {f"package/{path.name}": path.read_bytes() for path in folder.iterdir()}
    (folder / "cloth.bin").touch()
    assert pack(folder, tmp_path / "again", "").read_bytes() == first.read_bytes()


@pytest.mark.parametrize("name", ["LICENSE", "README.md", "drapery-banner.d.ts", "cloth.bin"])
def test_a_package_that_lacks_a_file_is_refused(folder: Path, tmp_path: Path, name: str) -> None:
    (folder / name).unlink()
    with pytest.raises(SystemExit, match=r"drapery-banner lacks (\*|LICENSE|README|drapery)"):
        pack(folder, tmp_path / "dist", "")


def test_the_package_names_the_repository_once_there_is_one(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1000")
    made = packed(pack(folder, tmp_path / "dist", "https://github.com/somebody/drapery"))
    url = "git+https://github.com/somebody/drapery.git"
    assert json.loads(made["package/package.json"])["repository"] == {"type": "git", "url": url}


def test_the_check_knows_each_bundler_of_the_guide() -> None:
    found = {each.name: each for each in projects()}
    assert list(found) == ["Vite", "Parcel", "webpack", "esbuild", "Rollup", "Next", "Astro"]
    assert found["Parcel"].files == found["Vite"].files
    for each in found.values():
        assert any("./drapery-banner" in words for words in each.commands), each.name
        assert each.commands[-1][0] == "npx" and "<drapery-banner" in "".join(each.files.values())
