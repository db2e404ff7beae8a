"""A folder of design files: every design with its file's name, and nothing dropped in silence."""

import os
from pathlib import Path

import pytest

from drapery.banner import Banner, FoundBanner, binary_forms, read_design, read_designs
from drapery.banner.formats import files
from drapery.errors import DesignError

RED, BLUE, LIME = Banner("red"), Banner("blue"), Banner("lime")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "designs"
    folder.mkdir()
    write = binary_forms()["nbt"].write
    assert write is not None
    (folder / "c.nbt").write_bytes(write(LIME))
    (folder / "a.txt").write_text("give @s red_banner\ngive @s blue_banner\n")
    (folder / "b.json").write_text('{"base": "blue"}')
    (folder / "d.snbt").write_text("{Items:[{Slot:0b,id:'minecraft:red_banner',count:1}]}")
    return folder


def test_every_design_of_a_folder_has_its_file_name_as_place(folder: Path) -> None:
    found = read_designs(folder)
    assert [(one.where.split()[0].split(".")[0], one.banner.base) for one in found] == [
        ("a", "red"),
        ("a", "blue"),
        ("b", "blue"),
        ("c", "lime"),
        ("d", "red"),
    ]
    assert found[:3] == [
        FoundBanner(RED, "a.txt line 1 red_banner"),
        FoundBanner(BLUE, "a.txt line 2 blue_banner"),
        FoundBanner(BLUE, "b.json"),
    ]
    assert found[4] == FoundBanner(RED, "d.snbt Items[0]")
    assert read_designs(f"{folder}/") == read_designs(str(folder)) == found
    assert read_design(folder, number=4) == LIME


def test_one_warning_names_all_that_is_not_read(folder: Path) -> None:
    (folder / "broken.json").write_text('{"base": "rad"}')
    (folder / "half.txt").write_text("give @s red_banner\ngive @s banner[\n")
    (folder / "notes.md").write_text("white creeper:lime")
    (folder / "old").mkdir()
    if hasattr(os, "mkfifo"):
        os.mkfifo(folder / "pipe.txt")
    (folder / "link.json").symlink_to(folder / "b.json")
    with pytest.warns(UserWarning) as caught:
        found = read_designs(folder)
    assert len(found) == 6
    (line,) = (str(warning.message) for warning in caught)
    assert line.startswith(f"{folder}: not read: broken.json (base: unknown dye 'rad'")
    for part in ("half.txt (line 2, ", "link.json (a link", "notes.md (", "old ("):
        assert part in line
    assert "\n" not in line and ("pipe.txt (not a file" in line) == hasattr(os, "mkfifo")


def test_a_long_list_of_what_is_not_read_is_cut_short_with_its_count(folder: Path) -> None:
    for number in range(30):
        (folder / f"n{number:02}.md").write_text("")
    with pytest.warns(UserWarning, match=r"n19\.md \([^)]*\), and 10 more$"):
        read_designs(folder)


def test_a_folder_without_designs_is_an_error_that_names_its_files(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"no design in the folder; give .*\.json"):
        read_designs(tmp_path)
    (tmp_path / "a.json").write_text("{}")
    (tmp_path / "b.png").write_text("")
    with pytest.raises(DesignError, match=r"no design in the folder; .*a\.json \(.*b\.png \("):
        read_designs(tmp_path)


def test_all_files_of_a_folder_are_read_in_the_form_that_is_named(folder: Path) -> None:
    for name in ("a.txt", "b.json", "d.snbt"):
        (folder / name).unlink()
    assert [one.banner for one in read_designs(folder, form="nbt")] == [LIME]
    with pytest.raises(DesignError, match="unknown form 'nbr'; did you mean 'nbt'"):
        read_designs(folder, form="nbr")


def test_a_folder_of_too_many_files_is_refused(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(files, "MAX_FILES", 3)
    with pytest.raises(DesignError, match="over 3 files; split it"):
        read_designs(folder)


def test_a_folder_by_its_bare_name(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder.parent)
    assert len(read_designs("designs")) == 5
