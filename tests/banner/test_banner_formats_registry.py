"""The registry: files, standard input, several banners, and modules that stay unloaded."""

import io
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import Run

from drapery.banner.design import Banner
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.formats import (
    FORMS,
    FoundBanner,
    find_banners,
    parse_banner,
    parse_banners,
    read_designs,
    recognise,
    write_banner,
)
from drapery.banner.patterns import PATTERN_NAMES
from drapery.banner.plain import plain_design, read_design
from drapery.errors import DesignError

pytestmark = pytest.mark.usefixtures("untraced_processes")

RED, BLUE = Banner("red"), Banner("blue")
CHEST = (
    "/setblock ~ ~ ~ chest{Items:[{Slot:0b,id:'minecraft:red_banner',count:1},"
    "{Slot:1b,id:'minecraft:shield',count:1},{Slot:2b,id:'minecraft:bundle',components:"
    "{bundle_contents:[{id:'minecraft:blue_banner'}]}}]}"
)


def test_all_banners_of_a_text_are_found_each_with_its_place():
    assert parse_banners(CHEST) == [
        FoundBanner(RED, "Items[0]"),
        FoundBanner(BLUE, "Items[2].components.bundle_contents[0]"),
    ]


def test_one_of_several_is_chosen_by_number():
    assert parse_banner(CHEST, number=2) == BLUE
    with pytest.raises(DesignError, match=r"2 banners, from 'Items\[0\]' to .* by its number"):
        parse_banner(CHEST)
    with pytest.raises(DesignError, match="no banner number 3; use 1 to 2"):
        parse_banner(CHEST, number=3)
    assert parse_banner(CHEST.replace("blue", "red")) == RED


def test_a_function_file_is_read_line_by_line():
    text = (
        "# a comment: it's free\nsay banner's\ngive @s diamond\n"
        "/give @s red_banner\n\ngive @s blue_banner\n"
    )
    assert parse_banners(text) == [
        FoundBanner(RED, "line 4 red_banner"),
        FoundBanner(BLUE, "line 6 blue_banner"),
    ]


def test_a_broken_line_is_warned_of_with_its_number_and_passed_over():
    text = "give @s red_banner\ngive @s banner[\ngive @s red_banner[banner_patterns=[5]]\n"
    with pytest.warns(UserWarning) as caught:
        assert parse_banner(text) == RED
    places = [str(warning.message).split(":")[0] for warning in caught]
    assert places == ["line 2, column 16", "line 3"]


def test_only_broken_lines_are_an_error():
    with pytest.raises(DesignError, match="line 2, column 17"):
        parse_banners("give @s diamond\ngive @s banner [\ngive @s banner[\n")


def test_a_command_may_be_broken_over_lines():
    assert parse_banner("give @p red_banner[\n  banner_patterns = [\n  ]\n]") == RED


def test_a_file_is_read_if_there_is_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    file = Path("my banner.txt")
    file.write_text("white cross:red\n", "utf-8")
    assert read_design("my banner.txt") == read_design(file) == Banner.parse("white cross:red")
    file.write_text("white kross:red", "utf-8")
    with pytest.raises(DesignError, match=r"^my banner.txt: layer 1 'kross:red'"):
        read_design(file)


def test_a_text_is_not_a_file_even_if_a_folder_has_that_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    Path("red").mkdir()
    assert read_design("red") == RED


@pytest.mark.parametrize("name", ["gone.txt", "gone.png", "a/b.json", "C:\\banners\\mine.nbt"])
def test_a_file_that_is_not_there_is_called_so(name: str):
    with pytest.raises(DesignError, match="there is no such file"):
        read_design(name)
    with pytest.raises(DesignError, match=r"gone: No such file|gone: .*cannot find"):
        read_design(Path("gone"))


