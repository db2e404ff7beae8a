"""JSON files of data packs: loot tables, item modifiers, recipes, advancements and predicates.

A loot table names an item, and its functions give the design: `set_banner_pattern`,
`set_components`, `set_nbt` (before 1.20.5), and Bedrock's `set_banner_details` and `set_data`. They
stand at the item, its pool or the table. Ingredients and predicates only test for a banner, so one
without layers is not a design.
"""

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner, Path, children_of, path_text, reader_of
from drapery.banner.formats.leftovers import check_components, looks_like_design
from drapery.banner.formats.snbt import parse_snbt
from drapery.banner.formats.tree import (
    OLD_BANNERS,
    OMINOUS,
    DataTree,
    banner_from_block_entity,
    banner_from_components,
    banner_from_tag,
    bare,
    base_of,
    get,
    is_banner_id,
    is_shield_id,
    names,
    read_layers,
    under,
)
from drapery.banner.names import dye_name, shown
from drapery.errors import DesignError

NAME = "loot-table"
TITLE = "loot table, item modifier, recipe, advancement or predicate of a data pack"
EXAMPLE = (
    '{"pools": [{"rolls": 1, "entries": [{"type": "minecraft:item",'
    ' "name": "minecraft:white_banner", "functions": [{"function":'
    ' "minecraft:set_banner_pattern", "patterns": [{"pattern": "minecraft:creeper",'
    ' "color": "lime"}], "append": false}]}]}]}'
)
SOURCE = "https://minecraft.wiki/w/Item_modifier"

OnError = Callable[[DesignError], None]

_KEYS = frozenset({"pools", "function", "functions", "criteria", "condition", "processors"})
"""Keys of which a data pack's JSON has at least one, unless it is a recipe."""

_TESTING_WORDS = """
addition additional_wants base condition conditions criteria ingredient ingredients input
input_predicate item_filter key location_predicate predicate template wants
"""
_TESTING = frozenset(_TESTING_WORDS.split())
"""Keys under which a banner is not made, but looked for or used up."""

_MADE = frozenset({"icon", "result", "results"})
"""Keys under which `item` names what is made; elsewhere it names what is looked for."""

_HIDING_WORDS = """
copy_components copy_custom_data copy_nbt copy_state random_aux_value random_dye
set_data_from_color_index trader_material_type
"""
_HIDING = frozenset(_HIDING_WORDS.split())
"""Functions after which the design of an item depends on the game."""

_HOLDERS = frozenset({"sequence", "filtered"})
"""Functions that consist of others."""


def recognises(text: str) -> bool:
    """Whether the text is JSON with keys that data packs have."""
    text = text.lstrip()
    keys = ("pools", "function", "functions", "criteria", "condition", "processors", "result")
    return text[:1] in ("{", "[") and any(f'"{key}"' in text for key in keys)


def matches(tree: DataTree) -> bool:
    """Whether a tree is a JSON file of a data pack."""
    if isinstance(tree, list):
        return bool(tree) and all(
            isinstance(node, dict) and ("function" in node or "condition" in node) for node in tree
        )
    if not isinstance(tree, dict) or "id" in tree:
        return False
    return bool(_KEYS.intersection(tree)) or ("result" in tree and "type" in tree)


@dataclass(frozen=True)
class _Modifier:
    """A function of a loot table with its place."""

    tree: dict[str, DataTree]
    path: Path


@dataclass(frozen=True)
class _Node:
    """A part of the file. modifiers: the functions that apply to items in it."""

    path: Path
    tree: DataTree
    modifiers: tuple[_Modifier, ...] = ()
    tested: bool = False


@dataclass
class _Item:
    """An item while functions change it.

    id: of the item; empty if it is not known. hidden: whether its design may come from the game.
    reference: the item modifier of another file that changes it. applied: the ids of the functions
    so far, as Python objects.
    """

    id: str
    applied: set[int]
    base: str | None = None
    layers: tuple[Layer, ...] = ()
    hidden: bool = False
    reference: str = ""
    components: dict[str, DataTree] = field(default_factory=dict)


