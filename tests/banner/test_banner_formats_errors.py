"""Texts that are not banners: one line with the place and the remedy, in every form."""

from contextlib import suppress
from itertools import accumulate, islice, product

import fuzzing
import pytest
from cost import limited_cost
from hypothesis import given, strategies as st
from tracing import untraced

from drapery.banner.dyes import DYES
from drapery.banner.formats import (
    FORMS,
    functions,
    parse_banner,
    parse_banners,
    registry,
    several,
    write_banner,
)
from drapery.banner.formats.snbt import MAX_TEXT
from drapery.banner.patterns import PATTERNS
from drapery.errors import DesignError


def fault(text: str, form: str | None = None) -> str:
    with pytest.raises(DesignError) as caught:
        parse_banner(text, form=form)
    message = str(caught.value)
    assert len(message.splitlines()) == 1 and len(message) < 400
    message.encode("utf-8")
    return message


def patterns(inner: str) -> str:
    return f"/give @p white_banner[banner_patterns=[{inner}]]"


GOOD = '{pattern:"creeper",color:"lime"}'


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (
            patterns(f'{GOOD},{{pattern:"kreeper",color:"lime"}}'),
            ["banner_patterns[1].pattern", "'kreeper'", "did you mean 'creeper'"],
        ),
        (
            patterns(f'{GOOD},{GOOD},{{pattern:"cross",color:"lme"}}'),
            ["banner_patterns[2].color", "'lme'", "did you mean 'lime'"],
        ),
        (patterns('{pattern:"cross"}'), ["banner_patterns[0]", "no color"]),
        (patterns('{color:"lime"}'), ["banner_patterns[0]", "no pattern"]),
        (patterns('"creeper"'), ["banner_patterns[0]", "'creeper' is not a layer"]),
        (patterns('{pattern:{translation_key:"x"},color:"red"}'), ["[0].pattern", "asset_id"]),
        (patterns('{pattern:"ACME:x",color:"red"}'), ["'ACME:x'", "namespace:path"]),
        (patterns('{pattern:"a:../../x",color:"red"}'), ["'a:../../x'", "namespace:path"]),
        (patterns(",".join([GOOD] * 17)), ["banner_patterns", "17 layers", "at most 16"]),
        ("white_banner[banner_patterns=5]", ["banner_patterns", "5 is not a list of layers"]),
        (
            "/give @p banner 1 15 {BlockEntityTag:{Base:16}}",
            ["BlockEntityTag.Base", "16", "0 to 15"],
        ),
        (
            "/give @p banner 1 15 {BlockEntityTag:{Patterns:[{Pattern:cre,Color:-1}]}}",
            ["BlockEntityTag.Patterns[0].Color", "-1", "0 to 15"],
        ),
        ("/give @p banner 1 15 {BlockEntityTag:5}", ["BlockEntityTag", "5", "compound"]),
        ("/give @p white_banner creeper:lime", ["column 23", "'creeper:lime'"]),
        (
            "/give @p white_bannr[banner_patterns=[]]",
            ["'white_bannr'", "did you mean 'white_banner'"],
        ),
        ("/give @p diamond", ["no banner", "minecraft:white_banner[banner_patterns=[…]]"]),
        (
            f"[banner_patterns=[{GOOD}]]",
            ["no banner", "minecraft:white_banner[banner_patterns=[…]]"],
        ),
        (f"{{patterns:[{GOOD}]}}", ["base dye", "minecraft:red_banner{…}"]),
        (f'{{"minecraft:banner_patterns":[{GOOD}]}}', ["base dye", "minecraft:red_banner[…]"]),
        ("{BlockEntityTag:{Patterns:[]}}", ["base dye", "minecraft:red_banner{…}"]),
        ('{id:"minecraft:stone"}', ["no banner", "minecraft:red_banner"]),
        ("/give @p shield[damage=3]", ["plain shield", "base_color"]),
        ('{"layers":[]}', ['no "base"']),
        (
            '{"base":"red","layers":[{"pattern":"cross","color":"red"},5]}',
            ["layers[1]", "5 is not a layer"],
        ),
        ('{"base":"red","kind":"cape"}', ["kind", "'cape'"]),
        (
            '{"base":"WHITE","tier":1,"layers":[{"colour":"RED","pattern":"CIRCEL"}]}',
            ["layers[0].pattern", "'CIRCEL'", "did you mean 'circle'"],
        ),
        ("white creeper", ["layer 1 'creeper'", "pattern:dye"]),
        ("white cross:red kreeper:lime", ["layer 2 'kreeper:lime'", "did you mean 'creeper'"]),
        ("white" + " cross:red" * 17, ["17 layers", "at most 16"]),
        ("creeper:lime", ["base dye comes first"]),
        ("whit", ["did you mean 'white'"]),
        ("shield", ["no base dye"]),
        (
            '{"item": "{\\"id\\":\\"red_banner\\",\\"components\\":{\\"banner_patterns\\":'
            '[{\\"pattern\\":\\"creeper\\",\\"color\\":\\"lime\\"}]}}"}',
            ["'item'", "packed as a text", "give what is in the quotes"],
        ),
        ("- CREEPER:LIME\n- BORDER:BLACK\n", ["without a base dye", "a line before them"]),
        ("", ["empty"]),
        (" \n\t", ["empty"]),
        ("/tell @a hello", ["not a known form of a banner", "/give"]),
        ("https://example.com/banner?b=1", ["not the address of a known banner editor", "/give"]),
        ("banners/mine.json", ["no such file"]),
    ],
)
def test_a_fault_is_named_with_its_place_and_remedy(text: str, parts: list[str]):
    from drapery.banner.plain import read_design

    with pytest.raises(DesignError) as caught:
        read_design(text)
    message = str(caught.value)
    assert [part for part in parts if part not in message] == [], message
    assert len(message.splitlines()) == 1


