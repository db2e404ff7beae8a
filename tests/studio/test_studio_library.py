"""The library keeps designs, finds them, shares its file with others and survives bad ones."""

import json
import sqlite3
import subprocess
import sys
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pack_maker import plain, png

from drapery.banner import Banner, FoundBanner
from drapery.banner.formats import parse_banner
from drapery.errors import DesignError, DraperyError, OutputError
from drapery.packs import open_packs
from drapery.settings import Settings
from drapery.studio.library import APPLICATION_ID, VERSION, Library, default_place
from drapery.studio.records import Design, checked_tags, tagged_designs
from drapery.studio.sketch import Sketch, Stroke, sketch_of

PICTURE = Settings(view="iso", wind=7.5, grid=(9, 17))


def design(text: str = "white creeper:lime", title: str = "Lime", *tags: str) -> Design:
    return Design(sketch_of(parse_banner(text), title), PICTURE, tags, plain(1, 2, 3, 255, side=16))


@pytest.fixture
def library(tmp_path: Path) -> Library:
    return Library(tmp_path / "a folder" / "library.sqlite")


def rename(library: Library, number: int, title: str) -> None:
    old = library.get(number)
    library.change(replace(old, sketch=replace(old.sketch, title=title)))


def found(library: Library, words: str = "", tag: str | None = None) -> list[str]:
    return [each.title for each in library.search(words, tag)[0]]


def test_a_saved_design_is_restored_completely(library: Library) -> None:
    kept = design("red creeper:lime acme:x/y:blue", "Żółw 🐢 ' \" %", "b", "a")
    first, second, *rest = kept.sketch.strokes
    strokes = (first, replace(second, hidden=True), *rest)
    kept = replace(kept, sketch=replace(kept.sketch, strokes=strokes))
    number = library.add(kept)
    got = library.get(number)
    assert (got.sketch, got.settings, got.tags) == (kept.sketch, PICTURE, ("b", "a"))
    assert got.thumbnail and Library(library.path).get(number) == got


def test_files_and_packs_are_not_saved(library: Library) -> None:
    own = PICTURE.changed(packs=("/a/pack.zip",), texture="/a/cape.png", backend="soft")
    number = library.add(replace(design(), settings=own))
    assert library.get(number).settings == PICTURE
    assert b"/a/" not in library.path.read_bytes()


def test_search_finds_by_title_tag_dye_and_pattern(library: Library) -> None:
    library.add(design("white creeper:lime", "Forest", "green", "my team"))
    library.add(design("red skull:black small_stripes:white", "Pirates 100%", "ship"))
    library.add(design("blue", "Sea", "ship", "water"))
    assert found(library) == ["Sea", "Pirates 100%", "Forest"]
    assert found(library, "SHIP") == ["Sea", "Pirates 100%"]
    assert found(library, "ship skull") == found(library, "small stripes") == ["Pirates 100%"]
    assert found(library, "creeper charge") == found(library, "team") == ["Forest"]
    assert found(library, "%") == ["Pirates 100%"] and found(library, "_") == []
    assert found(library, "' OR 1=1 --") == []
    assert found(library, tag="ship") == ["Sea", "Pirates 100%"] and found(library, tag="s") == []
    assert found(library, "red", "ship") == ["Pirates 100%"]
    assert library.tags() == {"green": 1, "my team": 1, "ship": 2, "water": 1}


def test_pages_of_a_search(library: Library) -> None:
    for number in range(7):
        library.add(design(title=f"n{number}"))
    page, count = library.search("n", first=2, limit=3)
    assert [each.title for each in page] == ["n4", "n3", "n2"] and count == 7


def test_rename_tag_change_and_order(library: Library) -> None:
    first, second = library.add(design(title="one")), library.add(design(title="two"))
    rename(library, first, " uno ")
    library.change(replace(library.get(first), tags=("B", "b ", "", "A  c")))
    assert found(library) == ["uno", "two"] and library.get(first).tags == ("b", "a c")
    library.change(replace(library.get(second), sketch=Sketch("black", title="zwei")))
    assert library.get(second).sketch.base == "black" and found(library, "lime") == ["uno"]
    assert found(library) == ["zwei", "uno"]


def test_what_is_removed_can_be_put_back(library: Library) -> None:
    number = library.add(design("white creeper:lime", "x", "t"))
    gone = library.remove(number)
    assert found(library) == [] and library.tags() == {}
    again = library.get(library.add(gone))
    assert replace(again, number=0, changed=0) == replace(gone, number=0, changed=0)


