"""Blazon: English heraldry to a design, and any design to words that read as the same design."""

import random
import shlex
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from cost import limited_cost

from drapery import Banner, Layer, draw_face
from drapery.banner import DYE_NAMES, PATTERN_NAMES, alt_text, recognise, write_banner
from drapery.banner.blazon import parse_blazon, write_blazon
from drapery.banner.blazon.plain_words import WORDS
from drapery.banner.blazon.terms import MAX_BLAZON
from drapery.errors import DesignError

BLAZONS = [
    line
    for line in (Path(__file__).parents[1] / "blazons.txt").read_text("utf-8").splitlines()
    if not line.startswith("#")
]


def fault(text: str) -> str:
    with pytest.raises(DesignError) as caught:
        parse_blazon(text)
    message = str(caught.value)
    assert len(message.splitlines()) == 1 and len(message) < 600
    return message


def random_banner(seed: int, most: int = 16) -> Banner:
    pick = random.Random(seed)
    count = pick.randint(0, most)
    layers = (Layer(pick.choice(PATTERN_NAMES), pick.choice(DYE_NAMES)) for _ in range(count))
    return Banner(pick.choice(DYE_NAMES), tuple(layers), pick.choice(["banner", "shield"]))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Azure, a bend Or", "blue stripe_downright:yellow"),
        ("AZURE A BEND OR.", "blue stripe_downright:yellow"),
        ("Tenné, a cross Bleu-céleste", "orange straight_cross:light_blue"),
        ("Per bend Sable and Or", "yellow diagonal_right:black"),
        ("Party per pale Argent and Vert", "green half_vertical:white"),
        ("Tierced per fess Or, Azure and Gules", "blue stripe_top:yellow stripe_bottom:red"),
        (
            "Quarterly Argent and Gules",
            "red half_vertical:white square_bottom_left:red square_bottom_right:white",
        ),
        ("Argent, a chief, a base and a bend Azure", "white ts:blue bs:blue drs:blue"),
        ("Gules, a pale between two pallets Or", "red ls:yellow rs:yellow cs:yellow"),
        ("Argent, on a bend Gules a roundel of the field", "white drs:red mc:white"),
        ("Or, a pale Gules, a chief of the second", "yellow cs:red ts:red"),
        ("Or, a chief Gules, a base of the same", "yellow ts:red bs:red"),
        ("Sable, a bezant charged with a creeper Vert", "black mc:yellow cre:green"),
        ("Azure, a saltire Or within a bordure indented Argent", "blue cr:yellow cbo:white"),
        ("Within a bordure Or", ""),
        ("Argent, in dexter chief a canton Gules and in base a bar Vert", "white tl:red bs:green"),
        ("Argent, a red cross", "white sc:red"),
        ("Gules masoned Argent, overall a flower Or", "red bri:white flo:yellow"),
        ("Per pale Argent and Sable, a chief counterchanged", "black vh:white tl:black tr:white"),
        ("Per fess Argent and Gules, a base counterchanged", "red hh:white bs:white"),
        ("On a shield Gules, a bend Argent", "shield red drs:white"),
    ],
)
def test_a_blazon_is_the_design_of_its_words(text: str, expected: str) -> None:
    if not expected:
        assert "'Within' is not expected at the beginning" in fault(text)
    else:
        assert parse_blazon(text) == Banner.parse(expected)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("Gules, a lion rampant Or", ["'lion rampant'", "use ordinaries (chief,"]),
        ("Azure, two bends Or", ["'two bends' (a banner has only one)"]),
        (
            "Azure, two bends wavy Or, in chief a skull Argent, an orle Vert",
            ["'wavy'", "'orle' (the nearest is bordure)", "'two bends'", "'in chief a skull'"],
        ),
        ("Or, a chevorn Gules", ["'chevorn' (did you mean 'chevron'?)"]),
        ("Or, on a chief Gules a skull Argent", ["'a skull' on 'a chief'", "at the centre"]),
        ("Per pale Or and Gules, a fess counterchanged", ["'a fess counterchanged'"]),
        ("Or, a fess counterchanged", ["'counterchanged' needs a field of two tinctures"]),
        ("Azure, a bend", ["'a bend' has no tincture", "'a bend Or'"]),
        ("Azure, a bend of the third", ["'of the third'", "name the tincture"]),
        ("Per pale Or and Gules, a fess of the field", ["'of the field'", "two tinctures"]),
        ("a bend Or", ["'a' is not expected at the beginning", "'Azure, a bend Or'"]),
        ("Azure, a bend Or Gules", ["'Gules' is not expected after 'Or'"]),
        ("Azure, on a bend Or", ["the blazon ends too early after 'Or'"]),
        ("Per pale Azure", ["'Per pale' has 1 tincture; write 2"]),
        ("hello world", ["'hello world': not a blazon", "'Azure, a bend Or'"]),
        ("привет мир", ["not a blazon"]),
        ("蓝色", ["not a blazon"]),
        (" \n", ["the blazon is empty"]),
        ("Azure" + ", a bend Or" * 17, ["the banner has 17 layers"]),
    ],
)
def test_what_cannot_be_shown_is_named(text: str, parts: list[str]) -> None:
    message = fault(text)
    assert [part for part in parts if part not in message] == [], message


