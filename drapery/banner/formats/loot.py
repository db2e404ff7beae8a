"""JSON files of data packs: loot tables, item modifiers, recipes, advancements and predicates.

A loot table names an item, and its functions give the design: `set_banner_pattern`,
`set_components`, `set_nbt` (before 1.20.5), and Bedrock's `set_banner_details` and `set_data`. They
stand at the item, its pool or the table, under `functions` or, since 26.3, under `modifier`. A
function with conditions may apply or not, so that an item has a design for each outcome.
Ingredients and predicates only test for a banner, so one without layers is not a design.
"""

import json
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, TypeAlias

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import (
    FoundBanner,
    Path,
    children_of,
    path_text,
    read_shown,
    reader_of,
    shown_block,
)
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
    check_count,
    get,
    is_banner_id,
    is_shield_id,
    names,
    read_layers,
    state_id,
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

MAX_VARIANTS = 256
"""Most designs that an item may have by the outcomes of conditions."""

MAX_STEPS = 200_000
"""Most functions that are applied to the items of one file, each outcome counted."""

_FUNCTION_KEYS = ("functions", "modifier")
"""Keys of the functions that change an item: one, a list, lists in it, or the id of a modifier."""

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

_CONTAINERS = frozenset({"set_contents", "modify_contents"})
"""Functions that hold items of their own, which are found as such."""

_PLACED = frozenset({"output_state", "block_entity_modifier", "output_nbt"})
"""Keys of a rule that places a block."""


def recognises(text: str) -> bool:
    """Whether the text is JSON with keys that data packs have."""
    text = text.lstrip()
    keys = ("pools", "function", "functions", "criteria", "condition", "processors", "result")
    return text[:1] in ("{", "[") and any(f'"{key}"' in text for key in keys)