@pytest.mark.parametrize(
    ("data", "part"),
    [
        (b"\xff\xff\xff\x00", "neither text nor a known kind of file"),
        (b"", "empty"),
        (b"white " + b"x" * (5 << 20), "over 1048576"),
        (b"\x1f\x8b\x08", "broken.txt"),
    ],
)
def test_a_file_that_cannot_be_read_is_named(tmp_path: Path, data: bytes, part: str):
    file = tmp_path / "broken.txt"
    file.write_bytes(data)
    with pytest.raises(DesignError, match=r"broken\.txt") as caught:
        read_design(file)
    assert part in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_encodings_of_editors(tmp_path: Path, encoding: str):
    file = tmp_path / "banner.json"
    file.write_bytes('{"base": "red"}'.encode(encoding))
    assert read_design(file) == RED


def test_a_dash_is_standard_input(monkeypatch: pytest.MonkeyPatch):
    given = io.TextIOWrapper(io.BytesIO(b"give @s red_banner\r\n"), "utf-8")
    monkeypatch.setattr("sys.stdin", given)
    assert read_designs("-") == [FoundBanner(RED, "red_banner")]


def test_block_entities_get_their_dye_from_their_block():
    tree = {
        "block_entities": [{"id": "minecraft:banner", "x": 1, "patterns": []}, {"id": "banner"}]
    }
    found = find_banners(
        tree, "chunk", block_of=lambda entity: f"{'red' if 'x' in entity else 'blue'}_banner"
    )
    assert list(found) == [
        FoundBanner(RED, "chunk.block_entities[0]"),
        FoundBanner(BLUE, "chunk.block_entities[1]"),
    ]


def test_names_of_blocks_in_a_palette_are_not_banners():
    assert list(find_banners({"palette": [{"Name": "minecraft:red_banner"}]})) == []


def test_shorthand_and_json_load_no_grammar():
    code = (
        "import sys; from drapery.banner.formats import parse_banner;"
        "parse_banner('White cross:red'); parse_banner('{\"base\": \"red\"}');"
        "sys.exit(any(m in sys.modules for m in ('lark', 'nbtlib', 'numpy')))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize("module", ["drapery", "drapery.banner", "drapery.banner.design"])
def test_a_banner_parses_texts_whatever_is_imported_first(module: str):
    code = f"from {module} import Banner; print(Banner.parse('White cross:red').layers[0].dye)"
    run = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert run.stdout == "red\n"


def test_a_folder_does_not_hide_a_word(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    (tmp_path / "red").mkdir()
    monkeypatch.chdir(tmp_path)
    assert read_designs("red")[0].banner == RED


def test_a_plain_design_is_what_the_forms_read():
    """It is read without them, so no form may read it otherwise."""
    texts = [
        f"{dye} {p}:{dye} border:black" for p in PATTERN_NAMES for dye in ("red", "light_blue")
    ]
    for text in (*DYE_NAMES, *texts, " ".join(["white", *["border:lime"] * 16])):
        assert plain_design(text) == parse_banner(text), text
        assert recognise(text).name == "shorthand", text


@pytest.mark.parametrize(
    "text",
    [
        "",
        "white ",
        "white  border:lime",
        "White",
        "minecraft:white border:lime",
        "white cre:lime",
        "white border:lime:1",
        "white border",
        " ".join(["white", *["border:lime"] * 17]),
    ],
)
def test_any_other_text_is_left_to_the_forms(text: str):
    assert plain_design(text) is None


def test_a_plain_design_is_the_file_of_that_name_if_there_is_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    assert read_design("red") == RED
    (tmp_path / "red").write_text("blue")
    assert read_design("red") == BLUE
    assert (
        len(read_design(" ".join(["white", *["square_bottom_left:light_blue"] * 16])).layers) == 16
    )


@pytest.mark.parametrize("form", FORMS)
def test_a_text_without_a_design_is_refused_in_every_form(form: str, drapery: Run) -> None:
    code, out, err = drapery("show", "hello world", "--from", form)
    assert (code, out) == (2, "") and len(err.splitlines()) == 1


def test_the_former_name_of_shorthand_is_known(tmp_path: Path) -> None:
    assert write_banner(RED, "text") == write_banner(RED, "shorthand") == "red"
    file = tmp_path / "a.txt"
    file.write_text("red", "utf-8")
    assert read_designs(file, form="text") == parse_banners("red", form="text")
