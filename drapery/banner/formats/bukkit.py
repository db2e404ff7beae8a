"""Bukkit's ItemStack in YAML, as plugins save it: `type: RED_BANNER` and `meta-type: BANNER`.

Paper since 1.21.5 writes `id` and `components` instead; each component's value is a text in SNBT.
"""

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.item import item_object
from drapery.banner.formats.snbt import parse_snbt, write_snbt
from drapery.banner.formats.tree import (
    DataTree,
    banner_from_components,
    check_count,
    is_banner_id,
    is_shield_id,
    under,
)
from drapery.banner.formats.yaml_items import (
    find,
    has_key,
    kind_and_base,
    load,
    material,
    write_yaml,
)
from drapery.banner.names import dye_name, pattern_id, shown
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


def _item(node: dict[str, DataTree], at: str) -> Banner | None:
    is_stack = node.get("==") == ITEM
    identifier, name = node.get("id"), node.get("type")
    if is_banner_id(identifier) or is_shield_id(identifier):
        if is_stack or "components" in node:
            return _from_components(str(identifier), node.get("components"), at)
    elif isinstance(name, str) and (is_stack or "meta" in node):
        return _from_type(node, name, at)
    elif node.get("meta-type") == "BANNER":
        place = under(at, "meta-type")
        raise DesignError(f"{place}: the item is missing: write 'type: RED_BANNER' above 'meta'")
    return None


def _from_components(identifier: str, components: DataTree, at: str) -> Banner | None:
    at = under(at, "components")
    tree = _snbt(components, at) if isinstance(components, str) else components
    if isinstance(tree, dict):
        tree = {key: _snbt(value, under(at, str(key))) for key, value in tree.items()}
    if is_shield_id(identifier) and not isinstance(tree, dict):
        return None
    return banner_from_components(identifier, tree, at)


def _snbt(value: DataTree, at: str) -> DataTree:
    if not isinstance(value, str):
        return value
    try:
        return parse_snbt(value)
    except DesignError as error:
        raise DesignError(f"{at}: {error}") from None


def _from_type(node: dict[str, DataTree], name: str, at: str) -> Banner | None:
    item = kind_and_base(name, under(at, "type"))
    if item is None:
        return None
    kind, dye = item
    meta = node.get("meta")
    meta = meta if isinstance(meta, dict) else {}
    base, damage = meta.get("base-color"), node.get("damage")
    where = under(at, "meta")
    if dye is None and base is not None:
        dye = dye_name(base, under(where, "base-color"))
    elif dye is None and kind == "banner":
        dye = dye_name(damage or 0, under(at, "damage"), inverted=True)
    layers = _layers(meta.get("patterns"), under(where, "patterns"))
    if kind == "shield" and dye is None and not layers:
        if "internal" in meta:
            raise DesignError(
                f"{where}: the shield's design is packed in 'internal';"
                " hold the shield and paste what /data get says"
            )
        return None
    return Banner(dye or "white", layers, kind)


def _layers(entries: DataTree, at: str) -> tuple[Layer, ...]:
    if entries is None:
        return ()
    if not isinstance(entries, list):
        raise DesignError(f"{at}: {shown(entries)} is not a list of layers")
    check_count(len(entries), at)
    layers = []
    for number, entry in enumerate(entries):
        place = under(at, number)
        if not isinstance(entry, dict):
            raise DesignError(f"{place}: {shown(entry)} is not a layer: write color and pattern")
        pattern = pattern_id(entry.get("pattern"), under(place, "pattern"), bukkit=True)
        layers.append(Layer(pattern, dye_name(entry.get("color"), under(place, "color"))))
    return tuple(layers)


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