def find(tree: DataTree, where: str = "", on_error: OnError | None = None) -> Iterator[FoundBanner]:
    """Every banner of a JSON file of a data pack, with its path.

    on_error: called with the error of one broken banner, after which the search continues;
        without it, the error is raised.
    """
    groups: list[tuple[_Modifier, ...]] = []
    applied: set[int] = set()
    nodes = [_Node((None, where), tree)]
    while nodes:
        node = nodes.pop()
        if own := tuple(_modifiers(node)):
            groups.append(own)
            node = _Node(node.path, node.tree, own + node.modifiers, node.tested)
        if isinstance(node.tree, dict):
            yield from _tried(partial(_banner, node, applied), node.path, on_error)
        if _reader(node.tree) is None:
            nodes += [*_below(node)][::-1]
    for group in groups:
        path = group[0].path
        yield from _tried(partial(_without_item, group, applied), path, on_error)


def _tried(
    read: Callable[[], Banner | None], path: Path, on_error: OnError | None
) -> Iterator[FoundBanner]:
    try:
        banner = read()
    except DesignError as error:
        if on_error is None:
            raise
        on_error(error)
        return
    if banner is not None:
        yield FoundBanner(banner, path_text(path))


def _reader(tree: DataTree) -> Callable[[DataTree, str], Banner] | None:
    """The function that reads an item with an id, as in results and icons since 1.20.5."""
    is_other = not isinstance(tree, dict) or not {"function", "item", "items"}.isdisjoint(tree)
    return None if is_other else reader_of(tree, None)


def _below(node: _Node) -> Iterator[_Node]:
    """The children of a node. Items within a function are not those that it changes."""
    inside = isinstance(node.tree, dict) and "function" in node.tree
    for path, child in children_of(node.path, node.tree):
        key = path[1]
        modifiers = () if inside or key == "functions" else node.modifiers
        yield _Node(path, child, modifiers, node.tested or key in _TESTING)


def _modifiers(node: _Node) -> Iterator[_Modifier]:
    """The functions that a node has, or those that it is."""
    tree, path = node.tree, node.path
    functions = tree.get("functions") if isinstance(tree, dict) else tree
    if isinstance(functions, list):
        at: Path = (path, "functions") if isinstance(tree, dict) else path
        for number, function in enumerate(functions):
            if isinstance(function, dict) and "function" in function:
                yield _Modifier(function, (at, number))
    elif isinstance(tree, dict) and "function" in tree and not isinstance(path[1], int):
        yield _Modifier(tree, path)


def _banner(node: _Node, applied: set[int]) -> Banner | None:
    """The banner that a node names, or None."""
    tree, at = node.tree, path_text(node.path)
    if reader := _reader(tree):
        if isinstance(tree.get("tag"), str):
            tree = tree | {"tag": _tag(tree["tag"], under(at, "tag"))}
        banner = reader(tree, at)
        return banner if banner.layers or not node.tested else None
    name = tree.get("name")
    if _is_id(name) and not {"type", "functions", "weight"}.isdisjoint(tree):
        return _modified(_Item(name, applied), node.modifiers, at)
    if "output_state" in tree:
        return _placed(tree, at)
    step = node.path if not isinstance(node.path[1], int) else node.path[0] or node.path
    made = step[1] in _MADE and not node.tested
    for spelling in ("item", "items", "blocks"):
        value = tree.get(spelling)
        for identifier in value if isinstance(value, list) else [value]:
            if _is_id(identifier):
                item = _from_item(identifier, tree, at)
                return item if item and (item.layers or made) else None
    result = tree.get("result")
    return _from_item(result, {}, at) if _is_id(result) else None


def _is_id(value: DataTree) -> bool:
    return is_banner_id(value) or is_shield_id(value)


