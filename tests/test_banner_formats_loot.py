"""JSON files of data packs: every design that they make, and none that they only mention."""

import json
from typing import Any

import pytest

from drapery.banner.formats import parse_banner, parse_banners
from drapery.banner.formats.loot import find
from drapery.banner.formats.tree import OMINOUS
from drapery.errors import DesignError

LIME = parse_banner("red creeper:lime")
LAYERS = [{"pattern": "minecraft:creeper", "color": "lime"}]
TAG = "{BlockEntityTag:{Patterns:[{Pattern:cre,Color:5}]}}"
SET = {"function": "minecraft:set_banner_pattern", "patterns": LAYERS, "append": False}
COMPONENTS = {"minecraft:banner_patterns": LAYERS}


def entry(name: str = "minecraft:red_banner", *functions: Any, **more: Any) -> dict[str, Any]:
    return {"type": "minecraft:item", "name": name, "functions": list(functions)} | more


def table(*entries: Any, **more: Any) -> dict[str, Any]:
    return {"type": "minecraft:chest", "pools": [{"rolls": 1, "entries": list(entries)} | more]}


MADE: dict[str, Any] = {
    "set_banner_pattern": table(entry("red_banner", SET)),
    "set_components": table(
        entry("red_banner", {"function": "set_components", "components": COMPONENTS})
    ),
    "set_nbt": table(entry("red_banner", {"function": "minecraft:set_nbt", "tag": TAG})),
    "functions of the pool": table(entry("red_banner"), functions=[SET]),
    "functions of the table": table(entry("red_banner")) | {"functions": [SET]},
    "append": table(
        entry(
            "red_banner", SET | {"patterns": []}, SET | {"append": True}, {"function": "set_count"}
        )
    ),
    "alternatives": table({"type": "alternatives", "children": [entry("red_banner", SET)]}),
    "a sequence": table(entry("red_banner", {"function": "sequence", "functions": [SET]})),
    "set_item": table(entry("stone", {"function": "set_item", "item": "red_banner"}, SET)),
    "contents": table(
        entry("chest", {"function": "set_contents", "entries": [entry("red_banner", SET)]})
    ),
    "item modifier with a filter": {
        "function": "filtered",
        "item_filter": {"items": "minecraft:red_banner"},
        "modifier": SET,
    },
    "recipe": {
        "type": "crafting_shaped",
        "pattern": ["A"],
        "key": {"A": {"item": "white_banner"}},
        "result": {"id": "red_banner", "components": COMPONENTS},
    },
    "recipe of a mod": {"type": "a:b", "result": {"item": "minecraft:red_banner", "nbt": TAG}},
    "smithing": {
        "type": "minecraft:smithing_transform",
        "base": {"item": "minecraft:white_banner"},
        "addition": {"item": "minecraft:shield"},
        "result": {"id": "red_banner", "components": COMPONENTS},
    },
    "advancement": {
        "display": {"icon": {"id": "red_banner", "components": COMPONENTS}, "title": "a"},
        "criteria": {"a": {"conditions": {"items": [{"items": "minecraft:blue_banner"}]}}},
    },
    "advancement before 1.20.5": {
        "display": {"icon": {"item": "red_banner", "nbt": TAG}},
        "criteria": {},
    },
    "criterion": {
        "criteria": {"a": {"conditions": {"items": [{"items": "red_banner", "nbt": TAG}]}}}
    },
    "predicate": {
        "condition": "minecraft:entity_properties",
        "predicate": {"equipment": {"head": {"items": "red_banner", "components": COMPONENTS}}},
    },
    "predicates": [{"condition": "match_tool", "predicate": {"items": ["red_banner"], "nbt": TAG}}],
    "processor": {
        "processors": [
            {
                "rules": [
                    {
                        "input_predicate": {"block": "minecraft:pink_wall_banner"},
                        "output_state": {"Name": "minecraft:red_wall_banner"},
                        "block_entity_modifier": {
                            "type": "append_static",
                            "data": {"patterns": LAYERS},
                        },
                    }
                ]
            }
        ]
    },
    "Bedrock's set_banner_details": table(
        entry(
            "minecraft:banner",
            {
                "function": "set_banner_details",
                "type": "default",
                "base_color": "red",
                "patterns": [{"pattern": "creeper", "color": "lime"}],
            },
        )
    ),
}


