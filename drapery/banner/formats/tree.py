"""Banners from plain trees of dict, list, str and numbers, which SNBT, NBT and JSON become.

Mappings may be any `dict` and sequences any `list`, so nbtlib's tags fit. Every DesignError begins
with the path of its place in the tree, such as `components.banner_patterns[2].color`.
"""

import re
import warnings
from collections.abc import Iterable
from typing import Any, TypeAlias

from drapery.banner.design import MAX_LAYERS, Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.formats.leftovers import check_base, check_components, check_keys, check_literal
from drapery.banner.names import dye_name, is_custom, pattern_id, shown
from drapery.errors import DesignError

DataTree: TypeAlias = Any
"""dict[str, DataTree] | list[DataTree] | str | int | float | None."""

OLD_BANNERS = frozenset({"banner", "standing_banner", "wall_banner"})
"""Ids that do not name the dye: of Java up to 1.12, and of Bedrock."""

OMINOUS = Banner(
    "white",
    tuple(
        Layer(pattern, dye)
        for pattern, dye in (
            ("rhombus", "cyan"),
            ("stripe_bottom", "light_gray"),
            ("stripe_center", "gray"),
            ("border", "light_gray"),
            ("stripe_middle", "black"),
            ("half_horizontal", "light_gray"),
            ("circle", "light_gray"),
            ("border", "black"),
        )
    ),
)
"""The raiders' banner, which is `Type:1` in Bedrock and eight layers in Java."""


def bare(identifier: str) -> str:
    """`minecraft:red_wall_banner[facing=north]` gives `red_wall_banner`."""
    return identifier.partition("[")[0].strip().lower().removeprefix("minecraft:")


def base_of(identifier: str) -> str | None:
    """The dye that a banner's item or block id names, or None: `red_wall_banner` gives `red`."""
    name = bare(identifier)
    if not name.endswith("_banner"):
        return None
    dye = name.removesuffix("_banner").removesuffix("_wall")
    return "light_gray" if dye == "silver" else dye if dye in DYES else None


def is_banner_id(identifier: object) -> bool:
    """Whether this is the id of a banner, as an item, a block or a block entity of any version."""
    return isinstance(identifier, str) and (
        bare(identifier) in OLD_BANNERS or base_of(identifier) is not None
    )


def state_id(state: DataTree) -> str | None:
    """The id of a block, from its state in any form; None for what is not a state.

    Until 26.2 a state is `{Name, Properties}`. Since 26.3 it may also be the id alone, `{"": id}`,
    as a text is kept in a list of compounds, or `{id, properties}`. Schematics write an id with
    its properties, `id[facing=north]`, and structures in SNBT `id{facing:north}`.
    """
    while isinstance(state, dict) and len(state) == 1 and "" in state:
        state = state[""]
    if isinstance(state, dict):
        state = state.get("Name", state.get("id"))
    return re.split(r"[\[{]", state, maxsplit=1)[0] if isinstance(state, str) else None


def is_shield_id(identifier: object) -> bool:
    """Whether this is the shield's id."""
    return isinstance(identifier, str) and bare(identifier) == "shield"


def under(at: str, key: str | int) -> str:
    """The path of a child: `under("a", "b")` is `a.b`, `under("a", 2)` is `a[2]`."""
    if isinstance(key, int):
        return f"{at}[{key}]"
    if len(key) > 40 or not key.isprintable():
        key = shown(key)
    return f"{at}.{key}" if at else key


def get(tree: dict[str, DataTree], *keys: str) -> tuple[str, DataTree]:
    """The first of the keys that the mapping has, with or without `minecraft:`, and its value.

    If it has none of them, the key is the first one, and the value is None.
    """
    for key in keys:
        for spelt in (key, f"minecraft:{key}"):
            if spelt in tree:
                return spelt, tree[spelt]
    return keys[0], None