def _from_item(identifier: str, tree: dict[str, DataTree], at: str) -> Banner | None:
    """An item with its components, or with its tag before 1.20.5. None for a plain shield."""
    key, components = get(tree, "components")
    if isinstance(components, dict):
        colours = (get(components, name)[1] for name in ("base_color", "banner_patterns"))
        if is_shield_id(identifier) and not any(colours):
            return None
        return banner_from_components(identifier, components, under(at, key))
    key = "tag" if "tag" in tree else "nbt"
    if is_shield_id(identifier) and not _has_block_entity(tree.get(key)):
        return None
    if key in tree:
        return banner_from_tag(identifier, _tag(tree[key], under(at, key)), under(at, key))
    if bare(identifier) in OLD_BANNERS:
        data = tree.get("data")
        return Banner(dye_name(data, under(at, "data"), inverted=True)) if "data" in tree else None
    return banner_from_components(identifier, {}, at)


def _has_block_entity(tag: DataTree) -> bool:
    return isinstance(tag, str | dict) and "BlockEntityTag" in tag


def _tag(value: DataTree, at: str) -> DataTree:
    if not isinstance(value, str):
        return value
    try:
        return parse_snbt(value)
    except DesignError as error:
        raise DesignError(f"{at}: {error}") from None


def _placed(tree: dict[str, DataTree], at: str) -> Banner | None:
    """The banner that a rule of a processor places in a structure."""
    state = tree["output_state"]
    name = state.get("Name") if isinstance(state, dict) else None
    if not is_banner_id(name):
        return None
    modifier = tree.get("block_entity_modifier")
    data = modifier.get("data") if isinstance(modifier, dict) else tree.get("output_nbt")
    return banner_from_block_entity(_tag(data, at), at, block=name)


def _modified(item: _Item, modifiers: tuple[_Modifier, ...], at: str) -> Banner | None:
    """The item of a loot table after its functions, or None if the file does not state it."""
    for modifier in modifiers:
        _apply(item, modifier.tree, path_text(modifier.path))
    if not item.layers:
        check_components(item.components, at)
        if item.reference:
            raise DesignError(
                f"{at}: its design may be in the item modifier {shown(item.reference)}; give that"
                " file"
            )
    if is_shield_id(item.id):
        has_design = item.base is not None or item.layers
        return Banner(item.base or "white", item.layers, kind="shield") if has_design else None
    base = item.base if bare(item.id) in OLD_BANNERS else base_of(item.id)
    if not is_banner_id(item.id) or (item.hidden and (base is None or not item.layers)):
        return None
    # A missing damage value is 0, which is black.
    return Banner(base or "black", item.layers)


def _apply(item: _Item, function: dict[str, DataTree], at: str) -> None:
    """Change an item by a function. Raises DesignError for a function that cannot be read."""
    item.applied.add(id(function))
    name = _name_of(function)
    if name in _HOLDERS:
        for inner in _within(function):
            _apply(item, inner, at)
    elif name in _HIDING:
        item.hidden = True
    elif name == "reference":
        item.reference = str(function.get("name"))
    elif name in _FUNCTIONS:
        _FUNCTIONS[name](item, function, at)


def _name_of(function: dict[str, DataTree]) -> str:
    name = function.get("function")
    return bare(name) if isinstance(name, str) else ""


def _within(function: dict[str, DataTree]) -> list[dict[str, DataTree]]:
    """The functions that a function consists of."""
    inner: list[DataTree] = []
    for key in ("functions", "modifier", "on_pass"):
        value = function.get(key)
        inner += value if isinstance(value, list) else [value]
    return [one for one in inner if isinstance(one, dict)]


def _set_banner_pattern(item: _Item, function: dict[str, DataTree], at: str) -> None:
    layers = read_layers(function.get("patterns"), under(at, "patterns"))
    item.layers = (item.layers if function.get("append") else ()) + layers


def _set_components(item: _Item, function: dict[str, DataTree], at: str) -> None:
    at = under(at, "components")
    components = function.get("components")
    if not isinstance(components, dict):
        raise DesignError(f"{at}: {shown(components)} is not a compound; write {{…}}")
    item.components |= components
    key, entries = get(components, "banner_patterns")
    if entries is not None:
        item.layers = read_layers(entries, under(at, key))
    key, base = get(components, "base_color")
    if base is not None:
        item.base = dye_name(base, under(at, key))


