"""Designs as people type them: English words, other languages' names, lists of lines."""

from pathlib import Path

import pytest
from conftest import Run

from drapery.banner import game_titles
from drapery.banner.design import Banner
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.formats import parse_banner, parse_banners
from drapery.banner.formats.languages import Language, known_languages, possible_languages
from drapery.banner.patterns import PATTERN_NAMES
from drapery.banner.plain import read_design
from drapery.errors import DesignError

RED_CREEPER = Banner.parse("red creeper:white border:black")


def fault(text: str) -> str:
    with pytest.raises(DesignError) as caught:
        parse_banner(text)
    message = str(caught.value)
    assert len(message.splitlines()) == 1 and len(message) < 500
    return message


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("red banner with white skull", "red skull:white"),
        ("A red banner with a white skull and a black border.", "red skull:white border:black"),
        ("white creeper lime border black", "white creeper:lime border:black"),
        ("red shield with white skull", "shield red skull:white"),
        ("light blue banner with gray top stripe", "light_blue stripe_top:gray"),
        ("white skull on a red banner", "red skull:white"),
        ("white skull on red field", "red skull:white"),
        ("white skull on red", "red skull:white"),
        ("shield red with white skull", "shield red skull:white"),
        ("shield with white skull on red", "shield red skull:white"),
        ("creeper lime on a white banner", "white creeper:lime"),
        ("light gray banner with a dark green border", "light_gray border:green"),
        ("black banner with white Per Bend Sinister", "black diagonal_left:white"),
        ("white cre:5", "white creeper:lime"),
        ("white cre:0 border:15", "white creeper:white border:black"),
    ],
)
def test_english_words_are_read(text: str, expected: str):
    assert parse_banner(text) == parse_banner(expected)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("red banner with skull", ["'skull' has no dye", "red banner with white skull"]),
        ("red banner with white kreeper", ["'kreeper'", "did you mean 'creeper'"]),
        ("Lime Creeper Charge\nBlack Bordure", ["the base is missing", "White Banner"]),
        ("Lime Creeper Charge", ["the base", "red banner with white skull"]),
        ("White Banner\nLime Creper Charge", ["layer 1", "did you mean 'creeper_charge'"]),
        ("white creeper:16", ["layer 1", "16", "0 to 15"]),
        ("Weißer Creeper", ["the base is missing", "de_de"]),
        ("Rotes Banner\nWeißer Kreeper", ["layer 1 'weißer kreeper'", "de_de", "pattern:dye"]),
        ("пёс", ["'пёс'", "known languages are", "ru_ru"]),
    ],
)
def test_a_refusal_speaks_of_what_the_text_resembles(text: str, parts: list[str]):
    message = fault(text)
    assert [part for part in parts if part not in message] == [], message


@pytest.mark.parametrize(
    "text",
    [
        "Rotes Banner\nWeißer Creeper\nSchwarzer Bord",
        "rotes banner, weißer creeper, schwarzer bord",
        "rot creeper:weiß bord:schwarz",
        "rot creeper:weiß border:schwarz",
        "rouge creeper:blanc bo:noir",
        "czerwony creeper:biały border:czarny",
        "Bannière rouge\nFace de Creeper d'argent\nBordure de sable",
        "Estandarte rojo\nEstampado blanco de creeper\nBordura negra",
        "Estandarte vermelho\nFigura de Creeper Branco\nBordadura Preta",
        "红色旗帜\n白色苦力怕盾徽\n黑色方框边",
        "赤色の旗、白色のクリーパー模様、黒色の縁取り",
        "Красный флаг\nБелый крипер\nЧёрная кайма",
        "Czerwony sztandar\nBiały wizerunek creepera\nCzarne obramowanie",
        "Червоний стяг\nБіла емблема кріпера\nЧорна рамка",
    ],
)
def test_a_tooltip_in_another_language_is_read(text: str):
    assert parse_banner(text) == RED_CREEPER


@pytest.mark.parametrize("language", known_languages(), ids=lambda language: language.name)
def test_every_phrase_of_a_language_is_read_after_its_base(language):
    assert {layer.pattern for layer in language.phrases.values()} == set(PATTERN_NAMES)
    assert set(language.dyes.values()) == set(DYE_NAMES)
    base = next(name for name, dye in language.dyes.items() if dye == "red")
    for phrase, layer in list(language.phrases.items())[::7]:
        assert parse_banner(f"{base}\n{phrase}") == Banner("red", (layer,)), phrase


