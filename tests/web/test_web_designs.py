"""Pages read designs as Python does: the same texts give the same banners, or both refuse them."""

from collections.abc import Iterator

import fuzz_targets
import fuzzing
import pytest
from page_reader import COMPONENT, NODE, Answer, plain, read_in_page, some_banners

from drapery import Banner, DesignError
from drapery.banner import FORMS, write_banner
from drapery.banner.tables import MAX_TEXT
from drapery.web import tables

TYPED = (
    "red",
    "Red Banner",
    "minecraft:red_banner",
    "red_wall_banner",
    "silver creeper:silver",
    "light blue creeper:light gray border:dark_grey",
    "white cre:5 bo:15 flw:0 gus:3",
    "White Banner\nLime Creeper Charge\nBlack Bordure Indented",
    "White Banner; Light Blue Bend Sinister; Silver Per Bend",
    "black DIAGONAL_RIGHT:red diagonal_right:white stripe_small:blue",
    "shield white creeper:lime",
    "Shield\tRed  minecraft:skull : black",
    "ominous banner",
    "pink acme:anvil/two:red",
    "white Per Fess Inverted:blue Base:red",
    '{"base": 0, "layers": []}',
    '{"banner_color": 0}',
)
WRITTEN = (
    "give @s white_banner",
    "/minecraft:give Steve minecraft:light_blue_banner 3",
    '/give @p white_banner[minecraft:banner_patterns=[{pattern:"minecraft:creeper",color:"lime"}],'
    '!damage,custom_name="a\\"]"] 1',
    "/give @p white_banner[banner_patterns=[{pattern:{asset_id:acme:anvil,translation_key:'x'},"
    'color:red,},],rarity="epic"]',
    "white_banner{BlockEntityTag:{Patterns:[0:{Pattern:cre,Color:5b},1:{Pattern:'bo',Color:15}]}}",
    "/setblock ~ ~ ~ red_banner[rotation=4]{Patterns:[{Pattern:mc,Color:0}]} destroy",
    "/give @p shield[base_color=lime,banner_patterns=[{pattern:skull,color:black}]]",
    "/give @p shield{BlockEntityTag:{Base:5,Patterns:[{Pattern:cre,Color:0}]}}",
    "/give @p shield 1 0 {BlockEntityTag:{Base:5,Patterns:[{Pattern:cre,Color:0}]}}",
    "/give @p banner 1 4",
    "/give @p minecraft:banner 1 15 {BlockEntityTag:{Base:1,Patterns:[]}}",
    '{"id":"minecraft:red_banner","Count":1b,"tag":{"BlockEntityTag":{"Patterns":[]}}}',
    '{id:"minecraft:banner",Damage:4s,tag:{BlockEntityTag:{Patterns:[{Pattern:ss,Color:15}]}}}',
    '{"base": 14, "layers": [{"pattern": "Per Pale", "color": "Lime"}], "kind": "shield"}',
    "http://planetminecraft.com/banner/?e=2c729cmcf28",
    "ncrs.skin/banner/?banner=ealleNhEehppai&x=1",
    "https://skinmc.net/banner?=ea",
    "https://minecraft.tools/en/shield.php?shape_id_2=1&color_id_2=3&color_id_0=4&shape_id_1=0",
    "www.gamergeeks.nz/apps/minecraft/banner-maker#mcb=a0",
)
REFUSED = (
    "",
    "   ",
    "plaid",
    "white creeper:plaid",
    "white dragon:lime",
    "creeper:lime",
    "white creeper",
    "white creeper:16",
    "shield",
    "white constructor:red",
    "constructor",
    "white " + "creeper:lime " * 17,
    "/give @p minecraft:stick",
    "/give @p white_banner sideways",
    "/give @p white_banner[banner_patterns=[{pattern:creeper}]]",
    "/give @p white_banner[banner_patterns=[{pattern:creeper,color:lime}",
    "/give @p white_banner[banner_patterns={pattern:creeper,color:lime}]",
    '/give @p white_banner[banner_patterns=[{pattern:"creeper,color:lime}]]',
    "/give @p shield",
    "/give @p minecraft:banner 1 16",
    '{"base": "white", "layers": [3]}',
    '{"base": "white", "layers": [{"pattern": "creeper", "color": 2.5}]}',
    '{"layers": []}',
    '{"layers": [{"pattern": "creeper", "color": "lime"}]}',
    '{"base": "red", "kind": "flag"}',
    '{"id": "minecraft:stone"}',
    '{"base": "red"} red',
    "[]",
    "https://example.com/banner?b=2c7",
    "https://www.planetminecraft.com/banner/",
    "https://www.planetminecraft.com/banner/?b=2c",
    "https://www.planetminecraft.com/banner/?b=2c1",
    "https://www.needcoolshoes.com/banner?=eal",
    "https://www.needcoolshoes.com/banner?=ea0Z",
    "https://minecraft.tools/en/banner.php?color_id_0=44",
    "https://www.gamergeeks.net/apps/minecraft/banner-maker#mcb=a15zzz4",
    "https://www.gamergeeks.net/apps/minecraft/banner-maker#mcb=acre5",
)

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed (apt: nodejs)")


def texts() -> Iterator[str]:
    yield from TYPED
    yield from WRITTEN
    for form in fuzz_targets.PAGE_FORMS:
        yield FORMS[form].example
        for banner in some_banners():
            try:
                yield write_banner(banner, form)
            except DesignError:
                continue