def test_a_blazon_has_a_largest_length() -> None:
    longest = "Azure" + ", plain" * ((MAX_BLAZON - 5) // 7)
    assert parse_blazon(longest) == Banner("blue")
    for text in ("Azure, a bend Or " * 60_000, "x" * 1_000_000):
        assert f"over {MAX_BLAZON}" in fault(text)
    with pytest.raises(DesignError, match=f"over {MAX_BLAZON}"):
        Banner.parse("Azure, a bend Or " * 60_000)


@pytest.mark.parametrize("pattern", PATTERN_NAMES)
def test_the_words_of_one_layer_read_as_the_same_banner(pattern: str) -> None:
    for number, dye in enumerate(DYE_NAMES):
        for kind in ("banner", "shield"):
            banner = Banner(DYE_NAMES[number * 7 % 16], (Layer(pattern, dye),), kind)
            assert parse_blazon(write_blazon(banner)) == banner


@pytest.mark.parametrize("seed", range(0, 300, 60))
def test_the_words_of_any_banner_read_as_the_same_banner(seed: int) -> None:
    for number in range(seed, seed + 60):
        banner = random_banner(number)
        assert parse_blazon(write_blazon(banner)) == banner


@pytest.mark.parametrize("pattern", ["acme:5", "acme:a/b.c", "a.b-c:bend", "acme:x_y-0"])
@pytest.mark.parametrize("count", [1, 2, 3])
def test_patterns_of_data_packs_are_read_back(pattern: str, count: int) -> None:
    layers = (Layer(pattern, "white"), Layer("base", "white"), Layer(pattern, "red"))
    banner = Banner("white", layers[:count])
    assert Banner.parse(write_blazon(banner)) == banner


def test_every_dye_alone_is_read_back_by_the_parser_of_all_forms() -> None:
    for base in DYE_NAMES:
        for dye in ("lime", "gray", "blue"):
            banner = Banner(base, (Layer("straight_cross", dye), Layer("stripe_bottom", base)))
            assert Banner.parse(write_blazon(banner)) == banner


def test_at_least_95_percent_of_the_blazons_are_read() -> None:
    unread = []
    for line in BLAZONS:
        try:
            banner = parse_blazon(line)
        except DesignError as error:
            assert "a banner cannot show" in str(error)
            unread.append(line)
        else:
            assert parse_blazon(write_blazon(banner)) == banner
    assert len(BLAZONS) >= 300
    assert len(unread) <= 0.05 * len(BLAZONS), unread


@pytest.mark.parametrize("text", BLAZONS[:-9:9])
def test_banner_parse_takes_a_blazon(text: str) -> None:
    assert recognise(text).name in ("blazon", "shorthand")
    assert Banner.parse(text) == parse_blazon(text)


@pytest.mark.parametrize(
    "text",
    [
        "red banner with white skull",
        "White Banner, Lime Creeper Charge",
        "white, a cross red",
        "black banner with white Per Bend Sinister",
        "vert creeper:blanc",
        "orange, a base white",
        "lime",
    ],
)
def test_typed_texts_keep_their_form(text: str) -> None:
    assert recognise(text).name == "shorthand"


def test_one_blazon_on_each_line() -> None:
    from drapery import parse_banners

    found = parse_banners("Azure, a bend Or\nGules, a chief Argent\nred creeper:lime\n")
    assert [write_banner(one.banner, "shorthand") for one in found] == [
        "blue stripe_downright:yellow",
        "red stripe_top:white",
        "red creeper:lime",
    ]


def test_the_command_reads_blazon_and_show_writes_it(drapery: Run, tmp_path: Path) -> None:
    picture = tmp_path / "face.png"
    code, out, err = drapery("blazon", "Azure, a bend Or", "-o", picture)
    assert (code, out, err) == (0, "blue stripe_downright:yellow\n", "")
    assert picture.stat().st_size > 100
    code, out, _ = drapery("show", "blue stripe_downright:yellow", "--as", "blazon")
    assert (code, out) == (0, "Azure, a bend Or\n")
    code, out, err = drapery("blazon", "Gules, a lion Or")
    assert (code, out, len(err.splitlines())) == (2, "", 1) and "'lion'" in err


def test_the_page_on_blazon_tells_what_happens(drapery: Run) -> None:
    page = (Path(__file__).parents[2] / "docs" / "guides" / "blazon.md").read_text("utf-8")
    blocks = page.split("```")[1::2]
    for block in blocks:
        if block.startswith("python"):
            exec(compile(block.removeprefix("python"), "blazon.md", "exec"), {})
            continue
        for part in block.split("$ drapery ")[1:]:
            command, _, expected = part.partition("\n")
            _, out, err = drapery(*shlex.split(command))
            assert out + err == expected


@pytest.mark.parametrize("join", [" ", ", a "])
def test_hundreds_of_unknown_words_are_refused_soon(join: str) -> None:
    """They are named although the charges have no tincture; few of them are compared."""
    words = [f"chevr{chr(97 + n // 26)}{chr(97 + n % 26)}" for n in range(330)]
    with limited_cost():
        assert "a banner cannot show" in fault("Azure, a " + join.join(words))


def test_pictures_on_pages_have_the_words_of_their_banner() -> None:
    assert alt_text(Banner.parse("blue stripe_downright:yellow")) == "Banner: Azure, a bend Or"
    assert alt_text(Banner.parse("shield red")) == "On a shield Gules"
    assert alt_text(Banner.parse("light_gray cross:light_gray")).startswith("Banner: ")


@pytest.mark.parametrize(
    ("design", "words"),
    [
        ("red straight_cross:white", "A red banner with a white cross"),
        ("orange", "An orange banner"),
        ("shield light_blue bricks:orange", "A light blue shield with orange bricks"),
        (
            "white stripe_top:red creeper:lime border:black",
            "A white banner with a red stripe along the top, a lime creeper and a black border",
        ),
    ],
)
def test_a_text_in_plain_english_says_what_is_seen(design: str, words: str) -> None:
    assert alt_text(Banner.parse(design), plain=True) == words


def test_plain_words_know_every_pattern_and_its_place() -> None:
    assert WORDS.keys() == set(PATTERN_NAMES)
    white = draw_face(Banner("white"), scale=1).pixels.astype(int)
    for pattern, words in WORDS.items():
        face = draw_face(Banner("white", (Layer(pattern, "black"),)), scale=1).pixels.astype(int)
        dark = np.abs(face - white).sum(axis=-1)
        across = (dark.sum(axis=0) * np.linspace(0, 1, dark.shape[1])).sum() / dark.sum()
        down = (dark.sum(axis=1) * np.linspace(0, 1, dark.shape[0])).sum() / dark.sum()
        sides = {"left": across < 0.4, "right": across > 0.6}
        sides |= {"upper": down < 0.4, "lower": down > 0.6, "top": down < 0.4, "bottom": down > 0.6}
        if "slanting" in words:
            continue  # whose words say where it begins
        for word, holds in sides.items():
            assert (word in words.replace("upright", "").split()) <= holds, (pattern, word)