@pytest.mark.parametrize("number", [0, -1, 99, 1 << 70])
def test_a_number_that_is_not_there(library: Library, number: int) -> None:
    for act in (library.get, library.remove, lambda n: library.change(replace(design(), number=n))):
        with pytest.raises(DesignError, match="no longer in the library"):
            act(number)


@pytest.mark.parametrize(
    "change",
    [
        {"sketch": Sketch(title="a\nb")},
        {"sketch": Sketch(title="x" * 81)},
        {"sketch": Sketch("mauve")},
        {"sketch": Sketch("red", (Stroke("creeper", "red"),) * 17)},
        {"sketch": Sketch("red", (Stroke("../x", "red"),))},
        {"tags": ("a,b",)},
        {"tags": ("x" * 33,)},
        {"tags": tuple("abcdefghijklm")},
        {"thumbnail": b"<svg onload=alert(1)>"},
        {"thumbnail": plain(0, 0, 0, 255, side=257)},
    ],
)
def test_invalid_records_are_not_saved(library: Library, change: dict[str, Any]) -> None:
    with pytest.raises(DraperyError) as fault:
        library.add(replace(design(), **change))
    assert "\n" not in str(fault.value) and found(library) == []


def test_a_thumbnail_keeps_its_pixels_alone(library: Library) -> None:
    noise = np.random.default_rng(1).integers(0, 256, (20, 10, 4), np.uint8)
    from PIL.PngImagePlugin import PngInfo

    note = PngInfo()
    note.add_text("Comment", "secret")
    number = library.add(replace(design(), thumbnail=png(noise, pnginfo=note)))
    assert b"secret" not in library.get(number).thumbnail


def test_export_and_import(library: Library, tmp_path: Path) -> None:
    for number in range(5):
        library.add(design(f"red creeper:lime {'border:black ' * number}", f"n{number}", "t"))
    other = Library(tmp_path / "other.sqlite")
    other.add(design(title="mine"))
    assert other.load(library.dump()) == (5, 0)
    assert found(other) == ["n4", "n3", "n2", "n1", "n0", "mine"]
    assert other.load(library.dump()) == (0, 5)
    third = Library(tmp_path / "third.sqlite")
    third.load(library.dump())
    assert third.dump() == library.dump()


def broken(library: Library, **change: Any) -> bytes:
    whole = json.loads(library.dump())
    whole["designs"][1] |= change
    return json.dumps(whole).encode()


@pytest.mark.parametrize(
    "change",
    [
        {"base": "mauve"},
        {"layers": 7},
        {"options": {"packs": ["/etc"]}},
        {"options": {"texture": "/etc/passwd"}},
        {"title": ["x"]},
        {"tags": "x"},
        {"tags": [1]},
        {"thumbnail": "????"},
        {"thumbnail": "/etc/passwd"},
        {"thumbnail": 5},
    ],
)
def test_a_broken_import_changes_nothing(library: Library, change: dict[str, Any]) -> None:
    for title in ("a", "b"):
        library.add(design(title=title))
    before = library.dump()
    with pytest.raises(DesignError, match=r"^design 2: ") as fault:
        library.load(broken(library, **change))
    assert "\n" not in str(fault.value) and library.dump() == before


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\xff\xfe\x00",
        b"[" * 100_000,
        b"[]",
        b"{}",
        b'{"designs": []}',
        b'{"drapery_library": 2, "designs": []}',
        b'{"drapery_library": 1, "designs": {}}',
        b'{"drapery_library": 1, "designs": [5]}',
    ],
)
def test_a_file_that_is_not_a_library_is_one_line(library: Library, data: bytes) -> None:
    with pytest.raises(DesignError) as fault:
        library.load(data)
    assert "\n" not in str(fault.value)


def test_damaged_foreign_and_newer_files(tmp_path: Path) -> None:
    path = tmp_path / "x.sqlite"
    path.write_bytes(b"no database at all" * 100)
    with pytest.raises(OutputError, match="damaged or not a library"):
        Library(path)
    path.unlink()
    with closing(sqlite3.connect(path)) as other, other:
        other.execute("CREATE TABLE theirs (a)")
    with pytest.raises(OutputError, match="another program's"):
        Library(path)
    path.unlink()
    Library(path)
    with closing(sqlite3.connect(path)) as newer, newer:
        newer.execute(f"PRAGMA user_version = {VERSION + 1}")
    with pytest.raises(OutputError, match=rf"has version {VERSION + 1}"):
        Library(path)
    with closing(sqlite3.connect(path)) as made:
        assert made.execute("PRAGMA application_id").fetchone() == (APPLICATION_ID,)