def test_one_design_on_each_line():
    text = (
        "# ours\nwhite creeper:lime\n\n- black\n2. https://www.planetminecraft.com/banner/?b=b1f\n"
    )
    found = parse_banners(text)
    assert [one.where for one in found] == ["line 2", "line 4", "line 5"]
    assert [one.banner.base for one in found] == ["white", "black", "lime"]


def test_a_broken_line_of_a_list_is_named():
    with pytest.warns(UserWarning, match=r"line 2 'whit': base: unknown dye 'whit'"):
        found = parse_banners("red\nwhit\nblue creeper:lime")
    assert [one.banner.base for one in found] == ["red", "blue"]


def test_a_tooltip_is_one_banner_not_a_list():
    assert len(parse_banners("White Banner\nLime Creeper Charge\nBlack Bordure")) == 1
    assert len(parse_banners("white\ncreeper:lime\nborder:black")) == 1


def test_many_banners_name_the_ways_to_choose_one(drapery: Run, tmp_path: Path):
    (tmp_path / "a.txt").write_text("red\n", "utf-8")
    (tmp_path / "b.yml").write_text("material: BLUE_BANNER\nbanner_meta: [LIME;CROSS]\n", "utf-8")
    code, _, err = drapery("render", str(tmp_path), "-o", str(tmp_path / "x.png"))
    assert code == 2 and "--number 1 to 2" in err and "drapery show --list" in err
    code, out, _ = drapery("show", "--list", str(tmp_path))
    assert (code, out) == (0, "1\ta.txt\tred\n2\tb.yml\tblue cross:lime\n")


@pytest.mark.parametrize(
    ("source", "part"),
    [
        ("designs", "unknown dye 'designs'; the sixteen are"),
        ("designs", "no file or folder has that name"),
        ("designs/", "designs/: there is no such file or folder"),
        ("mine/designs", "mine/designs: there is no such file or folder"),
    ],
)
def test_a_folder_that_is_not_there_is_called_so(source: str, part: str):
    with pytest.raises(DesignError) as caught:
        read_design(source)
    assert part in str(caught.value)


def test_a_folder_is_read_by_its_bare_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    Path("designs").mkdir()
    Path("designs/one.txt").write_text("red creeper:white border:black\n", "utf-8")
    assert read_design("designs") == read_design("designs/") == RED_CREEPER


def test_nothing_is_read_from_an_empty_text():
    for text in ("", " "):
        with pytest.raises(DesignError, match="the text is empty"):
            read_design(text)


@pytest.mark.parametrize("language", known_languages(), ids=lambda language: language.name)
def test_the_first_words_of_a_text_tell_its_languages(language: Language):
    """A line in no language was tried in all sixteen, which made long lists slow."""
    starts = [*language.dyes, *language.phrases, f"{language.banner} x", f"x{language.shield}"]
    assert all(language in possible_languages(start) for start in starts)
    for start in (start for start in starts if "," not in start):
        for text in (start, f" {start}, x:y", f"\n{start}:x", f",\n{start}\nx"):
            assert language in possible_languages(text), text


@pytest.mark.parametrize("text", ["", ",;", "some player", "xyzzy:lime", "this is a sentence"])
def test_a_text_of_no_language_is_tried_in_none(text: str):
    assert possible_languages(text) == []


@pytest.mark.parametrize(
    "line",
    [
        "RED_BANNER:1:CREEPER:LIME",
        "red_banner[patterns=LIME/CREEPER]",
        "red_banner 1 cre,8439583",
        "/give @p red_banner[banner_patterns=[{pattern:creeper,color:lime}]]",
        "Item.of('red_banner[banner_patterns=[{pattern:creeper,color:lime}]]')",
    ],
)
def test_no_line_of_a_mixed_list_is_lost(line: str):
    """Found by hand: the form of one line recognised the whole text and passed over the others."""
    text = f"# ours\nred creeper:white\n- white banner with red skull\n{line}\n{line}\nnonsense\n"
    with pytest.warns(UserWarning, match="line 6 'nonsense'"):
        found = parse_banners(text)
    assert [one.where.partition(" ")[2][:1] for one in found] == ["2", "3", "4", "5"]
    assert found[2].banner == found[3].banner == Banner.parse("red creeper:lime")


def test_titles_of_patterns_have_the_capitals_of_their_language() -> None:
    titles = game_titles("de_de")[1]
    wanted = {"square_top_left": "Rechtes Obereck", "small_stripes": "Vier Pfähle"}
    wanted |= {"mojang": "Mojang-Logo", "half_vertical": "Rechts gespalten"}
    assert {name: titles[name] for name in wanted} == wanted