@pytest.mark.parametrize("name", MADE)
def test_every_design_of_a_file_is_found_once(name: str) -> None:
    found = parse_banners(json.dumps(MADE[name]))
    assert [one.banner for one in found] == [LIME]
    assert found[0].where or name == "item modifier with a filter"


def test_designs_have_their_path() -> None:
    (one,) = find(MADE["set_components"], "data/a/loot_table/x.json")
    assert one.where == "data/a/loot_table/x.json.pools[0].entries[0]"


def test_dyes_and_types_of_bedrock() -> None:
    ominous = {"function": "set_banner_details", "type": 1}
    file = table(
        entry("minecraft:banner", ominous),
        entry("minecraft:banner", {"function": "set_data", "data": 1}),
        entry("minecraft:banner", {"function": "set_data", "data": {"min": 0, "max": 15}}),
    )
    text = json.dumps(file).replace('"pools"', '// a comment: "a"\n"pools"', 1)
    assert [one.banner for one in parse_banners(text)] == [OMINOUS, parse_banner("red")]


def test_shields_of_loot_tables() -> None:
    colour = {"function": "set_components", "components": {"base_color": "red"}}
    file = table(entry("shield"), entry("shield", SET, colour), entry("shield", colour))
    assert [one.banner for one in parse_banners(json.dumps(file))] == [
        parse_banner("shield red creeper:lime"),
        parse_banner("shield red"),
    ]


@pytest.mark.parametrize(
    "file",
    [
        table(entry("red_banner", {"function": "copy_components", "source": "block_entity"})),
        table(entry("minecraft:creeper_banner_pattern"), entry("diamond", {"function": "a"})),
        table({"type": "tag", "name": "minecraft:banners"}),
        {"criteria": {"a": {"conditions": {"items": [{"items": ["minecraft:red_banner"]}]}}}},
        {"condition": "block_state_property", "block": "minecraft:red_banner"},
        {"type": "crafting_shapeless", "ingredients": [{"item": "red_banner"}], "result": "stone"},
        {"function": "set_name", "name": "Banner"},
        {"processors": [{"rules": [{"output_state": {"Name": "minecraft:stone"}}]}]},
    ],
)
def test_a_file_that_mentions_banners_makes_none(file: Any) -> None:
    assert list(find(file)) == []


@pytest.mark.parametrize(
    ("file", "parts"),
    [
        (SET, ["no base dye"]),
        ([SET], ["[0]", "no base dye"]),
        (table({"type": "tag", "name": "minecraft:banners", "functions": [SET]}), ["no base dye"]),
        (
            table(entry("red_banner", {"function": "reference", "name": "a:b"})),
            ["pools[0].entries[0]", "'a:b'"],
        ),
        (
            table(
                entry("red_banner", {"function": "set_components", "components": {"patterns": 1}})
            ),
            ["entries[0].patterns", "not a component"],
        ),
        (
            table(entry("red_banner", {"function": "set_nbt", "tag": "{BlockEntityTag:["})),
            ["functions[0].tag: line 1, column 18"],
        ),
        (
            table(entry("red_banner", SET | {"patterns": [{"pattern": "x", "color": "red"}]})),
            ["entries[0].functions[0].patterns[0].pattern", "'x'"],
        ),
        ({"type": "a:b", "result": {"id": "red_banner", "nbt": TAG}}, ["result.nbt"]),
    ],
)
def test_a_design_that_cannot_be_read_is_named(file: Any, parts: list[str]) -> None:
    with pytest.raises(DesignError) as caught:
        parse_banners(json.dumps(file))
    assert [part for part in parts if part not in str(caught.value)] == [], str(caught.value)
    errors: list[DesignError] = []
    assert list(find(file, "", errors.append)) == [] and len(errors) == 1


def test_one_broken_entry_leaves_the_others() -> None:
    broken = SET | {"patterns": [{"pattern": "x", "color": "red"}]}
    errors: list[DesignError] = []
    file = table(entry("red_banner", broken), entry("red_banner", SET))
    assert [one.banner for one in find(file, "", errors.append)] == [LIME]
    assert len(errors) == 1
