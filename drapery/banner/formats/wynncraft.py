"""Wynncraft's guild JSON: `{"base": "BLACK", "layers": [{"colour": "RED", "pattern": "CROSS"}]}`.

Patterns and dyes have Bukkit's names. The design may also be under `banner` in the guild's whole
answer. `tier` and `structure` describe the guild's tower and are ignored.
"""

import json

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.leftovers import check_keys
from drapery.banner.formats.tree import DataTree, check_count, under
from drapery.banner.names import bukkit_pattern, dye_name, pattern_id, shown
from drapery.errors import DesignError

NAME = "wynncraft"
TITLE = "Wynncraft's guild JSON"
EXAMPLE = (
    '{"base": "BLACK", "tier": 2, "structure": "tier2",'
    ' "layers": [{"colour": "RED", "pattern": "DIAGONAL_RIGHT"}]}'
)
SOURCE = "https://docs.wynncraft.com/"


def recognises(text: str) -> bool:
    """Whether the text is JSON with keys that only this form has."""
    return text.lstrip().startswith("{") and any(k in text for k in ('"colour"', '"tier"'))


def matches(tree: DataTree) -> bool:
    """Whether a tree is of this form, alone or in a guild's answer."""
    if not isinstance(tree, dict):
        return False
    inner = tree.get("banner")
    return _is_design(inner) or _is_design(tree)


def may_be(tree: DataTree) -> bool:
    """Whether a tree could be of this form, if the caller knows that it is."""
    if not isinstance(tree, dict) or "id" in tree:
        return False
    return "base" in tree or isinstance(tree.get("banner"), dict)


def _is_design(tree: DataTree) -> bool:
    if not isinstance(tree, dict) or "base" not in tree:
        return False
    layers = tree.get("layers")
    entries = layers if isinstance(layers, list) else []
    has_colours = any(isinstance(entry, dict) and "colour" in entry for entry in entries)
    return has_colours or "tier" in tree or "structure" in tree


def from_tree(tree: dict[str, DataTree], at: str = "") -> Banner:
    """The banner of the JSON's tree. Raises DesignError naming the place."""
    if "base" not in tree and isinstance(tree.get("banner"), dict):
        tree, at = tree["banner"], under(at, "banner")
    layers = tree.get("layers", [])
    if not isinstance(layers, list):
        raise DesignError(f"{under(at, 'layers')}: {shown(layers)} is not a list of layers")
    check_count(len(layers), under(at, "layers"))
    if not layers:
        check_keys(tree, at, ("layers",))
    read = tuple(_layer(x, under(under(at, "layers"), n)) for n, x in enumerate(layers))
    return Banner(dye_name(tree.get("base"), under(at, "base")), read)


def _layer(entry: DataTree, at: str) -> Layer:
    if not isinstance(entry, dict):
        raise DesignError(f"{at}: {shown(entry)} is not a layer: write {{colour:…, pattern:…}}")
    colour = entry.get("colour", entry.get("color"))
    pattern = pattern_id(entry.get("pattern"), under(at, "pattern"), bukkit=True)
    return Layer(pattern, dye_name(colour, under(at, "colour")))


def write(banner: Banner) -> str:
    """The JSON of the design, without tier and structure.

    Raises DesignError for shields and for the patterns of data packs.
    """
    if banner.kind != "banner":
        raise DesignError("Wynncraft has no shields: write another form, such as 'give'")
    return json.dumps(
        {
            "base": banner.base.upper(),
            "layers": [
                {
                    "colour": layer.dye.upper(),
                    "pattern": bukkit_pattern(layer.pattern, f"layer {number}"),
                }
                for number, layer in enumerate(banner.layers, 1)
            ],
        }
    )
