"""An item of Denizen's scripts: `red_banner[patterns=LIME/CREEPER|BLACK/BORDER]`.

Properties are parted by semicolons; a shield has `base_color`. An item script has the keys
`material: red_banner` and `patterns`, as `LIME/CREEPER` or as a list, in any order and at any
depth. Every such item of a script is read.
"""

import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.scripts import places
from drapery.banner.formats.tree import bare, base_of, check_count
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
_CHANGE = re.compile(
    r"^(?![ \t]*#)[^\n]*?(?:\bpatterns=|\badjust\b[^\n]{0,400}?\bpatterns:)", re.MULTILINE
)
"""A line that changes the patterns of an item."""

_ENTRY = r"[\"']?(?:li@|<list\[)?[A-Za-z_]+/[\w:]+"
_LIST = re.compile(
    rf"^[ \t]*patterns[ \t]*:[ \t]*"
    rf"(?:{_ENTRY}|(?:#[^\n]*)?(?:\n[ \t]*(?:#[^\n]*)?)*\n[ \t]*-[ \t]*{_ENTRY})",
    re.MULTILINE | re.IGNORECASE,
)
_KEY = re.compile(
    r"[ \t]*(?:- )?(type|material|patterns|base_color)[ \t]*:(?:[ \t]+(.*))?", re.IGNORECASE
)
_ELEMENT = re.compile(r"[ \t]*-[ \t]*(\S.*)")
_COMMENT = re.compile(r"(?:^|[ \t])#.*")


def recognises(text: str) -> bool:
    """Whether the text has an item with the property `patterns`, or a script of an item."""
    return _LIST.search(text) is not None or any(
        _PATTERNS.search(match[2]) for match in _ITEM.finditer(text)
    )


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    place_of = places(text)
    matches = [match for match in _ITEM.finditer(text) if _PATTERNS.search(match[2])]
    found = [_item(match, place_of(match.start())) for match in matches]
    found += _item_scripts(text)
    if not found:
        raise DesignError(f"no banner with patterns in the script: write it as {EXAMPLE}")
    read_at = {place_of(match.end() - 1) for match in matches}
    changes = (place_of(match.end()) for match in _CHANGE.finditer(text))
    if line := next((line for line in changes if line not in read_at), None):
        warnings.warn(
            f"{line}: patterns of an item that is not named in the line are not read;"
            f" write them as {EXAMPLE}",
            stacklevel=2,
        )
    return found


@dataclass
class _ItemScript:
    """An item script: where each of its keys stands, what it says, and its list of patterns."""

    places: dict[str, str] = field(default_factory=dict)
    values: dict[str, str] = field(default_factory=dict)
    patterns: list[str] = field(default_factory=list)


def _item_scripts(text: str) -> Iterator[FoundBanner]:
    """The banners of item scripts. Their keys come in any order and at any depth."""
    for script in _scripts(text):
        material = script.values.get("material", "")
        if "patterns" not in script.values:
            # A banner without patterns is a design too, beside those that have some.
            is_item = script.values.get("type", "").lower() == "item"
            if not (is_item and base_of(material)):
                continue
        elif not material:
            at = script.places["patterns"]
            raise DesignError(f"{at}: the item is missing: write 'material: red_banner' beside it")
        at = f"{script.places.get('patterns', script.places['material'])} {material}"
        patterns = "|".join([script.values.get("patterns", ""), *script.patterns])
        properties = script.values | {"patterns": patterns}
        yield FoundBanner(_banner(material, properties, at), at)


def _scripts(text: str) -> Iterator[_ItemScript]:
    """The containers of a file: each begins with a key that is not indented."""
    script, open_list = _ItemScript(), False
    for number, line in enumerate(text.splitlines(), 1):
        line = _COMMENT.sub("", line).rstrip()
        if not line:
            continue
        element = _ELEMENT.fullmatch(line) if open_list else None
        if element is not None:
            script.patterns.append(_unquoted(element[1]))
            continue
        open_list = False
        if not line[0].isspace() and not _KEY.fullmatch(line):
            yield script
            script = _ItemScript()
        elif key := _KEY.fullmatch(line):
            name = key[1].lower()
            script.places[name] = f"line {number}"
            script.values[name] = _unquoted(key[2] or "")
            open_list = name == "patterns" and not script.values[name]
    yield script


def _unquoted(value: str) -> str:
    value = value.strip()
    return value[1:-1] if len(value) > 1 and value[0] == value[-1] and value[0] in "\"'" else value


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
    shield = bare(item) == "shield"
    base = base_of(item) or properties.get("base_color", "white" if shield else None)
    if base is None:
        raise DesignError(f"{at}: the item names no dye: write it as red_banner")
    return Banner(dye_name(base, at), layers, "shield" if shield else "banner")


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
