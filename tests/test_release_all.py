"""What a release publishes: its checksums, and what makes it refuse a checkout or a folder."""

import subprocess
from pathlib import Path

import pytest

from release import all as everything, build

# The digest of "abc" is the first example of FIPS 180-2, appendix B.
ABC = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"


def test_the_checksums_are_those_of_the_system(tmp_path: Path) -> None:
    (tmp_path / "npm").mkdir()
    (tmp_path / "npm" / "a.tgz").write_bytes(b"abc")
    (tmp_path / "SHA256SUMS").write_text("not of itself", "utf-8")
    assert everything.sums(tmp_path) == f"{ABC}  npm/a.tgz\n"


def test_files_that_differ_are_named() -> None:
    first, second = "1  a\n2  b\n3  c\n", "1  a\n9  b\n4  d\n"
    assert everything.differing(first, second) == ["b", "c", "d"]
    assert everything.differing(first, first) == []


def test_a_folder_with_files_is_refused(tmp_path: Path) -> None:
    (tmp_path / "old.whl").touch()
    with pytest.raises(SystemExit, match="holds files; name another folder"):
        everything.build_all(tmp_path, None)


def test_a_checkout_with_changes_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    (tmp_path / "new.py").touch()
    monkeypatch.setattr(build, "ROOT", tmp_path)
    with pytest.raises(SystemExit, match=r"has changes; commit them first:\n\?\? new.py"):
        everything.build_all(tmp_path / "dist", None)


def test_a_packed_folder_has_the_same_bytes_at_any_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1000")
    (tmp_path / "site" / "guides").mkdir(parents=True)
    for name in ("index.html", "guides/web.html"):
        (tmp_path / "site" / name).write_text(name, "utf-8")
    first = build.packed(tmp_path / "site", "site")
    (tmp_path / "site" / "index.html").touch()
    assert build.packed(tmp_path / "site", "site") == first
