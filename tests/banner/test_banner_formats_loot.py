"""JSON files of data packs: every design that they make, and none that they only mention."""

import json
from typing import Any

import pytest
from cost import limited_cost

from drapery.banner.formats import parse_banner, parse_banners, write_banner
from drapery.banner.formats.loot import find
from drapery.banner.formats.tree import OMINOUS
from drapery.banner.patterns import PATTERN_NAMES
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


def with_modifier(tree: Any) -> Any:
    """A file as since 26.3: `modifier` for `functions`, and `condition` for `conditions`."""
    if isinstance(tree, list):
        return [with_modifier(child) for child in tree]
    if not isinstance(tree, dict):
        return tree
    names = {} if "function" in tree else {"functions": "modifier"}
    names |= {"conditions": "condition"}
    return {names.get(key, key): with_modifier(child) for key, child in tree.items()}


@pytest.mark.parametrize("name", MADE)
def test_every_design_of_a_file_is_found_in_the_spelling_since_26_3(name: str) -> None:
    found = parse_banners(json.dumps(with_modifier(MADE[name])))
    assert [one.banner for one in found] == [LIME]


@pytest.mark.parametrize("modifier", [SET, [SET], [[SET]], [[], [{"function": "a"}, [SET]]]])
@pytest.mark.parametrize("place", ["table", "pool", "entry"])
def test_a_modifier_is_a_function_a_list_or_lists_in_it(modifier: Any, place: str) -> None:
    item = {"type": "minecraft:item", "name": "minecraft:red_banner"}
    pool = {"rolls": 1, "entries": [item | ({"modifier": modifier} if place == "entry" else {})]}
    file = {"pools": [pool | ({"modifier": modifier} if place == "pool" else {})]}
    file |= {"modifier": modifier} if place == "table" else {}
    assert [one.banner for one in parse_banners(json.dumps(file))] == [LIME]
    wrapped = {"function": "sequence", "functions": [modifier]}
    passed = {"function": "filtered", "item_filter": {"items": "red_banner"}, "on_pass": modifier}
    for holder in (wrapped, passed):
        assert [one.banner for one in find(table(entry("red_banner", holder)))] == [LIME]


@pytest.mark.parametrize(("named", "said"), [("a:b", "modifier 'a:b'"), ("#a:b", "tag '#a:b'")])
def test_a_modifier_by_its_id_is_named(named: str, said: str) -> None:
    with pytest.raises(DesignError, match=said):
        parse_banners(json.dumps(table({"type": "item", "name": "red_banner", "modifier": named})))


def chance(number: float) -> dict[str, Any]:
    return {"condition": "minecraft:random_chance", "chance": number}


def pattern(name: str, *conditions: Any, append: bool = False) -> dict[str, Any]:
    layers = [{"pattern": name, "color": "black"}]
    function = {"function": "set_banner_pattern", "patterns": layers, "append": append}
    return function | ({"conditions": list(conditions)} if conditions else {})


def designs(file: Any) -> list[str]:
    return [write_banner(one.banner, "text") for one in find(file)]


NAMES = ("creeper", "skull", "flower", "mojang", "globe")


def test_each_function_with_a_condition_gives_its_design() -> None:
    functions = [pattern(name, chance(0.2)) for name in NAMES]
    expected = [f"red {name}:black" for name in NAMES]
    assert designs(table(entry("red_banner", *functions))) == ["red", *expected]
    shields = designs(table(entry("shield", *functions)))
    assert shields == [f"shield white {name}:black" for name in NAMES]
    modifier = designs([{"function": "set_item", "item": "red_banner"}, *functions])
    assert modifier == expected


@pytest.mark.parametrize(
    "spelling",
    [
        lambda test: {"conditions": [test]},
        lambda test: {"condition": test},
        lambda test: {"condition": [test]},
    ],
)
def test_one_condition_has_one_outcome(spelling: Any) -> None:
    night = {"condition": "time_check", "value": {"min": 13000}}
    day = {"condition": "minecraft:inverted", "term": night}
    functions = [
        pattern("creeper") | spelling(night),
        {"function": "set_components", "components": {"base_color": "blue"}} | spelling(night),
        pattern("skull") | spelling(day),
    ]
    made = designs(table(entry("shield", *functions)))
    assert sorted(made) == ["shield blue creeper:black", "shield white skull:black"]
    named = {"condition": "a:night"}
    functions = [pattern("creeper") | named, pattern("border", append=True) | named]
    assert designs(table(entry("red_banner", *functions))) == [
        "red",
        "red creeper:black border:black",
    ]