def _set_nbt(item: _Item, function: dict[str, DataTree], at: str) -> None:
    at = under(at, "tag")
    tag = _tag(function.get("tag"), at)
    if is_shield_id(item.id) and not _has_block_entity(function.get("tag")):
        return
    banner = banner_from_tag(item.id, tag, at)
    item.base, item.layers = banner.base, banner.layers


def _set_item(item: _Item, function: dict[str, DataTree], at: str) -> None:
    item.id = str(function.get("item", ""))


def _set_banner_details(item: _Item, function: dict[str, DataTree], at: str) -> None:
    if function.get("type") in (1, "illager_captain"):
        item.base, item.layers = OMINOUS.base, OMINOUS.layers
        return
    if "base_color" in function:
        item.base = dye_name(function["base_color"], under(at, "base_color"))
    item.layers = read_layers(function.get("patterns"), under(at, "patterns"))


def _set_data(item: _Item, function: dict[str, DataTree], at: str) -> None:
    data = function.get("data")
    item.hidden = item.hidden or not isinstance(data, int)
    if isinstance(data, int) and bare(item.id) in OLD_BANNERS:
        item.base = dye_name(data, under(at, "data"), inverted=True)


_FUNCTIONS: dict[str, Callable[[_Item, dict[str, DataTree], str], None]] = {
    "set_banner_details": _set_banner_details,
    "set_banner_pattern": _set_banner_pattern,
    "set_components": _set_components,
    "set_data": _set_data,
    "set_item": _set_item,
    "set_nbt": _set_nbt,
}


def _without_item(group: tuple[_Modifier, ...], applied: set[int]) -> Banner | None:
    """The design of functions without an item of their own, as item modifiers have them."""
    left = [one for one in group if id(one.tree) not in applied]
    if not any(
        map(_sets_design, (inner for one in left for inner in (one.tree, *_within(one.tree))))
    ):
        return None
    at = path_text(group[0].path)
    item = _Item(next(filter(None, (_item_of(one.tree) for one in left)), ""), applied)
    for one in left:
        _apply(item, one.tree, path_text(one.path))
    if not item.layers:
        return None
    base = base_of(item.id) or item.base
    if base is None:
        raise DesignError(
            f"{at or 'function'}: the design has no base dye, since the file does not name its"
            " item; put the function into a loot table, at an item such as minecraft:red_banner"
        )
    return Banner(base, item.layers, "banner" if base_of(item.id) else "shield")


def _sets_design(function: dict[str, DataTree]) -> bool:
    name = _name_of(function)
    if name in ("set_banner_pattern", "set_banner_details"):
        return bool(function.get("patterns"))
    components = function.get("components")
    if name == "set_components" and isinstance(components, dict):
        return bool(get(components, "banner_patterns")[1])
    return name == "set_nbt" and looks_like_design(str(function.get("tag")))


def _item_of(function: dict[str, DataTree]) -> str:
    """The banner that a function filters by; empty if it names none."""
    test = function.get("item_filter")
    items = test.get("items") if isinstance(test, dict) else None
    items = items if isinstance(items, list) else [items]
    return next((item for item in items if _is_id(item)), "")


def write(banner: Banner) -> str:
    """A loot table that drops the banner or shield (1.20.5+)."""
    functions: list[DataTree] = []
    if banner.layers:
        patterns = {"patterns": names(banner.layers), "append": False}
        functions.append({"function": "minecraft:set_banner_pattern"} | patterns)
    if banner.kind == "shield":
        components = {"components": {"minecraft:base_color": banner.base}}
        functions.append({"function": "minecraft:set_components"} | components)
    item = "minecraft:shield" if banner.kind == "shield" else f"minecraft:{banner.base}_banner"
    entry: dict[str, DataTree] = {"type": "minecraft:item", "name": item}
    entry |= {"functions": functions} if functions else {}
    return json.dumps({"pools": [{"rolls": 1, "entries": [entry]}]})
