"""Items in the YAML of servers' plugins: finds them, and reads their lists of layers.

Plugins differ in their keys and in how deep the list of layers lies. So the layers of an item are
what looks like layers, wherever it is below the item; two such lists are refused.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple

from drapery.banner.design import Banner
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.leftovers import looks_like_design
from drapery.banner.formats.tree import DataTree, bare, base_of, is_banner_id, is_shield_id, under
from drapery.banner.formats.yaml_layers import (
    holds_words,
    looks_like_layers,
    names_layers,
    read_layers,
)
from drapery.banner.names import bukkit_pattern, dye_name, is_dye, shown
from drapery.errors import DesignError, OptionError


class Item(NamedTuple):
    """A banner in YAML. assumed: whether no key tells its base dye, so that the usual one is."""

    banner: Banner
    assumed: bool = False


ReadItem = Callable[[dict[str, DataTree], str], Item | None]
"""Reads a mapping and its place as a banner; gives None if it is another thing."""

_DYE_KEY = re.compile(r"^(?:\w*base|banner|shield)?[-_ .]?(?:colou?r|dye|base)$", re.IGNORECASE)


@dataclass(frozen=True)
class LayerLayout:
    """How a plugin writes a banner: an item's name, and a list of texts for its layers.

    plugin: its name in messages. items, layers: the keys of the item's name and of the list; a
    key with a dot leads into an inner mapping. The rest is how layers are written, and any
    other way is read too: separator: what stands between pattern and dye. dye_first: whether the
    dye is first. bukkit: whether patterns have Bukkit's names of before 1.21.
    """

    plugin: str
    items: tuple[str, ...]
    layers: tuple[str, ...]
    separator: str
    dye_first: bool
    bukkit: bool = True


def has_key(text: str, *keys: str) -> bool:
    """Whether one of the keys begins a line of a text that may be YAML."""
    names = [key.rpartition(".")[2] for key in keys]
    if not any(f"{name}:" in text or f'{name}":' in text for name in names):
        return False
    lines = (line.lstrip(" -\t\"'") for line in text.split("\n"))
    starts = tuple(f"{name}{quote}:" for name in names for quote in ("", '"', "'"))
    return any(line.startswith(starts) for line in lines)


def load(text: str) -> DataTree:
    """The tree of a YAML text. Raises DesignError with line and column."""
    from drapery.yaml_text import load_yaml

    try:
        return load_yaml(text, "the text")
    except OptionError as error:
        raise DesignError(str(error)) from None


def find(tree: DataTree, read: ReadItem) -> list[FoundBanner]:
    """Every banner that `read` knows in a tree, also those within an item, in the text's order.

    What repeats by an alias is found where it is defined and wherever it is repeated.
    Raises DesignError for a base dye or layers that stand beside no item, if an item lacks them.
    """
    loose = _Loose([], [])
    found = list(_walk(tree, "", read, loose, False))
    wanting = loose.bases and any(item.assumed for _, item in found)
    plain = loose.layers and not all(item.banner.layers for _, item in found)
    if wanting or plain:
        what, places = ("base stands", loose.bases) if wanting else ("list stands", loose.layers)
        raise DesignError(f"{places[0]}: this {what} beside no item; write it below the item")
    return [FoundBanner(item.banner, at) for at, item in found]


class _Loose(NamedTuple):
    """The places of base dyes and of layers that stand beside no item."""

    bases: list[str]
    layers: list[str]

    def add(self, tree: dict[str, DataTree], at: str) -> None:
        for key, value in tree.items():
            if _is_base(key, value) or key == "damage":
                self.bases.append(under(at, key))
            elif names_layers(key) and (looks_like_layers(value, True) or _is_text(key, value)):
                self.layers.append(under(at, key))


def _is_text(key: str | int, value: DataTree) -> bool:
    """Whether a value is a design in a text of SNBT or JSON."""
    return isinstance(value, str) and not holds_words(key) and looks_like_design(f"{key}={value}")


def _walk(
    tree: DataTree, at: str, read: ReadItem, loose: _Loose, inside: bool
) -> Iterator[tuple[str, Item]]:
    if isinstance(tree, dict):
        item = read(tree, at) if item_key(tree) or not inside else None
        if item is not None:
            yield at, item
            inside = True
        elif not inside:
            loose.add(tree, at)
        for key, child in tree.items():
            yield from _walk(child, under(at, key), read, loose, inside)
    elif isinstance(tree, list):
        for number, child in enumerate(tree):
            yield from _walk(child, under(at, number), read, loose, inside)


def _is_base(key: str, value: DataTree) -> bool:
    """Whether a key tells a base dye."""
    if not _DYE_KEY.match(key):
        return False
    return "base" in key.lower() or not isinstance(value, str) or is_dye(value)


def read_list(text: str, layout: LayerLayout) -> list[FoundBanner]:
    """All banners of a plugin's YAML. Raises DesignError with the place, and if there is none."""
    found = find(load(text), lambda node, at: _item(node, at, layout))
    if not found:
        raise DesignError(
            f"no banner in the YAML of {layout.plugin}: an item needs"
            f" '{layout.items[0]}: WHITE_BANNER' and the list '{layout.layers[0]}'"
        )
    return found