def matches(tree: DataTree) -> bool:
    """Whether a tree is a JSON file of a data pack."""
    if isinstance(tree, list):
        parts = list(_flat(tree))
        return bool(parts) and all(
            isinstance(node, dict) and ("function" in node or "condition" in node) for node in parts
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


@dataclass(frozen=True)
class _LootItem:
    """An item after some functions, with one outcome of their conditions.

    id: of the item; empty if it is not known. hidden: whether its design may come from the game.
    reference: the item modifier of another file that changes it. doubt: what looks like a design
    in its components but is none. fault: of the function that could not be applied. decided: the
    outcomes of conditions that several functions have.
    """

    id: str
    base: str | None = None
    layers: tuple[Layer, ...] = ()
    hidden: bool = False
    reference: str = ""
    doubt: str = ""
    fault: str = ""
    decided: frozenset[tuple[str, bool]] = frozenset()


_Test: TypeAlias = tuple[str, bool]
"""A condition as a text, and its outcome with which the function applies."""


@dataclass
class _Work:
    """What is known of one file's functions, by their ids as Python objects.

    applied: those that are of an item. tests: their conditions. doubts: see `_LootItem`.
    tags: of functions, parsed. left: how many may still be applied.
    """

    applied: set[int] = field(default_factory=set)
    tests: dict[int, _Test | None] = field(default_factory=dict)
    doubts: dict[int, str] = field(default_factory=dict)
    tags: dict[int, DataTree] = field(default_factory=dict)
    left: int = MAX_STEPS

    def spend(self, steps: int) -> None:
        self.left -= steps
        if self.left < 0:
            raise DesignError(f"over {MAX_STEPS} functions to apply to items: split the file")


def find(tree: DataTree, where: str = "", on_error: OnError | None = None) -> Iterator[FoundBanner]:
    """Every banner of a JSON file of a data pack, with its path.

    on_error: called with the error of one broken banner, after which the search continues;
        without it, the error is raised.
    """
    groups: list[tuple[_Modifier, ...]] = []
    work = _Work()
    nodes = [_Node((None, where), tree)]
    while nodes:
        node = nodes.pop()
        if own := tuple(_modifiers(node)):
            groups.append(own)
            node = _Node(node.path, node.tree, own + node.modifiers, node.tested)
        if isinstance(node.tree, dict):
            yield from _read(partial(_readings, node, work), node.path, on_error)
        if work.left < 0:
            return
        if _reader(node.tree) is None:
            nodes += [*_below(node)][::-1]
    for group in groups:
        yield from _read(partial(_without_item, group, work), group[0].path, on_error)


_Reading = Callable[[], Banner | None]


def _read(
    readings: Callable[[], list[_Reading]], path: Path, on_error: OnError | None
) -> Iterator[FoundBanner]:
    """The banners that the readings of one place give, each once."""
    seen: set[Banner] = set()
    for reading in _tried(readings, on_error) or ():
        banner = _tried(reading, on_error)
        if banner is not None and banner not in seen:
            seen.add(banner)
            yield FoundBanner(banner, path_text(path))


def _tried(read: Callable[[], Any], on_error: OnError | None) -> Any:
    """What a function returns, or None after its error was reported."""
    try:
        return read()
    except DesignError as error:
        if on_error is None:
            raise
        on_error(error)
    return None


def _reader(tree: DataTree) -> Callable[[DataTree, str], Banner] | None:
    """The function that reads an item with an id, as in results and icons since 1.20.5."""
    is_other = not isinstance(tree, dict) or not {"function", "item", "items"}.isdisjoint(tree)
    return None if is_other else reader_of(tree, None)


def _below(node: _Node) -> Iterator[_Node]:
    """The children of a node. Items within a function are not those that it changes."""
    inside = isinstance(node.tree, dict) and "function" in node.tree
    places = isinstance(node.tree, dict) and is_banner_id(state_id(node.tree.get("output_state")))
    for path, child in children_of(node.path, node.tree):
        key = path[1]
        if places and key in _PLACED:
            continue
        modifiers = () if inside or key in _FUNCTION_KEYS else node.modifiers
        yield _Node(path, child, modifiers, node.tested or key in _TESTING)


def _modifiers(node: _Node) -> Iterator[_Modifier]:
    """The functions that a node has, or those that it is."""
    tree, path = node.tree, node.path
    if isinstance(tree, list):
        if matches(tree):
            yield from _functions(tree, path)
    elif isinstance(tree, dict) and "function" in tree:
        if not isinstance(path[1], int):
            yield _Modifier(tree, path)
    elif isinstance(tree, dict):
        for key in _FUNCTION_KEYS:
            if key in tree:
                yield from _functions(tree[key], (path, key))


def _functions(value: DataTree, path: Path) -> Iterator[_Modifier]:
    """The functions of a list, of lists in it, of one function, or of an id or a tag."""
    if isinstance(value, str):
        value = {"function": "reference", "name": value}
    if isinstance(value, list):
        for number, child in enumerate(value):
            yield from _functions(child, (path, number))
    elif isinstance(value, dict):
        yield _Modifier(value, path)


def _flat(tree: list[DataTree]) -> Iterator[DataTree]:
    """The entries of a list and of the lists in it."""
    for node in tree:
        if isinstance(node, list):
            yield from _flat(node)
        else:
            yield node


def _readings(node: _Node, work: _Work) -> list[_Reading]:
    """The functions that read the banners a node names: one for each outcome of conditions."""
    tree, at = node.tree, path_text(node.path)
    name = tree.get("name")
    is_entry = _is_id(name) and not {"type", "weight", *_FUNCTION_KEYS}.isdisjoint(tree)
    if is_entry and _reader(tree) is None:
        items = _variants(_LootItem(name), node.modifiers, work, at)
        return [partial(_finished, item, at) for item in items]
    return [partial(_banner, node)]


def _banner(node: _Node) -> Banner | None:
    """The banner that a node names, or None."""
    tree, at = node.tree, path_text(node.path)
    if reader := _reader(tree):
        if isinstance(tree.get("tag"), str):
            tree = tree | {"tag": _tag(tree["tag"], under(at, "tag"))}
        banner = reader(tree, at)
        return banner if banner.layers or not node.tested else None
    if "output_state" in tree:
        return _placed(tree, at)
    if (key := shown_block(tree)) is not None:
        return read_shown(key, tree, under(at, key))
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
    name = state_id(tree["output_state"])
    if not is_banner_id(name):
        return None
    modifier = tree.get("block_entity_modifier")
    data = modifier.get("data") if isinstance(modifier, dict) else tree.get("output_nbt")
    return banner_from_block_entity(_tag(data, at), at, block=name)


def _variants(
    item: _LootItem, modifiers: tuple[_Modifier, ...], work: _Work, at: str
) -> list[_LootItem]:
    """The item after its functions, once for each outcome of their conditions that matters.

    Raises DesignError for over MAX_VARIANTS.
    """
    work.spend(len(modifiers))
    functions = [function for one in modifiers for function in _with_inner(one.tree)]
    work.applied.update(map(id, functions))
    outcomes = (_test_of(function, work) for function in functions)
    tests = Counter(outcome[0] for outcome in outcomes if outcome)
    items = [item]
    for modifier in modifiers:
        items = _applied(items, modifier, tests, work)
        if len(items) > MAX_VARIANTS:
            raise DesignError(
                f"{at}: over {MAX_VARIANTS} designs by the conditions of its functions;"
                " give fewer of them"
            )
    return items


def _finished(item: _LootItem, at: str) -> Banner | None:
    """The banner that an item is after its functions, or None if the file does not state it."""
    if item.fault:
        raise DesignError(item.fault)
    if not item.layers and item.doubt:
        raise DesignError(item.doubt)
    if not item.layers and item.reference:
        what = "modifiers of the tag" if item.reference.startswith("#") else "modifier"
        raise DesignError(
            f"{at}: its design may be in the item {what} {shown(item.reference)}; give that file"
        )
    if is_shield_id(item.id):
        has_design = item.base is not None or item.layers
        return Banner(item.base or "white", item.layers, kind="shield") if has_design else None
    base = item.base if bare(item.id) in OLD_BANNERS else base_of(item.id)
    if not is_banner_id(item.id) or (item.hidden and (base is None or not item.layers)):
        return None
    # A missing damage value is 0, which is black.
    return Banner(base or "black", item.layers)


def _applied(
    items: list[_LootItem], modifier: _Modifier, tests: Mapping[str, int], work: _Work
) -> list[_LootItem]:
    """The items after a function; where its condition is open, with it and without it."""
    test = _test_of(modifier.tree, work)
    changed: list[_LootItem] = []
    kept: list[_LootItem] = []
    for item in items:
        if test is None:
            changed.append(item)
            continue
        key, outcome = test
        for passed in (True, False):
            if (key, not passed) not in item.decided:
                group = changed if passed == outcome else kept
                decided = item.decided | {(key, passed)} if tests[key] > 1 else item.decided
                group.append(replace(item, decided=decided))
    return _once([*kept, *_changed(changed, modifier, tests, work)])


def _once(items: Iterable[_LootItem]) -> list[_LootItem]:
    return list(dict.fromkeys(items))


_RANDOM = re.compile('"(?:minecraft:)?(?:random_chance|table_bonus)')
"""A condition that may turn out in another way each time."""


def _test_of(function: dict[str, DataTree], work: _Work) -> _Test | None:
    """The condition of a function, None without one."""
    if id(function) not in work.tests:
        work.tests[id(function)] = _read_test(function)
    return work.tests[id(function)]


def _read_test(function: dict[str, DataTree]) -> _Test | None:
    test = function.get("conditions", function.get("condition"))
    tests = test if isinstance(test, list) else [test]
    tests = [one for one in tests if one]
    if not tests:
        return None
    outcome = True
    first = tests[0]
    if (
        len(tests) == 1
        and isinstance(first, dict)
        and bare(str(first.get("condition"))) == "inverted"
    ):
        outcome, tests = False, [first.get("term", first.get("terms"))]
    key = json.dumps(tests, sort_keys=True)
    return key + (str(id(function)) if _RANDOM.search(key) else ""), outcome


_PARTS = {True: ("functions", "modifier", "on_pass"), False: ("on_fail",)}
"""Keys of the functions of which another consists, by whether its filter passes."""
_HOLDERS = frozenset({"sequence", "filtered"})
"""Functions that consist of others."""


def _inner(
    function: dict[str, DataTree], *groups: tuple[str, ...], path: Path = (None, "")
) -> list[_Modifier]:
    """The functions of which a function consists, under the keys of these groups."""
    if _name_of(function) not in _HOLDERS:
        return []
    keys = [key for group in groups for key in group if key in function]
    return [one for key in keys for one in _functions(function[key], (path, key))]


def _changed(
    items: list[_LootItem], modifier: _Modifier, tests: Mapping[str, int], work: _Work
) -> list[_LootItem]:
    """The items after a function that applies."""
    function = modifier.tree
    work.spend(len(items))
    if _name_of(function) not in _HOLDERS:
        return [item if item.fault else _apply(item, modifier, work) for item in items]
    found: list[_LootItem] = []
    for passed, keys in _PARTS.items():
        group = [item for item in items if _passes(function, item) in (passed, None)]
        for one in _inner(function, keys, path=modifier.path):
            group = _applied(group, one, tests, work)
        found += group
    return _once(found)


def _passes(function: dict[str, DataTree], item: _LootItem) -> bool | None:
    """Whether an item passes the filter of a function; None if the file does not tell."""
    test = function.get("item_filter")
    if not isinstance(test, dict) or not item.id:
        return True
    wanted = test.get("items", [])
    names = [str(name) for name in (wanted if isinstance(wanted, list) else [wanted])]
    if not names or bare(item.id) in map(bare, names):
        return None if test.keys() - {"items"} else True
    return None if any(name.startswith("#") for name in names) else False


def _apply(item: _LootItem, modifier: _Modifier, work: _Work) -> _LootItem:
    """The item after a function. One that cannot be read becomes its fault."""
    function, at = modifier.tree, path_text(modifier.path)
    name = _name_of(function)
    if name in _HIDING:
        return replace(item, hidden=True)
    if name == "reference":
        return replace(item, reference=str(function.get("name")))
    try:
        if name in _FUNCTIONS:
            return replace(item, **_FUNCTIONS[name](item, function, at, work))
        if name not in _CONTAINERS:
            return replace(item, doubt=item.doubt or _doubt_of(function, at, work))
    except DesignError as error:
        return replace(item, fault=str(error))
    return item


def _doubt_of(function: dict[str, DataTree], at: str, work: _Work) -> str:
    """What to say of a function that is not known but looks as if it had a design."""
    key = id(function)
    if key not in work.doubts:
        known = looks_like_design(json.dumps(function))
        name = shown(function.get("function"))
        work.doubts[key] = (
            f"{at}: the function {name} cannot be read, but looks as if it had a design; write it"
            " as set_banner_pattern"
            if known
            else ""
        )
    return work.doubts[key]


def _name_of(function: dict[str, DataTree]) -> str:
    name = function.get("function")
    return bare(name) if isinstance(name, str) else ""


_Changes = dict[str, Any]


def _set_banner_pattern(
    item: _LootItem, function: dict[str, DataTree], at: str, work: _Work
) -> _Changes:
    layers = read_layers(function.get("patterns"), under(at, "patterns"))
    layers = (item.layers if function.get("append") else ()) + layers
    check_count(len(layers), under(at, "patterns"))
    return {"layers": layers}


def _set_components(
    item: _LootItem, function: dict[str, DataTree], at: str, work: _Work
) -> _Changes:
    at = under(at, "components")
    components = function.get("components")
    if not isinstance(components, dict):
        raise DesignError(f"{at}: {shown(components)} is not a compound; write {{…}}")
    changes: _Changes = {}
    key, entries = get(components, "banner_patterns")
    if entries is not None:
        changes["layers"] = read_layers(entries, under(at, key))
    key, base = get(components, "base_color")
    if base is not None:
        changes["base"] = dye_name(base, under(at, key))
    if id(function) not in work.doubts:
        work.doubts[id(function)] = _fault_of(partial(check_components, components, at))
    return changes | {"doubt": item.doubt or work.doubts[id(function)]}


def _fault_of(check: Callable[[], None]) -> str:
    try:
        check()
    except DesignError as error:
        return str(error)
    return ""


def _set_nbt(item: _LootItem, function: dict[str, DataTree], at: str, work: _Work) -> _Changes:
    at = under(at, "tag")
    if is_shield_id(item.id) and not _has_block_entity(function.get("tag")):
        return {}
    if id(function) not in work.tags:
        work.tags[id(function)] = _tag(function.get("tag"), at)
    banner = banner_from_tag(item.id, work.tags[id(function)], at)
    return {"base": banner.base, "layers": banner.layers}


def _set_item(item: _LootItem, function: dict[str, DataTree], at: str, work: _Work) -> _Changes:
    return {"id": str(function.get("item", ""))}


def _set_banner_details(
    item: _LootItem, function: dict[str, DataTree], at: str, work: _Work
) -> _Changes:
    if function.get("type") in (1, "illager_captain"):
        return {"base": OMINOUS.base, "layers": OMINOUS.layers}
    base = item.base
    if "base_color" in function:
        base = dye_name(function["base_color"], under(at, "base_color"))
    layers = read_layers(function.get("patterns"), under(at, "patterns"))
    return {"base": base, "layers": layers}


def _set_data(item: _LootItem, function: dict[str, DataTree], at: str, work: _Work) -> _Changes:
    data = function.get("data")
    if not isinstance(data, int):
        return {"hidden": True}
    if bare(item.id) in OLD_BANNERS:
        return {"base": dye_name(data, under(at, "data"), inverted=True)}
    return {}


_FUNCTIONS: dict[str, Callable[[_LootItem, dict[str, DataTree], str, _Work], _Changes]] = {
    "set_banner_details": _set_banner_details,
    "set_banner_pattern": _set_banner_pattern,
    "set_components": _set_components,
    "set_data": _set_data,
    "set_item": _set_item,
    "set_nbt": _set_nbt,
}


def _without_item(group: tuple[_Modifier, ...], work: _Work) -> list[_Reading]:
    """The designs of functions without an item of their own, as item modifiers have them."""
    left = tuple(one for one in group if id(one.tree) not in work.applied)
    if not any(_sets_design(inner) for one in left for inner in _with_inner(one.tree)):
        return []
    at = path_text(group[0].path)
    name = next(filter(None, (_item_of(one.tree) for one in left)), "")
    return [partial(_design_of, item, at) for item in _variants(_LootItem(name), left, work, at)]


def _with_inner(function: dict[str, DataTree]) -> Iterator[dict[str, DataTree]]:
    """A function and those of which it consists."""
    yield function
    for one in _inner(function, *_PARTS.values()):
        yield from _with_inner(one.tree)


def _design_of(item: _LootItem, at: str) -> Banner | None:
    if item.fault:
        raise DesignError(item.fault)
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
