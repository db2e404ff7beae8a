"""Texts that are one tree, in JSON or SNBT: parsed once, then recognised by their keys."""

import json
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from itertools import accumulate
from typing import Any

from drapery.banner.design import Banner
from drapery.banner.formats import loom_assistant, loot, own_json, wynncraft
from drapery.banner.formats.found import FoundBanner, children_of, find_banners
from drapery.banner.formats.javascript_values import parse_object
from drapery.banner.formats.leftovers import check_read, looks_like_design
from drapery.banner.formats.snbt import MAX_DEPTH, MAX_TEXT, parse_snbt
from drapery.banner.formats.tree import DataTree, banner_from_block_entity, banner_from_tag, get
from drapery.banner.names import shown
from drapery.errors import DesignError

DATA_ANSWER = " has the following "
"""The words of `/data get` between the name and the tree."""


def recognises(text: str) -> bool:
    """Whether the text is one tree, or the game's answer to `/data get`."""
    text = text.lstrip()
    lists = text.startswith("[") and text[1:].lstrip().startswith(("{", "[", "]", '"', "'"))
    return lists or text.startswith("{") or DATA_ANSWER in text[:200]


def read(text: str) -> list[FoundBanner]:
    """All banners of the tree. Raises DesignError with the place, and if there is none."""
    return _some_of(read_text(text))


def read_wynncraft(text: str) -> list[FoundBanner]:
    """As `read`, but a design in JSON is read as Wynncraft's, with Bukkit's names."""
    tree = read_text(text)
    return [FoundBanner(wynncraft.from_tree(tree))] if wynncraft.may_be(tree) else _some_of(tree)


def banners_in(tree: DataTree) -> list[FoundBanner]:
    """All banners of a tree, which may be none. Raises DesignError with the place."""
    # What no form recognises may still hold parts of a data pack, such as an advancement's icon.
    found = list(_found(tree)) or list(loot.find(tree))
    check_read(tree, (len(one.banner.layers) for one in found))
    return found


def _some_of(tree: DataTree) -> list[FoundBanner]:
    """As `banners_in`, but a tree without a banner raises DesignError."""
    if found := banners_in(tree):
        return found
    if isinstance(tree, dict) and isinstance(tree.get("elements"), list):
        raise DesignError(_pool(tree))
    if (key := _packed(tree)) is not None:
        raise DesignError(
            f"{shown(key)}: a design packed as a text in quotes; give what is in the quotes,"
            ' with " in place of \\"'
        )
    raise DesignError(
        f"no banner in the {_sort(tree)}: it needs an id such as 'minecraft:red_banner'"
    )


def _packed(tree: DataTree) -> str | int | None:
    """The key of the first text that is a tree with the layers of a banner, or None."""
    nodes: list[Any] = [tree]
    while nodes:
        node = nodes.pop()
        named: Iterable[tuple[str | int, Any]] = ()
        if isinstance(node, dict | list):
            named = node.items() if isinstance(node, dict) else enumerate(node)
        for key, value in named:
            if isinstance(value, str) and value.lstrip()[:1] in ("{", "["):
                if looks_like_design(value):
                    return key
            elif isinstance(value, dict | list):
                nodes.append(value)
    return None


def _pool(tree: DataTree) -> str:
    """The refusal of a template pool, with the first structure that it names."""
    name = next(_locations(tree), "namespace:name")
    namespace, _, path = name.rpartition(":")
    file = f"data/{namespace or 'minecraft'}/structure/{path}.nbt"
    return (
        "a template pool, which only names structures; give the folder of its data pack, or a"
        f" structure such as {shown(file, 80)}"
    )


def _locations(tree: DataTree) -> Iterator[str]:
    """The names of the structures in a template pool."""
    nodes = [tree]
    while nodes:
        node = nodes.pop()
        if isinstance(node, dict) and isinstance(node.get("location"), str):
            yield node["location"]
        nodes += [child for _, child in children_of((None, ""), node)][::-1]


def read_text(text: str) -> DataTree:
    """The tree of a text, parsed as JSON, SNBT or an object of JavaScript, whichever fits first."""
    start = max(text.find("{"), 0) if DATA_ANSWER in text[:200] else 0
    if start == 0 and len(text) <= MAX_TEXT and _depth(text) <= MAX_DEPTH:
        with suppress(ValueError, RecursionError):
            return json.loads(text)
    # Spaces replace the words before the tree, so that columns are those of the text.
    text = " " * start + text[start:]
    try:
        return parse_snbt(text)
    except DesignError:
        if any(word in text for word in ("banner", "shield", "layers")):
            with suppress(DesignError):
                return parse_object(text)
        raise


def _depth(text: str) -> int:
    """How deep brackets nest, 0 if there are few; those in strings count too.

    The json module has no limit of its own, and the interpreter's limit changes with its version.
    """
    if text.count("[") + text.count("{") <= MAX_DEPTH:
        return 0
    steps = (1 if mark in "[{" else -1 for mark in _BRACKET.findall(text))
    return max(accumulate(steps))


_BRACKET = re.compile(r"[][{}]")


def _found(tree: DataTree) -> Iterator[FoundBanner]:
    if loot.matches(tree):
        yield from loot.find(tree)
    elif loom_assistant.matches(tree):
        yield FoundBanner(loom_assistant.from_tree(tree))
    elif wynncraft.matches(tree):
        yield FoundBanner(wynncraft.from_tree(tree))
    elif own_json.matches(tree):
        yield FoundBanner(own_json.from_tree(tree))
    elif isinstance(tree, dict) and "palette" in tree:
        yield from _in_structure(tree)
    elif isinstance(tree, dict) and (banner := _without_id(tree)):
        yield FoundBanner(banner)
    else:
        yield from find_banners(tree, details=True)


def _in_structure(tree: dict[str, DataTree]) -> Iterator[FoundBanner]:
    """The banners of a structure in SNBT. Its reader loads numpy, which other texts do not need."""
    from drapery.banner.formats import structure

    yield from (
        structure.find(tree, "structure") if structure.recognises(tree) else find_banners(tree)
    )


def _without_id(tree: dict[str, DataTree]) -> Banner | None:
    """The banner of a block entity, a tag or components that were copied without an id."""
    if "id" in tree or "Name" in tree:
        return None
    if get(tree, "BlockEntityTag")[1] is not None:
        return banner_from_tag("banner", tree) if _has_base(tree) else _baseless(tree)
    if "Patterns" in tree or "patterns" in tree or "Type" in tree:
        return banner_from_block_entity(tree)
    return _baseless(tree) if get(tree, "banner_patterns")[1] is not None else None


def _has_base(tag: dict[str, DataTree]) -> bool:
    entity = get(tag, "BlockEntityTag")[1]
    return isinstance(entity, dict) and ("Base" in entity or entity.get("Type") == 1)


def _baseless(tree: dict[str, DataTree]) -> Banner:
    sample = "[…]" if get(tree, "BlockEntityTag")[1] is None else "{…}"
    raise DesignError(
        f"{next(iter(tree))}: the item's id, which names the base dye, is missing:"
        f" write it first, as in minecraft:red_banner{sample}"
    )


def _sort(tree: DataTree) -> str:
    return "compound" if isinstance(tree, dict) else "list" if isinstance(tree, list) else "text"