@pytest.mark.parametrize(
    ("text", "place", "expected"),
    [
        (patterns('{pattern:"creeper" color:"lime"}'), "line 1, column 59", "',' or '}'"),
        (
            patterns("{pattern:creeper,color:lime}")[:-1],
            "column 69: the text ends too early",
            "']'",
        ),
        ('{\n  "base": "red",\n  "layers": [}\n}', "line 3, column 14: unexpected '}'", "']'"),
        (
            '/give @p white_banner[item_name="x]',
            "line 1, column 33: a quote that is not closed",
            "close it",
        ),
        ("/give @p white_banner[banner_patterns=[[X;1]]]", "line 1, column 41", "use B, I or L"),
        ("{a:foo(1)}", "line 1, column 4", "bool(1)"),
        ('{a:"\\U99999999"}', "line 1, column 4", "is not a character"),
        ("{a:uuid('x')}", "line 1, column 4", "is not a UUID"),
        ("{}}", "line 1, column 3: unexpected '}'", "the end"),
    ],
)
def test_bad_syntax_is_shown_by_line_and_column(text: str, place: str, expected: str):
    message = fault(text)
    assert place in message and expected in message.partition(place)[2], message


def test_lines_of_a_long_text_are_counted():
    assert fault("{a:1,\n\n b:[1,\n2,,]}").startswith("line 4, column 3: unexpected ','")


@pytest.mark.parametrize(
    "text",
    [
        "[" * 100_000,
        "{a:" * 100_000,
        '{"a":' * 100_000,
        "[" * 100_000 + "]" * 100_000,
        '{"a":[' * 900 + "]}" * 900,
        "/give @p white_banner[a=" + "{b:[" * 50_000,
        "red_banner[a=" + "[" * 50_000,
    ],
)
def test_depth_is_refused_before_it_hurts(text: str):
    message = fault(text)
    assert "nested over 512 deep" in message


def test_depth_within_the_limit_is_read():
    item = '{"id":"minecraft:red_banner"}'
    for key in ("a", '"a"'):
        deep = f"{{{key}:" * 500 + item + "}" * 500
        assert parse_banner(deep).base == "red"


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("[" + "1," * 200_000 + "]", "over 120000 words"),
        ("white " + "x" * (1 << 20), "over 1048576"),
        ("give @s red_banner\n" * 20_001, "over 20000"),
        ("give @s " + "a " * 119_000, "no banner"),
        ("give @s " + "{banner} " * 100_000, "over 100 words"),
        ("give @s a{" + "pattern:" * 120_000, "no banner"),
        ("execute " * 120_000 + "run give", "no banner"),
        ("execute @a " * 90_000 + "banner", "no banner"),
        ("{" + " " * (1 << 20) + "}", "over 1048576"),
        ('{a:"' + '\\"' * 400_000, "is not closed"),
        ('"' * 500_000, "not a known form of a banner"),
        ("white " + "a:b " * 200_000, "200000 layers"),
        ("white " + "x" * 900_000, "has no dye"),
        ("white " + "x" * 900_000 + ":red", "unknown pattern"),
        ('{"base":' + "1" * 100_000 + "}", "unknown dye"),
        ("/give @p " + "1" * 900_000, "no banner"),
        (" " * 1_000_000 + "x", "unknown dye"),
        (":" * 1_000_000, "base dye"),
    ],
)
def test_length_is_refused_before_it_hurts(text: str, part: str):
    with untraced():
        assert part in fault(text)