def read_layers(entries: DataTree, at: str, *, inverted: bool = False) -> tuple[Layer, ...]:
    """Layers from `[{pattern, color}, …]` or `[{Pattern, Color}, …]`; empty for None.

    inverted: colour numbers count from black (Java up to 1.12, and Bedrock).
    """
    if entries is None:
        return ()
    check_literal(entries, at, "list of layers")
    if not isinstance(entries, list):
        raise DesignError(f"{at}: {shown(entries)} is not a list of layers")
    check_count(len(entries), at)
    return tuple(_layer(entry, under(at, n), inverted) for n, entry in enumerate(entries))


def check_count(count: int, at: str) -> None:
    """Raise DesignError if these are more layers than a banner can have."""
    if count > MAX_LAYERS:
        raise DesignError(
            f"{at}: {count} layers, but a banner has at most {MAX_LAYERS}: leave some out"
        )


def _layer(entry: DataTree, at: str, inverted: bool) -> Layer:
    check_literal(entry, at, "layer")
    if not isinstance(entry, dict):
        raise DesignError(f"{at}: {shown(entry)} is not a layer: write {{pattern:…, color:…}}")
    pattern = _present(entry, at, "pattern", "Pattern")
    colour = _present(entry, at, "color", "Color", "colour")
    check_literal(pattern[0], pattern[1], "pattern")
    return Layer(_pattern(*pattern), _dye(colour[0], colour[1], inverted=inverted))


def _dye(value: DataTree, at: str, *, inverted: bool = False) -> str:
    check_literal(value, at, "dye")
    return dye_name(value, at, inverted=inverted)


def _present(entry: dict[str, DataTree], at: str, *keys: str) -> tuple[DataTree, str]:
    key, value = get(entry, *keys)
    if value is None:
        raise DesignError(f"{at}: the layer has no {keys[0]}: write {{pattern:…, color:…}}")
    return value, under(at, key)


def _pattern(value: DataTree, at: str) -> str:
    """A pattern by name, or defined inline: `{asset_id:"ns:x", translation_key:"…"}`."""
    if not isinstance(value, dict):
        return pattern_id(value, at)
    key, asset = get(value, "asset_id")
    if not isinstance(asset, str):
        raise DesignError(f"{at}: an inline pattern needs its asset_id, such as 'ns:name'")
    return asset if is_custom(asset) else pattern_id(asset, under(at, key))


def banner_from_item(item: DataTree, at: str = "") -> Banner:
    """A banner or shield from an item object of any version.

    `{id, count, components}` (1.20.5+), `{id, Count, tag}` (1.13), with `Damage` (to 1.12), or
    Bedrock's `{Name, Damage, Count, tag}`. Icons may have `item` for `id`.
    """
    if not isinstance(item, dict):
        raise DesignError(f"{at or 'item'}: {shown(item)} is not an item: write {{id:…, …}}")
    _, identifier = get(item, "id", "Name", "item")
    if not is_banner_id(identifier) and not is_shield_id(identifier):
        check_literal(identifier, under(at, "id"), "base dye")
        raise DesignError(
            f"{under(at, 'id')}: {shown(identifier)} is neither a banner nor a shield;"
            " give an id such as 'minecraft:red_banner'"
        )
    key, components = get(item, "components")
    if components is not None:
        banner = banner_from_components(identifier, components, under(at, key))
    else:
        tag, damage = item.get("tag"), item.get("Damage")
        banner = banner_from_tag(identifier, tag, under(at, "tag"), data=damage)
    if not banner.layers:
        check_keys(item, at, ("components", "tag"))
    return banner


def banner_from_components(item_id: str, components: DataTree, at: str = "") -> Banner:
    """A banner or shield from the item's id and its component mapping (1.20.5+)."""
    components = _mapping(components, at)
    key, entries = get(components, "banner_patterns")
    layers = read_layers(entries, under(at, key))
    if not layers:
        check_components(components, at)
    if is_shield_id(item_id):
        key, base = get(components, "base_color")
        if base is None:
            check_base(components, at)
        return _shield(None if base is None else _dye(base, under(at, key)), layers, at)
    return Banner(_known_base(item_id, at), layers)