def test_a_file_cut_short(library: Library) -> None:
    for _ in range(50):
        library.add(replace(design(), thumbnail=b""))
    whole = library.path.read_bytes()
    library.path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(OutputError) as fault:
        Library(library.path).dump()
    assert "\n" not in str(fault.value)


def test_a_library_whose_schema_is_no_text_is_damaged(library: Library) -> None:
    """SQLite quotes what it cannot read, and Python cannot decode that message."""
    library.add(design(title="a"))
    whole = library.path.read_bytes()
    library.path.write_bytes(whole.replace(b"\ttitle VARCHAR", b"\t'\x80tle VARCHAR"))
    with pytest.raises(OutputError, match="damaged or not a library"):
        Library(library.path).dump()


def test_a_spoilt_row_does_not_hide_the_others(library: Library) -> None:
    library.add(design(title="a"))
    spoilt = library.add(design(title="b"))
    with closing(sqlite3.connect(library.path)) as connection, connection:
        connection.execute("UPDATE designs SET tree = '[[[' WHERE number = ?", (spoilt,))
    assert found(library) == ["a"]
    with pytest.raises(DesignError, match="is damaged; delete it"):
        library.get(spoilt)


def test_where_nothing_can_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    (tmp_path / "folder.sqlite").mkdir()
    for path in (tmp_path / "file" / "x.sqlite", tmp_path / "folder.sqlite"):
        with pytest.raises(OutputError) as fault:
            Library(path)
        assert "\n" not in str(fault.value)


def test_a_locked_file(library: Library) -> None:
    library = Library(library.path, lock_timeout=0.05)
    with closing(sqlite3.connect(library.path, isolation_level=None)) as connection:
        connection.execute("BEGIN EXCLUSIVE")
        with pytest.raises(OutputError, match="another program uses it"):
            library.add(design())
        connection.execute("ROLLBACK")
        library.add(design())


WRITER = """
import sys
from contextlib import closing
from pathlib import Path
from drapery.banner.formats import parse_banner
from drapery.settings import Settings
from drapery.studio.records import Design
from drapery.studio.library import Library
from drapery.studio.sketch import sketch_of
library = Library(Path(sys.argv[1]))
for n in range(15):
    sketch = sketch_of(parse_banner("red"), f"{sys.argv[2]} {n}")
    number = library.add(Design(sketch, Settings()))
    library.change(Design(sketch, Settings(), (sys.argv[2],), number=number))
"""


def test_two_processes_write_at_once(library: Library) -> None:
    # The file is new to both, so they also race to make the tables.
    path = library.path.with_name("shared.sqlite")
    writers = [subprocess.Popen([sys.executable, "-c", WRITER, path, name]) for name in "ab"]
    assert [writer.wait(60) for writer in writers] == [0, 0]
    both = Library(path)
    assert both.tags() == {"a": 15, "b": 15}
    changes = [each.changed for each in both.search(limit=100)[0]]
    assert len(set(changes)) == 30


def test_a_search_text_of_a_million_characters(library: Library) -> None:
    library.add(design())
    assert found(library, "x " * 500_000) == []


@pytest.mark.skipif(sys.platform != "linux", reason="the place differs by system")
def test_the_default_place() -> None:
    home = {"HOME": "/home/a"}
    assert default_place(home) == Path("/home/a/.local/share/drapery/library.sqlite")
    assert default_place(home | {"XDG_DATA_HOME": "/d"}) == Path("/d/drapery/library.sqlite")
    assert default_place(home | {"XDG_DATA_HOME": "d"}) == default_place(home)


def test_tags_are_brought_to_one_spelling() -> None:
    assert checked_tags([" My  Team", "my team", "ß"]) == ("my team", "ß")


def test_all_banners_of_a_file_are_saved_once_with_their_place(library: Library) -> None:
    first, second = Banner("red"), Banner("blue", kind="shield")
    read = [FoundBanner(first, "a\tb 1"), FoundBanner(second, "2"), FoundBanner(first, "3")]
    designs = [*tagged_designs(read, "Hall, old.schem", Settings(), open_packs(()))]
    assert library.add_new(designs) == (2, 0)
    assert library.add_new(designs) == (0, 2)
    shield, banner = library.search(tag="hall old.schem")[0]
    assert (shield.title, shield.sketch.kind, banner.title) == ("2", "shield", "ab 1")
    assert banner.thumbnail
