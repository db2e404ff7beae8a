"""Items in the YAML of servers' plugins: finds them, and reads their lists of layers."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.tree import (
    DataTree,
    bare,
    base_of,
    check_count,
    is_banner_id,
    is_shield_id,
    under,
)
from drapery.banner.names import bukkit_pattern, dye_name, pattern_id, shown
from drapery.errors import DesignError, OptionError

ReadItem = Callable[[dict[str, DataTree], str], Banner | None]
"""Reads a mapping and its place as a banner; gives None if it is another thing."""


@dataclass(frozen=True)
class LayerLayout:
    """How a plugin writes a banner: an item's name, and a list of texts for its layers.

    plugin: its name in messages. items, layers, bases: the keys of the item's name, of the
    list and of a shield's base dye; a key with a dot leads into an inner mapping.
    separator: what stands between pattern and dye. dye_first: whether the dye is first.
    bukkit: whether patterns have Bukkit's names of before 1.21.
    """

    plugin: str
    items: tuple[str, ...]
    layers: tuple[str, ...]
    separator: str
    dye_first: bool
    bases: tuple[str, ...] = ()
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
    """Every banner that `read` knows in a tree, in the order of the text.

    What repeats by an alias is found where it is defined and wherever it is repeated.
    """
    return [FoundBanner(banner, at) for at, banner in _walk(tree, "", read)]


def _walk(tree: DataTree, at: str, read: ReadItem) -> Iterator[tuple[str, Banner]]:
    if isinstance(tree, dict):
        banner = read(tree, at)
        if banner is not None:
            yield at, banner
            return
        for key, child in tree.items():
            yield from _walk(child, under(at, str(key)), read)
    elif isinstance(tree, list):
        for number, child in enumerate(tree):
            yield from _walk(child, under(at, number), read)


def read_list(text: str, layout: LayerLayout) -> list[FoundBanner]:
    """All banners of a plugin's YAML. Raises DesignError with the place, and if there is none."""
    found = find(load(text), lambda node, at: _item(node, at, layout))
    if not found:
        raise DesignError(
            f"no banner in the YAML of {layout.plugin}: an item needs"
            f" '{layout.items[0]}: WHITE_BANNER' and the list '{layout.layers[0]}'"
        )
    return found


def _item(node: dict[str, DataTree], at: str, layout: LayerLayout) -> Banner | None:
    key, entries = _get(node, layout.layers)
    item_key, item = _get(node, layout.items)
    if entries is None and not (isinstance(item, str) and is_banner_id(_material(item))):
        return None
    place = under(at, key)
    if not isinstance(item, str):
        raise DesignError(
            f"{place}: the item is missing: write '{layout.items[0]}: WHITE_BANNER' beside the list"
        )
    base = kind_and_base(item, under(at, item_key))
    if base is None:
        raise DesignError(
            f"{under(at, item_key)}: {shown(item)} is neither a banner nor a shield;"
            " write it as WHITE_BANNER"
        )
    kind, dye = base
    base_key, given = _get(node, layout.bases)
    if given is not None and (kind == "shield" or dye is None):
        dye = dye_name(given, under(at, base_key))
    if dye is None and kind == "banner":
        raise DesignError(f"{under(at, item_key)}: the item names no dye: write it as WHITE_BANNER")
    return Banner(dye or "white", _layers(entries, place, layout), kind)


def kind_and_base(item: str, at: str) -> tuple[Literal["banner", "shield"], str | None] | None:
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
        names = {str(name).lower(): name for name in node}
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


def _layers(entries: DataTree, at: str, layout: LayerLayout) -> tuple[Layer, ...]:
    if entries is None:
        return ()
    if isinstance(entries, dict):
        entries = [_joined(str(name), str(dye), layout) for name, dye in entries.items()]
    if not isinstance(entries, list):
        raise DesignError(f"{at}: {shown(entries)} is not a list of layers")
    check_count(len(entries), at)
    return tuple(_layer(entry, under(at, n), layout) for n, entry in enumerate(entries))


def _joined(pattern: str, dye: str, layout: LayerLayout) -> str:
    return layout.separator.join((dye, pattern) if layout.dye_first else (pattern, dye))


def _layer(entry: DataTree, at: str, layout: LayerLayout) -> Layer:
    parts = str(entry).split(layout.separator) if isinstance(entry, str) else []
    if len(parts) != 2:
        raise DesignError(f"{at}: {shown(entry)} is not a layer: write '{sample(layout)}'")
    dye, pattern = parts if layout.dye_first else reversed(parts)
    return Layer(
        pattern_id(pattern.strip(), at, bukkit=layout.bukkit and pattern.strip().isupper()),
        dye_name(dye.strip(), at),
    )


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