def banner_from_tag(item_id: str, tag: DataTree, at: str = "", *, data: DataTree = None) -> Banner:
    """A banner or shield from the item's id and its tag (before 1.20.5, and Bedrock).

    data: the item's damage value, which is the dye (15 - its number) up to 1.12 and on Bedrock.
    """
    tag = _mapping(tag, at)
    key, entity = get(tag, "BlockEntityTag")
    if entity is None:
        key, entity = "", tag
    inner = under(at, key) if key else at
    entity = _mapping(entity, inner)
    if not get(entity, "patterns", "Patterns")[1]:
        check_keys(tag, at, ("BlockEntityTag",))
    if is_shield_id(item_id):
        return _shield_from_tag(entity, inner, inverted=data is not None)
    if base_of(item_id) is None and "Base" not in entity:
        check_base(entity, inner)
        # A missing damage value is 0, which is black.
        entity = entity | {"Base": 0 if data is None else data}
    banner = banner_from_block_entity(entity, inner, block=item_id)
    if base_of(item_id) is None and isinstance(data, int) and data in range(16):
        _warn_of_dyes(banner.base, _dye(data, at, inverted=True), at)
    return banner


def _warn_of_dyes(base: str, damage: str, at: str) -> None:
    """Warn of an old item that has one dye as its `Base` and another one as its damage value."""
    if base != damage:
        warnings.warn(
            f"{at or 'item'}: the base is {base}, by its Base, as in Java 1.8 to 1.10;"
            f" 1.11 and 1.12 show {damage}, by its damage value",
            stacklevel=2,
        )


def _shield_from_tag(entity: dict[str, DataTree], at: str, *, inverted: bool) -> Banner:
    layers = read_layers(entity.get("Patterns"), under(at, "Patterns"), inverted=inverted)
    if not layers:
        check_keys(entity, at)
    base = entity.get("Base")
    if base is None:
        check_base(entity, at)
    dye = None if base is None else _dye(base, under(at, "Base"), inverted=inverted)
    return _shield(dye, layers, at)


def _shield(base: str | None, layers: tuple[Layer, ...], at: str) -> Banner:
    if base is None and not layers:
        raise DesignError(
            f"{at or 'shield'}: a plain shield has no design: give base_color or banner_patterns"
        )
    return Banner(base or "white", layers, kind="shield")


def banner_from_block_entity(entity: DataTree, at: str = "", *, block: str | None = None) -> Banner:
    """A banner from its block entity: `patterns` (1.20.5+) or `Patterns`, and `Base` if it is old.

    block: the id of its block, which names the base dye since 1.13. Without such an id, the entity
        must have `Base`, and its colour numbers count from black (Java up to 1.12, and Bedrock),
        or be Bedrock's ominous banner (`Type:1`).
    """
    entity = _mapping(entity, at)
    dye = None if block is None else base_of(block)
    if dye is None and entity.get("Type") == 1:
        return OMINOUS
    key, entries = get(entity, "patterns", "Patterns")
    if not entries:
        check_keys(entity, at)
    if dye is not None:
        return Banner(dye, read_layers(entries, under(at, key)))
    if "Base" not in entity:
        raise DesignError(
            f"{at or 'block entity'}: the block's id, which names the base dye, is missing:"
            " write it first, as in minecraft:red_banner{…}"
        )
    base = _dye(entity["Base"], under(at, "Base"), inverted=True)
    return Banner(base, read_layers(entries, under(at, key), inverted=True))


def _known_base(item_id: str, at: str) -> str:
    dye = base_of(item_id)
    check_literal(item_id, at or "item", "base dye")
    if dye is None:
        raise DesignError(
            f"{at or 'item'}: {shown(item_id)} does not name the base dye;"
            " give an id such as 'minecraft:red_banner'"
        )
    return dye


def _mapping(tree: DataTree, at: str) -> dict[str, DataTree]:
    if tree is None:
        return {}
    if not isinstance(tree, dict):
        raise DesignError(f"{at or 'the text'}: {shown(tree)} is not a compound; write {{…}}")
    return tree


def names(layers: Iterable[Layer]) -> list[dict[str, str]]:
    """Layers as the game's components hold them: `[{"pattern": …, "color": …}, …]`."""
    return [{"pattern": layer.pattern, "color": layer.dye} for layer in layers]
