"""An item of Denizen's scripts: `red_banner[patterns=LIME/CREEPER|BLACK/BORDER]`.

Properties are parted by semicolons; a shield has `base_color`. An item script has the lines
`material: red_banner` and `patterns: LIME/CREEPER`. Every such item of a script is read.
"""

import re
from collections.abc import Callable, Iterator

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.scripts import places
from drapery.banner.formats.tree import base_of, check_count
from drapery.banner.names import bukkit_pattern, dye_name, pattern_id, shown
from drapery.errors import DesignError

NAME = "denizen"
TITLE = "item of the plugin Denizen"
EXAMPLE = "red_banner[patterns=LIME/CREEPER|BLACK/BORDER]"
SOURCE = "https://meta.denizenscript.com/Docs/Mechanisms/ItemTag.patterns"
_ITEM = re.compile(
    r"(?:i@)?\b((?:minecraft:)?[a-z_]{0,30}banner|shield)(?:\]\s?\.\s?with)?\[((?:[^\[\]\n<]|<[^\n<>]{0,200}>){0,4000})\]",
    re.IGNORECASE,
)
_PATTERNS = re.compile(r"\bpatterns=")
_LINE = re.compile(r"^[ \t]*(material|patterns): *(\S[^\n]*)$", re.MULTILINE)
_LIST = re.compile(r"^[ \t]*patterns: *(?:li@)?\w+/\w+", re.MULTILINE)


def recognises(text: str) -> bool:
    """Whether the text has an item with the property `patterns`, or a script of an item."""
    return _LIST.search(text) is not None or any(
        _PATTERNS.search(match[2]) for match in _ITEM.finditer(text)
    )


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    place_of = places(text)
    matches = (match for match in _ITEM.finditer(text) if _PATTERNS.search(match[2]))
    found = [_item(match, place_of(match.start())) for match in matches]
    found += _item_scripts(text, place_of)
    if not found:
        raise DesignError(f"no banner with patterns in the script: write it as {EXAMPLE}")
    return found


def _item_scripts(text: str, place_of: Callable[[int], str]) -> Iterator[FoundBanner]:
    """The banners of item scripts, whose material is the line before their patterns."""
    material: re.Match[str] | None = None
    for match in _LINE.finditer(text):
        if match[1] == "material":
            material = match
        elif match[1] == "patterns" and _LIST.match(match[0]):
            at = place_of(match.start(1))
            if material is None:
                raise DesignError(f"{at}: the item is missing: write 'material: red_banner' above")
            name = material[2].strip()
            yield FoundBanner(_banner(name, {"patterns": match[2]}, f"{at} {name}"), f"{at} {name}")


def _item(match: "re.Match[str]", line: str) -> FoundBanner:
    at = f"{line} {match[1]}"
    properties = dict(part.strip().partition("=")[::2] for part in match[2].split(";"))
    return FoundBanner(_banner(match[1], properties, at), at)


def _banner(item: str, properties: dict[str, str], at: str) -> Banner:
    if "patterns" not in properties:
        raise DesignError(f"{at}: 'patterns' is not a property by itself; write {EXAMPLE}")
    entries = [part for part in _bare(properties["patterns"]).split("|") if part]
    check_count(len(entries), at)
    layers = tuple(_layer(entry, f"{at} layer {n}") for n, entry in enumerate(entries, 1))
    shield = item.lower() == "shield"
    base = base_of(item) or properties.get("base_color")
    if base is None and not shield:
        raise DesignError(f"{at}: the item names no dye: write it as red_banner")
    return Banner(dye_name(base or "white", at), layers, "shield" if shield else "banner")


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