def _item(node: dict[str, DataTree], at: str, layout: LayerLayout) -> Item | None:
    """The banner of a mapping that names one, or that has layers beside a base dye."""
    key, item = _get(node, layout.items)
    layers_key, entries = _get(node, layout.layers)
    beside = entries is not None or any(
        looks_like_layers(value, True) for name, value in node.items() if names_layers(name)
    )
    named = kind_and_base(item) if isinstance(item, str) else None
    if named is None and (other := item_key(node)) and (beside or layers_below(node, at)):
        key, item, named = other, node[other], kind_and_base(node[other])
    if named is None and not beside:
        return None
    if named is None and isinstance(item, str):
        raise DesignError(
            f"{under(at, key)}: {shown(item)} is neither a banner nor a shield;"
            " write it as WHITE_BANNER"
        )
    place, entries = layers_below(node, at) or (under(at, layers_key), entries)
    kind, dye = named or ("banner", None)
    dye = dye or base_below(node, at)
    if named is None and (dye is None or _has_item_below(node, at)):
        raise DesignError(
            f"{place}: the item is missing: write '{layout.items[0]}: WHITE_BANNER' beside the list"
        )
    if dye is None and kind == "banner":
        raise DesignError(f"{under(at, key)}: the item names no dye: write it as WHITE_BANNER")
    layers = read_layers(entries, place, sample(layout))
    if dye is None and not layers:
        return None  # a plain shield
    return Item(Banner(dye or "white", layers, kind), assumed=dye is None)


def _has_item_below(node: dict[str, DataTree], at: str) -> bool:
    return any(
        item_key(value if isinstance(value, dict) else {str(key): value})
        for _, key, value, _ in _below(node, at)
    )


def item_key(node: dict[str, DataTree]) -> str | None:
    """The first key of a mapping whose value names a banner or a shield, or None."""
    for key, value in node.items():
        if key == "meta-type" or holds_words(key):
            continue
        if isinstance(value, str) and len(value) < 60 and kind_and_base(value):
            return key
    return None


def layers_below(node: dict[str, DataTree], at: str) -> tuple[str, DataTree] | None:
    """The list of layers below an item, and its place, or None.

    Raises DesignError if there are two, or a design in a text that is no list.
    """
    found: tuple[str, DataTree] | None = None
    text = ""
    for place, key, value, named in _below(node, at):
        if found and _is_within(place, found[0]):
            continue
        if looks_like_layers(value, named):
            if found:
                raise DesignError(
                    f"{place}: the item has layers at {found[0]} too; keep one of the lists"
                )
            found = place, value
        elif not text and _is_text(key, value):
            text = place
    if text and not found:
        raise DesignError(f"{text}: this design cannot be read here; write it as a list")
    return found