def test_the_tables_are_those_of_python() -> None:
    assert tables.PATH.parent == COMPONENT
    assert tables.PATH.read_text(encoding="utf-8") == tables.tables_module()


def test_pages_read_what_python_reads() -> None:
    given = [*texts()]
    assert len(given) > 200
    with pytest.warns(UserWarning, match="the base is .*, by its Base"):  # an item of two dyes
        for text in given:
            assert read_in_page("design", text).found == plain(Banner.parse(text)), text


def test_pages_refuse_what_python_refuses() -> None:
    for text in REFUSED:
        with pytest.raises(DesignError):
            print(Banner.parse(text), repr(text))
        assert read_in_page("design", text).error == "DesignError", text


INHERITED = ("length", "constructor", "__proto__", "toString", "hasOwnProperty", "valueOf")
PLACES = (
    *("{}", "white {}:red", "white creeper:{}", "shield {}", "base:[{}]", "[{}]", "{{base:[{}]}}"),
    *("{{base:{}}}", '{{"base":["{}"],"layers":[]}}', "{{base:red,kind:{}}}", "{{id:{}}}"),
    "{{base:red,layers:[{{pattern:{},color:red}}]}}",
    "{{base:red,layers:[{{pattern:creeper,color:{}}}]}}",
    "{{base:red,layers:[{{pattern:creeper,color:[{}]}}]}}",
    *("{}[banner_patterns=[]]", "give @s {}", "{{components:{{{}:1}}}}", '{{"{}":{{base:red}}}}'),
    *("https://planetminecraft.com/banner/?{}=2c7", "https://www.needcoolshoes.com/?banner={}"),
    "https://minecraft.tools/en/banner.php?color_id_0={}",
)


@pytest.mark.parametrize("place", PLACES)
def test_what_objects_inherit_is_no_name_of_a_design(place: str) -> None:
    for name in INHERITED:
        answer = read_in_page("design", place.format(name))
        assert answer.error == "DesignError", (name, answer)


@pytest.mark.parametrize("key", INHERITED)
def test_keys_that_objects_inherit_change_nothing(key: str) -> None:
    text = f'{{"id":"red_banner","components":{{"{key}":{{"banner_patterns":[]}}}}}}'
    assert read_in_page("design", text).found == {"base": "red", "layers": [], "kind": "banner"}


HEADS = (
    *("", "white ", "white creeper", "white creeper:", "{", '{"', "{a:", "{a:'", "[", "[I;", "@"),
    *("/give @p white_banner", "/give @p white_banner[", "https://minecraft.tools/?", "a.", "a=1"),
    *("https://www.planetminecraft.com/banner/?b=", "https://www.needcoolshoes.com/?", "minecraft"),
)
UNITS = (
    *(" ", "\t", "\n", ",", ";", ":", "::", " : ", "a", "a:", "a ", "a.", "a-", "-_", "light "),
    *('"', "'", "\\", '\\"', "\\'", "1", "1_", "1.", "1e", "[", "{", "]", "}", "{a:", "=", "&a="),
    *("colour", "colour ", "a_id_1", "a_id_1=&", "&b=", "?b", "/", "/a", "#", "@", "é", "\ud800"),
    *("creeper:red ", "minecraft:", "white_banner", "base_", "%", "\0"),
)


@pytest.mark.parametrize("head", HEADS)
def test_no_design_of_a_page_takes_long(head: str) -> None:
    """A pattern that reads a character again for each other one takes seconds for one of these."""
    for unit in UNITS:
        times = (MAX_TEXT - len(head) - 1) // len(unit)
        answer = read_in_page("design", head + unit * times + "x")
        assert answer.error in ("", "DesignError"), answer
        assert answer.seconds < 0.5, (head, unit, answer)


def test_a_design_of_a_page_has_a_largest_length() -> None:
    for length in (MAX_TEXT + 1, 80_000):
        answer = read_in_page("design", "white" + " " * (length - 5))
        assert answer.error == "DesignError"
        assert answer.message == f"the design has {length} characters; use at most {MAX_TEXT}"
    assert read_in_page("design", "white" + " " * (MAX_TEXT - 5)).found["base"] == "white"


@pytest.mark.parametrize(
    ("what", "text", "found"),
    [
        ("kind", "wall", "wall"),
        ("kind", "../secret", ""),
        ("kind", "https://example.com/standing", ""),
        ("kind", "//example.com/standing", ""),
        ("kind", "constructor", ""),
        ("kind", "", ""),
        ("wind", " 4.5 ", 4.5),
        ("wind", "", None),
        ("wind", "1e3", ""),
        ("wind", "-1", ""),
        ("wind", "Infinity", ""),
        ("wind", "NaN", ""),
        ("wind", "4 m/s", ""),
        ("direction", "-90", -90),
        ("direction", "9" * 60_000, ""),
    ],
)
def test_attributes_have_values_of_a_list_or_within_bounds(
    what: str, text: str, found: object
) -> None:
    answer = read_in_page(what, text)
    if found == "":
        assert answer.error == "Error" and answer.message.startswith(f'{what}="'), answer
        assert len(answer.message) < 200 and "; " in answer.message
    else:
        assert answer == Answer(answer.seconds, found)


def test_changed_designs_are_read_alike_or_refused() -> None:
    target = fuzz_targets.page_target()
    report = fuzzing.fuzz(target.read, target.samples, target.mutate, 600, seed=8)
    assert not report.failures, report.failures[0]
    assert report.count == 600 and report.outcomes["a banner"] > 20
