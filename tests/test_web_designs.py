"""Pages read designs as Python does: the same texts give the same banners, or both refuse them."""

import json
import random
from collections.abc import Iterator
from pathlib import Path

import pytest
from test_javascript import NODE, run_node

from drapery import Banner, DesignError, Layer
from drapery.banner import DYE_NAMES, FORMS, PATTERN_NAMES, write_banner
from drapery.web import tables

COMPONENT = tables.PATH.parent
FORMS_OF_PAGES = (
    *(
        "shorthand",
        "json",
        "give",
        "give-legacy",
        "give-1.12",
        "item",
        "setblock",
        "loom-assistant",
    ),
    *("planet-minecraft", "needcoolshoes", "minecraft-tools", "gamergeeks"),
)
"""The forms that pages read too."""

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


def plain(banner: Banner) -> dict[str, object]:
    layers = [{"pattern": layer.pattern, "dye": layer.dye} for layer in banner.layers]
    return {"base": banner.base, "layers": layers, "kind": banner.kind}


def some_banners() -> Iterator[Banner]:
    """Every pattern and dye, and designs of any number of layers."""
    for start in range(0, len(PATTERN_NAMES), 8):
        layers = [Layer(name, DYE_NAMES[n]) for n, name in enumerate(PATTERN_NAMES[start:][:8])]
        yield Banner(DYE_NAMES[start // 3], tuple(layers))
    chance = random.Random(4)
    for count in range(17):
        layers = [
            Layer(chance.choice(PATTERN_NAMES), chance.choice(DYE_NAMES)) for _ in range(count)
        ]
        yield Banner(
            chance.choice(DYE_NAMES), tuple(layers), "shield" if count % 3 == 2 else "banner"
        )
    yield Banner("white", (Layer("acme:anvil", "red"),))


def texts() -> Iterator[str]:
    yield from TYPED
    yield from WRITTEN
    for form in FORMS_OF_PAGES:
        yield FORMS[form].example
        for banner in some_banners():
            try:
                yield write_banner(banner, form)
            except DesignError:
                continue


READ = """
import { readDesign } from "component/design.js";
let text = "";
for await (const chunk of process.stdin) text += chunk;
const read = (each) => {
  try {
    return readDesign(each);
  } catch (error) {
    return error.constructor.name;
  }
};
console.log(JSON.stringify(JSON.parse(text).map(read)));
"""


def read_in_page(given: list[str], folder: Path) -> list[object]:
    """What the page makes of texts; the name of its error for those that it refuses."""
    script = folder / "read.mjs"
    script.write_text(READ.replace("component/", f"{COMPONENT.as_uri()}/"), encoding="utf-8")
    found: list[object] = json.loads(run_node(script, stdin=json.dumps(given)))
    return found


def test_the_tables_are_those_of_python() -> None:
    assert tables.PATH.read_text(encoding="utf-8") == tables.tables_module()


def test_pages_read_what_python_reads(tmp_path: Path) -> None:
    given = [*texts()]
    assert len(given) > 200
    for text, found in zip(given, read_in_page(given, tmp_path), strict=True):
        assert found == plain(Banner.parse(text)), text


def test_pages_refuse_what_python_refuses(tmp_path: Path) -> None:
    for text in REFUSED:
        with pytest.raises(DesignError):
            print(Banner.parse(text), repr(text))
    assert read_in_page([*REFUSED], tmp_path) == ["DesignError"] * len(REFUSED)