def base_below(node: dict[str, DataTree], at: str) -> str | None:
    """The base dye that a key below an item names, such as `base-color`, or None.

    Raises DesignError for what is not a dye, and for two dyes.
    """
    layers = layers_below(node, at)
    found: dict[str, str] = {}
    for place, key, value, _ in _below(node, at):
        in_layers = layers and (place == layers[0] or _is_within(place, layers[0]))
        if isinstance(key, str) and _is_base(key, value) and not in_layers:
            found[place] = dye_name(value, place)
    if len(set(found.values())) > 1:
        first, second = list(found)[:2]
        raise DesignError(f"{second}: the item has a base dye at {first} too; keep one of them")
    return next(iter(found.values()), None)


def damage_below(node: dict[str, DataTree], at: str) -> tuple[str, DataTree] | None:
    """The damage value below an item, and its place, or None."""
    values = ((place, value) for place, key, value, _ in _below(node, at) if key == "damage")
    return next(values, None)


def _below(node: DataTree, at: str) -> Iterator[tuple[str, str | int, DataTree, bool]]:
    """All that lies below an item, but not in items within it: place, key, value, and whether a
    key on the way to it is called as those of layers are."""
    nodes: list[tuple[str, DataTree, bool]] = [(at, node, False)]
    while nodes:
        place, tree, named = nodes.pop()
        keyed = tree.items() if isinstance(tree, dict) else enumerate(tree)
        inner = []
        for key, value in keyed:
            if holds_words(key):
                continue
            path, known = under(place, key), named or names_layers(key)
            yield path, key, value, known
            if isinstance(value, list) or (isinstance(value, dict) and not item_key(value)):
                inner.append((path, value, known))
        nodes += reversed(inner)


def _is_within(place: str, outer: str) -> bool:
    return place != outer and place.startswith(outer) and place[len(outer)] in ".["


def kind_and_base(item: str) -> tuple[Literal["banner", "shield"], str | None] | None:
    """The kind and the base dye, if any, that an item's name tells; None for other items."""
    name = _material(item)
    if is_shield_id(name):
        return "shield", None
    return ("banner", base_of(name)) if is_banner_id(name) else None


def _material(item: str) -> str:
    return bare(item.strip()).partition(" ")[0]


def _get(node: dict[str, DataTree], keys: tuple[str, ...]) -> tuple[str, DataTree]:
    """The first of the keys that the mapping has, in any case, and its value."""
    for key in keys:
        outer, _, inner = key.partition(".")
        names = {name.lower(): name for name in node}
        if outer.lower() not in names:
            continue
        name = names[outer.lower()]
        value = node[name]
        if inner and isinstance(value, dict):
            inner_key, found = _get(value, (inner,))
            if found is not None:
                return f"{name}.{inner_key}", found
        elif not inner:
            return str(name), value
    return (keys or ("",))[0], None


def _joined(pattern: str, dye: str, layout: LayerLayout) -> str:
    return layout.separator.join((dye, pattern) if layout.dye_first else (pattern, dye))


def sample(layout: LayerLayout) -> str:
    """A layer as the plugin writes it."""
    return _joined("CREEPER", "RED", layout)


def layer_texts(banner: Banner, layout: LayerLayout) -> list[str]:
    """The layers as the plugin writes them. Raises DesignError for patterns of data packs."""
    texts = []
    for number, layer in enumerate(banner.layers, 1):
        name = bukkit_pattern(layer.pattern, f"layer {number}")
        if layout.bukkit:
            texts.append(_joined(name, layer.dye.upper(), layout))
        else:
            texts.append(_joined(layer.pattern, layer.dye, layout))
    return texts


def material(banner: Banner) -> str:
    """The name of the banner's item on a server: `RED_BANNER`, `SHIELD`."""
    return "SHIELD" if banner.kind == "shield" else f"{banner.base.upper()}_BANNER"


def write_yaml(tree: dict[str, DataTree]) -> str:
    """The YAML of a small tree of mappings, lists, texts and numbers."""
    import yaml

    text: str = yaml.safe_dump(tree, sort_keys=False, allow_unicode=True, width=100_000)
    return text.rstrip("\n")