@pytest.mark.parametrize("name", fuzzing.LONG_TEXTS)
def test_long_texts_of_commands_are_read_or_refused_soon(name: str):
    line = fuzzing.LONG_TEXTS[name]
    with limited_cost(5), untraced(), suppress(DesignError):
        parse_banners(line * (MAX_TEXT // len(line)))


LINES = {
    "commands": "give @s {base}_banner[banner_patterns=[{{pattern:{pattern},color:{dye}}}]]",
    "items": "{base}_banner[banner_patterns=[{{pattern:{pattern},color:{dye}}}]]",
}


@pytest.mark.parametrize("form", LINES)
@pytest.mark.parametrize("before", ["", "red creeper:lime\n"], ids=["alone", "mixed"])
def test_different_lines_are_read_up_to_a_length(form: str, before: str):
    combinations = product(DYES, PATTERNS, DYES)
    lines = [
        LINES[form].format(base=base, pattern=pattern, dye=dye)
        for base, pattern, dye in islice(combinations, 8000)
    ]
    sizes = accumulate(map(len, lines), initial=len(before.strip()))
    read = sum(size <= several.MAX_READ for size in sizes) - 1
    assert 1000 < read < len(lines) - 1000
    text = before + "\n".join([*lines, lines[0]])
    with limited_cost(20), untraced(), pytest.warns(UserWarning) as caught:
        found = parse_banners(text)
    assert len(found) == read + 1 + bool(before), "equal lines cost nothing"
    first = read + 1 + bool(before)
    assert [str(each.message) for each in caught] == [
        f"line {first} and on: {len(lines) - read} designs left out, because different lines"
        f" have over {several.MAX_READ} characters: split the text"
    ]


def test_texts_of_broken_commands_are_refused():
    broken = "give @s red_banner[\n"
    with pytest.warns(UserWarning) as caught:
        assert len(parse_banners("give @s red_banner\n" + broken * functions.MAX_BROKEN)) == 1
    assert str(caught[-1].message) == "and 995 more like these"
    message = fault("give @s red_banner\n" + broken * (functions.MAX_BROKEN + 1))
    assert message.startswith("line 2, column 20: the text ends too early")
    assert message.endswith("; 1000 more commands cannot be read: correct them")


def test_a_text_has_a_largest_number_of_lines():
    assert parse_banner("red" + "\n" * registry.MAX_LINES).base == "red"
    assert "over 120000: split it" in fault("red" + "\n" * (registry.MAX_LINES + 1))


@given(st.text(max_size=60))
def test_any_text_at_all_is_a_banner_or_one_line(text: str):
    for form in (None, "give", "item", "text"):
        try:
            parse_banner(text, form=form)
        except DesignError as error:
            assert len(str(error).splitlines()) == 1


def test_forms_are_named_in_the_error_of_an_unknown_one():
    with pytest.raises(DesignError, match="did you mean 'give-legacy'"):
        write_banner(parse_banner("red"), "give_legacy")
    with pytest.raises(DesignError, match=", ".join(FORMS)):
        parse_banner("red", form="?")


@pytest.mark.parametrize(
    ("form", "design", "parts"),
    [
        ("give-legacy", "white flow:red", ["layer 1", "1.20.4", "'flow'"]),
        ("give-legacy", "white cross:red acme:x:red", ["layer 2", "'acme:x'"]),
        ("give-1.12", "white globe:red", ["layer 1", "1.12", "'globe'"]),
        ("give-1.12", "shield white", ["shields"]),
        ("setblock", "shield white", ["shield", "'give'"]),
        ("bedrock", "white acme:x:red", ["layer 1", "'acme:x'"]),
        ("wynncraft", "white acme:x:red", ["layer 1", "'acme:x'"]),
        ("planet-minecraft", "shield white", ["shields", "'give'"]),
    ],
)
def test_a_form_says_what_it_cannot_hold(form: str, design: str, parts: list[str]):
    with pytest.raises(DesignError) as caught:
        write_banner(parse_banner(design), form)
    assert [part for part in parts if part not in str(caught.value)] == []
