"""Designs whose parts are moved, wrapped, put in another order, quoted and commented.

What comes out is the design, or a refusal, or the design with a warning: never silently a plain
banner, one with fewer layers, or one with another base.
"""

import copy
import json
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, NamedTuple

import pytest
import yaml

from drapery.banner import Banner
from drapery.banner.formats import FORMS, parse_banners
from drapery.banner.formats.snbt import parse_snbt, write_snbt
from drapery.errors import DraperyError

LAYERS = [{"pattern": "creeper", "color": "lime"}, {"pattern": "border", "color": "black"}]
TEXTS = ["LIME:CREEPER", "BLACK:BORDER"]
OLD = [{"Pattern": "cre", "Color": 10}, {"Pattern": "bo", "Color": 0}]
STACK = {"==": "org.bukkit.inventory.ItemStack"}


class Sample(NamedTuple):
    """A design as a tree, and how the tree becomes a text."""

    tree: Any
    write: Callable[[Any], str]


def in_yaml(tree: Any) -> str:
    return yaml.safe_dump(tree, sort_keys=False)


def in_javascript(tree: Any) -> str:
    """The object as the value of a constant: keys without quotes, single quotes, commas at ends."""
    if isinstance(tree, dict):
        pairs = [
            f"{key if key.isidentifier() else repr(key)}: {in_javascript(tree[key])},"
            for key in tree
        ]
        return "{ " + " ".join(pairs) + " }"
    if isinstance(tree, list):
        return "[" + "".join(f"{in_javascript(x)}, " for x in tree) + "]"
    return repr(tree) if isinstance(tree, str) else json.dumps(tree)


def in_constant(tree: Any) -> str:
    return f"const banner = {in_javascript(tree)}; // a note"


def components(words: str, tree: Any) -> str:
    """A command with `[a=…,b=…]`, or with a tag in place of components that are no mapping."""
    if not isinstance(tree, dict):
        return words.format(write_snbt(tree))
    return words.format("[" + ",".join(f"{key}={write_snbt(tree[key])}" for key in tree) + "]")


def tag(words: str, tree: Any) -> str:
    return words.format(write_snbt(tree))


