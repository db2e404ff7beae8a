"""Bukkit's ItemStack in YAML, as plugins save it: `type: RED_BANNER` and `meta-type: BANNER`.

Paper since 1.21.5 writes `id` and `components` instead; each component's value is a text in SNBT.
"""

from drapery.banner.design import Banner
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.item import item_object
from drapery.banner.formats.leftovers import check_keys
from drapery.banner.formats.snbt import parse_snbt, write_snbt
from drapery.banner.formats.tree import (
    DataTree,
    banner_from_components,
    is_banner_id,
    is_shield_id,
    under,
)
from drapery.banner.formats.yaml_items import (
    Item,
    base_below,
    damage_below,
    find,
    has_key,
    kind_and_base,
    layers_below,
    load,
    material,
    write_yaml,
)
from drapery.banner.formats.yaml_layers import read_layers
from drapery.banner.names import dye_name
from drapery.banner.patterns import PATTERNS
from drapery.errors import DesignError

NAME = "bukkit"
TITLE = "ItemStack of Bukkit, Spigot or Paper in YAML"
EXAMPLE = """banner:
  ==: org.bukkit.inventory.ItemStack
  v: 3700
  type: RED_BANNER
  meta:
    ==: ItemMeta
    meta-type: BANNER
    patterns:
    - ==: Pattern
      color: LIME
      pattern: cre"""
SOURCE = "https://github.com/PaperMC/Paper/pull/12363"
ITEM = "org.bukkit.inventory.ItemStack"
_VERSION = 3700
"""The data version of 1.20.4, the last with codes of patterns."""
_SAMPLE = "color: RED, pattern: cre"
_NEW_VERSION = 4325
"""The data version of 1.21.5, the first of the form with components."""


def recognises(text: str) -> bool:
    """Whether the text has the keys of an ItemStack, or of its meta."""
    return ITEM in text or has_key(text, "meta-type")


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    found = find(load(text), _item)
    if not found:
        raise DesignError("no banner in the ItemStacks: one needs 'type: RED_BANNER'")
    return found


def _item(node: dict[str, DataTree], at: str) -> Item | None:
    is_stack = node.get("==") == ITEM
    identifier, name = node.get("id"), node.get("type")
    if is_banner_id(identifier) or is_shield_id(identifier):
        if is_stack or "components" in node:
            return _from_components(node, str(identifier), at)
    elif isinstance(name, str) and (is_stack or "meta" in node):
        return _from_type(node, name, at)
    elif node.get("meta-type") == "BANNER":
        place = under(at, "meta-type")
        raise DesignError(f"{place}: the item is missing: write 'type: RED_BANNER' above 'meta'")
    return None


def _from_components(node: dict[str, DataTree], identifier: str, at: str) -> Item | None:
    place, components = under(at, "components"), node.get("components")
    tree = _snbt(components, place) if isinstance(components, str) else components
    if isinstance(tree, dict):
        tree = {key: _snbt(value, under(place, str(key))) for key, value in tree.items()}
    if is_shield_id(identifier) and not isinstance(tree, dict):
        return None
    banner = banner_from_components(identifier, tree, place)
    if not banner.layers:
        check_keys(node, at, ("components",))
    return Item(banner)


def _snbt(value: DataTree, at: str) -> DataTree:
    if not isinstance(value, str):
        return value
    try:
        return parse_snbt(value)
    except DesignError as error:
        raise DesignError(f"{at}: {error}") from None


def _from_type(node: dict[str, DataTree], name: str, at: str) -> Item | None:
    item = kind_and_base(name)
    if item is None:
        return None
    kind, dye = item
    place, entries = layers_below(node, at) or (under(at, "meta.patterns"), _patterns(node))
    layers = read_layers(entries, place, _SAMPLE)
    dye = dye or base_below(node, at)
    damage = damage_below(node, at)
    assumed = dye is None and (kind == "shield" or damage is None)
    if dye is None and kind == "banner":
        where, number = damage or (at, 0)
        dye = dye_name(number, where, inverted=True)
    if kind == "shield" and dye is None and not layers:
        meta = node.get("meta")
        if isinstance(meta, dict) and "internal" in meta:
            raise DesignError(
                f"{under(at, 'meta')}: the shield's design is packed in 'internal';"
                " hold the shield and paste what /data get says"
            )
        return None
    return Item(Banner(dye or "white", layers, kind), assumed)


def _patterns(node: dict[str, DataTree]) -> DataTree:
    meta = node.get("meta")
    return meta.get("patterns") if isinstance(meta, dict) else None


def write(banner: Banner) -> str:
    """The ItemStack, as every server since 1.8 reads it if it can hold the banner so.

    Shields and patterns that came after 1.20.4 are written with components, for Paper since 1.21.5.
    """
    patterns = [PATTERNS.get(layer.pattern) for layer in banner.layers]
    if banner.kind == "banner" and all(pattern and pattern.code for pattern in patterns):
        return write_yaml({"banner": _stack_with_meta(banner)})
    item = item_object(banner)
    components = {key: write_snbt(value) for key, value in item.get("components", {}).items()}
    head = {"==": ITEM, "DataVersion": _NEW_VERSION, "id": item["id"], "count": 1}
    return write_yaml({"banner": head | {"components": components, "schema_version": 1}})


def _stack_with_meta(banner: Banner) -> dict[str, DataTree]:
    stack: dict[str, DataTree] = {"==": ITEM, "v": _VERSION, "type": material(banner)}
    if banner.layers:
        layers = [
            {"==": "Pattern", "color": layer.dye.upper(), "pattern": PATTERNS[layer.pattern].code}
            for layer in banner.layers
        ]
        stack["meta"] = {"==": "ItemMeta", "meta-type": "BANNER", "patterns": layers}
    return stack
