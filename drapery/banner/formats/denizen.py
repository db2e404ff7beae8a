"""An item of Denizen's scripts: `red_banner[patterns=LIME/CREEPER|BLACK/BORDER]`.

Properties are parted by semicolons; a shield has `base_color`. Every such item of a script is read.
"""

import re

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.tree import base_of, check_count
from drapery.banner.names import bukkit_pattern, dye_name, pattern_id, shown
from drapery.errors import DesignError

NAME = "denizen"
TITLE = "item of the plugin Denizen"
EXAMPLE = "red_banner[patterns=LIME/CREEPER|BLACK/BORDER]"
SOURCE = "https://meta.denizenscript.com/Docs/Mechanisms/ItemTag.patterns"
_ITEM = re.compile(
    r"(?:i@)?\b((?:minecraft:)?[a-z_]{0,30}banner|shield)\[((?:[^\[\]\n]|<[^\n>]{0,200}>){0,4000})\]",
    re.IGNORECASE,
)
_PATTERNS = re.compile(r"\bpatterns=")


def recognises(text: str) -> bool:
    """Whether the text has an item with the property `patterns`."""
    return _PATTERNS.search(text) is not None and any(
        _PATTERNS.search(match[2]) for match in _ITEM.finditer(text)
    )


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    found = [_item(text, match) for match in _ITEM.finditer(text) if _PATTERNS.search(match[2])]
    if not found:
        raise DesignError(f"no banner with patterns in the script: write it as {EXAMPLE}")
    return found


def _item(text: str, match: "re.Match[str]") -> FoundBanner:
    at = f"line {text.count(chr(10), 0, match.start()) + 1} {match[1]}"
    properties = dict(part.strip().partition("=")[::2] for part in match[2].split(";"))
    if "patterns" not in properties:
        raise DesignError(f"{at}: 'patterns' is not a property by itself; write {EXAMPLE}")
    entries = [part for part in _bare(properties["patterns"]).split("|") if part]
    check_count(len(entries), at)
    layers = tuple(_layer(entry, f"{at} layer {n}") for n, entry in enumerate(entries, 1))
    shield = match[1].lower() == "shield"
    base = base_of(match[1]) or properties.get("base_color")
    if base is None and not shield:
        raise DesignError(f"{at}: the item names no dye: write it as red_banner")
    dye = dye_name(base or "white", at)
    return FoundBanner(Banner(dye, layers, "shield" if shield else "banner"), at)


def _bare(value: str) -> str:
    """The list without `li@`, and without the `<list[…]>` around it."""
    value = value.strip().removeprefix("li@")
    return value.removeprefix("<list[").removesuffix("]>")


def _layer(entry: str, at: str) -> Layer:
    if "<" in entry:
        raise DesignError(f"{at}: {shown(entry)} is filled in by the script; write DYE/PATTERN")
    dye, slash, pattern = entry.partition("/")
    if not slash:
        raise DesignError(f"{at}: {shown(entry)} is not a layer: write LIME/CREEPER")
    return Layer(pattern_id(pattern.strip(), at, bukkit=True), dye_name(dye.strip(), at))


def write(banner: Banner) -> str:
    """The item. Raises DesignError for the patterns of data packs."""
    layers = "|".join(
        f"{layer.dye.upper()}/{bukkit_pattern(layer.pattern, f'layer {number}')}"
        for number, layer in enumerate(banner.layers, 1)
    )
    if banner.kind == "shield":
        return f"shield[base_color={banner.base.upper()};patterns={layers}]"
    return f"{banner.base}_banner[patterns={layers}]"