def samples() -> Iterator[tuple[str, Sample]]:
    for name in ("bukkit", "deluxemenus", "mythicmobs", "crazycrates", "commandpanels", "yaml"):
        yield name, Sample(yaml.safe_load(FORMS[name].example), in_yaml)
    for name in ("loot-table", "wynncraft", "loom-assistant", "json", "bedrock", "item"):
        yield name, Sample(parse_snbt(FORMS[name].example), json.dumps)
        yield f"{name} in JavaScript", Sample(parse_snbt(FORMS[name].example), in_constant)
    patterns = {"minecraft:banner_patterns": LAYERS}
    trees: dict[str, Any] = {
        "shield of deluxemenus": {
            "x": {"material": "SHIELD", "base_color": "RED", "banner_meta": ["LIME;CREEPER"]}
        },
        "shield of mythicmobs": {
            "x": {"Id": "shield", "Options": {"Color": "RED"}, "BannerLayers": ["LIME CREEPER"]}
        },
        "settings of crazycrates": {
            "x": {"material": "red_banner", "settings": {"patterns": {"creeper": "lime"}}}
        },
        "old stack": {
            "x": STACK
            | {
                "type": "BANNER",
                "damage": 1,
                "meta": {"meta-type": "BANNER", "patterns": LAYERS, "base-color": "BLUE"},
            }
        },
        "stack by damage": {
            "x": STACK
            | {"type": "BANNER", "damage": 1, "meta": {"==": "ItemMeta", "patterns": LAYERS}}
        },
        "shield of bukkit": {
            "x": STACK
            | {
                "type": "SHIELD",
                "meta": {"==": "ItemMeta", "base-color": "RED", "patterns": LAYERS},
            }
        },
        "stack with components": {
            "x": STACK
            | {
                "id": "minecraft:red_banner",
                "components": {"minecraft:banner_patterns": write_snbt(LAYERS)},
            }
        },
        "shield with components": {
            "x": STACK
            | {
                "id": "minecraft:shield",
                "components": {
                    "minecraft:banner_patterns": write_snbt(LAYERS),
                    "minecraft:base_color": '"red"',
                },
            }
        },
        "menu": {"x": {"icon": "RED_BANNER", "slot": 3, "meta": {"patterns": TEXTS}}},
        "two items": {
            "a": {"material": "RED_BANNER", "patterns": TEXTS},
            "b": {"material": "BLUE_BANNER", "meta": {"patterns": ["RED:CROSS"]}},
        },
        "no item": {"banner": {"base-color": "RED", "patterns": {"1": LAYERS[0], "2": LAYERS[1]}}},
        "collection": {"1718": {"color": "RED", "patterns": ["cre:LIME", "bo:BLACK"]}},
        "shield of a plugin": {
            "x": {"type": "shield", "base-color": "red", "banner-patterns": {"1": LAYERS[0]}}
        },
        "denizen": {
            "x": {
                "type": "item",
                "material": "red_banner",
                "mechanisms": {"hides": "all", "patterns": "LIME/CREEPER|BLACK/BORDER"},
            }
        },
        "denizen's list": {
            "x": {
                "type": "item",
                "material": "red_banner",
                "mechanisms": {"patterns": ["LIME/CREEPER", "BLACK/BORDER"]},
            }
        },
        "shield of denizen": {
            "x": {
                "type": "item",
                "material": "shield",
                "mechanisms": {"base_color": "RED", "patterns": "LIME/CREEPER|BLACK/BORDER"},
            }
        },
        "item of denizen": {"x": {"item": "red_banner[patterns=LIME/CREEPER|BLACK/BORDER]"}},
    }
    yield from ((name, Sample(tree, in_yaml)) for name, tree in trees.items())
    item = {"id": "minecraft:red_banner", "count": 1, "components": patterns}
    shield = {"id": "shield", "components": patterns | {"base_color": "red"}}
    old = {"id": "banner", "Damage": 1, "tag": {"BlockEntityTag": {"Base": 1, "Patterns": OLD}}}
    nodes: dict[str, Any] = {
        "item in a chest": {"Items": [item]},
        "shield in a chest": {"Items": [shield]},
        "old item": old,
        "old shield": old | {"id": "shield"},
        "old block": {"id": "Banner", "Base": 1, "Patterns": OLD},
        "item of Bedrock": {"Name": "minecraft:banner", "Damage": 1, "tag": {"Patterns": OLD}},
    }
    yield from ((name, Sample(tree, write_snbt)) for name, tree in nodes.items())
    give, place = "/give @p red_banner{} 1", "/setblock ~ ~ ~ red_banner[rotation=4]{}"
    new = {"patterns": LAYERS, "id": "banner"}
    yield "give", Sample(patterns | {"item_name": "x"}, partial(components, give))
    yield "shield", Sample(shield["components"], partial(components, "/give @p shield{} 1"))
    yield "give-legacy", Sample({"BlockEntityTag": {"Patterns": OLD}}, partial(tag, give))
    yield "setblock", Sample(new, partial(tag, place))
    yield "block-entity", Sample(new, partial(tag, "red_banner[rotation=8]{}"))
    yield "summon", Sample({"Item": item}, partial(tag, "/summon item_frame ~ ~ ~ {}"))
    yield (
        "falling block",
        Sample(
            {"BlockState": {"Name": "red_banner"}, "TileEntityData": {"patterns": LAYERS}},
            partial(tag, "/summon falling_block ~ ~ ~ {}"),
        ),
    )
    yield (
        "item-replace",
        Sample(
            patterns, partial(components, "/item replace entity @s armor.head with red_banner{}")
        ),
    )


SAMPLES = dict(samples())


def moved(tree: Any) -> Iterator[Any]:
    """Every tree with one part moved, wrapped or in another order."""
    for path in paths(tree):
        part = at(tree, path)
        if path:
            yield changed(tree, path, {"extra": part})
            yield changed(tree, path, [part])
        if isinstance(part, list) and part:
            yield changed(tree, path, {str(number): x for number, x in enumerate(part, 1)})
            yield changed(tree, path, {f"layer{number}": x for number, x in enumerate(part, 1)})
        if isinstance(part, dict) and len(part) > 1:
            yield changed(tree, path, dict(reversed(part.items())))
            for key in part:
                yield changed(tree, path, {"extra": {key: part[key]}} | without(part, key))
                yield changed(tree, path, without(part, key) | {"extra": {key: part[key]}})
                yield changed(tree, path, {key: part[key], "extra": without(part, key)})
                yield changed(tree, path, {"extra": without(part, key), key: part[key]})