def test_layers_that_may_be_added() -> None:
    functions = [pattern("creeper", chance(0.1)), pattern("border", chance(0.1), append=True)]
    assert sorted(designs(table(entry("red_banner", *functions)))) == [
        "red",
        "red border:black",
        "red creeper:black",
        "red creeper:black border:black",
    ]


def test_what_a_filter_passes_and_fails() -> None:
    both = {"on_pass": pattern("creeper"), "on_fail": [pattern("skull")]}
    for test, expected in (
        ({"items": "minecraft:red_banner"}, ["red creeper:black"]),
        ({"items": ["stone", "shield"]}, ["red skull:black"]),
        ({"items": "#minecraft:banners"}, ["red creeper:black", "red skull:black"]),
        ({"items": "red_banner", "count": 3}, ["red creeper:black", "red skull:black"]),
    ):
        function = {"function": "filtered", "item_filter": test} | both
        assert designs(table(entry("red_banner", function))) == expected


def test_the_number_of_designs_and_of_steps_is_bounded() -> None:
    many = [pattern(name, chance(0.5), append=True) for name in PATTERN_NAMES[:12]]
    few = [pattern(name, chance(0.5)) for name in NAMES * 3]
    file = table(entry("red_banner", *many), entry("red_banner", *few))
    errors: list[DesignError] = []
    assert len(list(find(file, "", errors.append))) == 1 + len(NAMES)
    assert len(errors) == 1 and str(errors[0]).startswith("pools[0].entries[0]: over 256 designs")
    big = table(*[entry("red_banner")] * 3000, functions=[SET] * 3000)
    with limited_cost(seconds=10), pytest.raises(DesignError, match="split the file"):
        list(find(big))


def test_one_broken_function_with_a_condition_leaves_the_other_designs() -> None:
    errors: list[DesignError] = []
    file = table(entry("red_banner", pattern("x", chance(0.5)), pattern("skull", chance(0.5))))
    found = [write_banner(one.banner, "text") for one in find(file, "", errors.append)]
    assert found == ["red", "red skull:black"]
    assert len(errors) == 1 and "functions[0].patterns[0].pattern" in str(errors[0])


def test_a_function_that_is_not_known_but_has_layers_is_named() -> None:
    with pytest.raises(DesignError, match=r"functions\[0\]: the function 'mod:set_flag' cannot be"):
        designs(table(entry("red_banner", {"function": "mod:set_flag", "layers": LAYERS})))


def test_a_broken_banner_with_layers_of_its_own_is_read_by_them() -> None:
    unknown = {"function": "mod:flag", "patterns": LAYERS}
    assert designs(table(entry("red_banner", unknown, pattern("skull")))) == ["red skull:black"]


ICONS = [
    {"item": "minecraft:red_banner", "nbt": TAG},
    {"item": "red_banner", "components": COMPONENTS},
    {"id": "minecraft:red_banner", "components": COMPONENTS},
    {"id": "minecraft:red_banner", "count": 1, "components": {"banner_patterns": LAYERS}},
]


@pytest.mark.parametrize("icon", ICONS)
def test_the_icon_of_an_advancement_alone_or_in_it(icon: Any) -> None:
    for tree in (
        icon,
        {"icon": icon},
        {"display": {"icon": icon, "title": {"text": "Flag"}}},
        {"parent": "a:b", "display": {"icon": icon}, "criteria": {"a": {"trigger": "tick"}}},
        [{"display": {"icon": icon}}],
        {"a:root": {"display": {"icon": icon}}},
    ):
        assert [one.banner for one in parse_banners(json.dumps(tree))] == [LIME]


@pytest.mark.parametrize("name", MADE)
def test_every_design_of_design_of_a_file_is_found_once(name: str) -> None:
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
            ["functions[0].components.patterns", "not a component"],
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