def paths(tree: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    yield path
    keyed = tree.items() if isinstance(tree, dict) else []
    keyed = enumerate(tree) if isinstance(tree, list) else keyed
    for key, child in keyed:
        yield from paths(child, (*path, key))


def at(tree: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        tree = tree[key]
    return tree


def changed(tree: Any, path: tuple[Any, ...], part: Any) -> Any:
    if not path:
        return part
    tree = copy.deepcopy(tree)
    at(tree, path[:-1])[path[-1]] = part
    return tree


def without(part: dict[str, Any], key: str) -> dict[str, Any]:
    return {name: value for name, value in part.items() if name != key}


def respelt(text: str) -> Iterator[str]:
    """A text of YAML with other quotes, comments, breaks and bullets."""
    tree = yaml.safe_load(text)
    for style in ("'", '"'):
        yield yaml.safe_dump(tree, sort_keys=False, default_style=style)
    yield yaml.safe_dump(tree, sort_keys=False, default_flow_style=True)
    yield yaml.safe_dump(tree, sort_keys=False, indent=6)
    lines = text.rstrip("\n").split("\n")
    yield "\n".join(f"{line}  # a note: it's RED:CROSS" for line in lines)
    yield "# patterns: RED/CROSS\n" + "\n\n".join(lines)
    yield "\r\n".join(lines)
    yield "---\n" + text
    yield "\n".join(("- " if number == 0 else "  ") + line for number, line in enumerate(lines))


def fault(text: str, expected: list[Banner]) -> str | None:
    """What is wrong with what comes out of a text, or None."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            found = [one.banner for one in parse_banners(text)]
        except DraperyError:
            return None
    return None if said or set(found) == set(expected) else f"{text}\n-> {found}"


@pytest.mark.parametrize("name", SAMPLES)
def test_a_moved_part_never_makes_another_banner(name: str) -> None:
    sample = SAMPLES[name]
    whole = sample.write(sample.tree)
    expected = [one.banner for one in parse_banners(whole)]
    assert expected and all(banner.layers for banner in expected)
    texts = {sample.write(tree) for tree in moved(sample.tree)}
    if sample.write is in_yaml:
        texts |= set(respelt(whole))
    faults = [wrong for text in sorted(texts) if (wrong := fault(text, expected))]
    assert not faults, f"{len(faults)} of {len(texts)}:\n" + "\n".join(faults[:6])


WRAPPED = [
    "- {}",
    "1. {}",
    "  {}  ",
    "'{}'",
    '"{}"',
    "commands:\n  - '{}'",
    "`{}`",
    "```\n{}\n```",
    "{} # a note: RED:CROSS",
    "# a note\n{}",
    "// a note\n\n{}\n",
    "{}\n{}",
    "- {}\n- {}\n",
    "design: {}",
    "[{}]",
    '["{}"]',
    "{a: {}}",
]


BREAKS = ("\n", "\n    ", "\\\n", " \\\n  ")
"""Breaks of a line, with and without a backslash."""


@pytest.mark.parametrize("form", FORMS)
def test_what_surrounds_a_text_never_makes_another_banner(form: str) -> None:
    example = FORMS[form].example
    expected = [one.banner for one in parse_banners(example)]
    texts = [wrapping.replace("{}", example) for wrapping in WRAPPED]
    texts += [
        example.replace("\n", "\r\n"),
        example.replace(" ", "  "),
        example.replace("\n", "\n\n"),
    ]
    texts += [example.replace("\n", "\n  "), example.replace("\n", " # a note\n")]
    texts += [example.replace(mark, f"{mark}{end}") for mark in ("[", ",", " ") for end in BREAKS]
    texts += [f"{example}\n{example.replace('[', '[' + end)}" for end in BREAKS]
    texts += [json.dumps(example), json.dumps(json.dumps(example)), f"'{json.dumps(example)}'"]
    faults = [wrong for text in texts if (wrong := fault(text, expected))]
    assert not faults, f"{len(faults)} of {len(texts)}:\n" + "\n".join(faults)
