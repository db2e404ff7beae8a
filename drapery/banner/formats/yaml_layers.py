"""Lists of layers in a plugin's YAML, whatever the plugin: what looks like one, and how it is read.

A layer is a text such as `RED:CREEPER` or `creeper, red`, or a mapping of a pattern and a colour.
Layers stand in a list, in a mapping by number or name, in a mapping of patterns to dyes, or in one
text with bars between them. No name is both a pattern's and a dye's, so either may be first.
"""

import re
from collections.abc import Iterator

from drapery.banner.design import Layer
from drapery.banner.formats.tree import DataTree, check_count, under
from drapery.banner.names import dye_name, is_custom, is_dye, is_pattern, pattern_id, shown
from drapery.errors import DesignError

_KEY = re.compile("pattern|layer|banner|design", re.IGNORECASE)
_WORDS = re.compile(r"lore|name|command|action|descr|message|text", re.IGNORECASE)
_SEPARATOR = re.compile(r"\s*[:;,/|=]\s*|\s+")
_BETWEEN = re.compile(r"\||\n|[,;]\s")
_PATTERN_KEYS = ("pattern", "patterntype", "type", "shape", "design", "name")
_COLOUR_KEYS = ("color", "colour", "dye", "patterncolor", "patterncolour", "dyecolor")
_LONGEST = 200


def names_layers(key: object) -> bool:
    """Whether a key is called as those of layers are."""
    return isinstance(key, str) and _KEY.search(key) is not None


def holds_words(key: object) -> bool:
    """Whether a key is called as those of lore, names and commands are, which are no layers."""
    return isinstance(key, str) and not names_layers(key) and _WORDS.search(key) is not None


def looks_like_layers(value: DataTree, named: bool) -> bool:
    """Whether a value looks like a banner's layers.

    named: whether its key, or one around it, `names_layers`. Then a misspelt layer looks like one
    too; otherwise both names of at least one layer must be known.
    """
    if isinstance(value, list):
        return any(_is_layer(entry, named) for entry in value)
    if isinstance(value, dict) and value:
        mappings = all(isinstance(entry, dict) for entry in value.values())
        if mappings or all(key.isdecimal() for key in value):
            return all(_is_layer(entry, named) for entry in value.values())
        return named and (_is_layer(value, named) or _is_pairs(value))
    if isinstance(value, str):
        parts = _parts(value)
        return named and bool(parts) and all(_is_layer(part, False) for part in parts)
    return False


def read_layers(value: DataTree, at: str, sample: str) -> tuple[Layer, ...]:
    """The layers of a value in the order of their numbers; empty for None.

    sample: a layer as the plugin writes it, for messages. Raises DesignError with the place.
    """
    entries = list(_entries(value, at))
    check_count(len(entries), at)
    return tuple(_layer(entry, place, sample) for place, entry in entries)


def _entries(value: DataTree, at: str) -> Iterator[tuple[str, DataTree]]:
    """The layers of a value, each with its place."""
    if value is None:
        return
    if isinstance(value, dict) and not _has_keys(value):
        numbered = all(key.isdecimal() for key in value)
        items = sorted(value.items(), key=lambda item: int(item[0])) if numbered else value.items()
        for key, entry in items:
            pair = f"{key}:{entry}" if isinstance(entry, str) and not numbered else entry
            yield under(at, key), pair
    elif isinstance(value, list):
        yield from ((under(at, number), entry) for number, entry in enumerate(value))
    elif isinstance(value, dict):
        yield at, value
    elif isinstance(value, str) and _is_layer(_parts(value)[:1] and _parts(value)[0], True):
        yield from ((under(at, number), part) for number, part in enumerate(_parts(value)))
    else:
        raise DesignError(f"{at}: {shown(value)} is not a list of layers")


def _parts(text: str) -> list[str]:
    return [part.strip() for part in _BETWEEN.split(text) if part.strip()]


def _is_pairs(value: dict[str, DataTree]) -> bool:
    """Whether a mapping is one of patterns to dyes, or of dyes to patterns."""
    return all(isinstance(entry, str) and _known(key, entry) == 2 for key, entry in value.items())


def _is_layer(entry: DataTree, named: bool) -> bool:
    if isinstance(entry, dict):
        keys = _keys(entry)
        if keys is None:
            return False
        return named or _known(entry[keys[0]], entry[keys[1]]) == 2
    if not isinstance(entry, str) or len(entry) > _LONGEST:
        return False
    known = max((_known(*pair) for pair in _splits(entry)), default=0)
    spaced = re.search(r"[:;,/|=]", entry) is None
    return (known == 2 and not spaced) or (known > 0 and named)


def _known(one: DataTree, other: DataTree) -> int:
    """How many of two names are known: 2 for a pattern and a dye, in any order."""
    if not isinstance(one, str) or not isinstance(other, str):
        number = [word for word in (one, other) if not isinstance(word, str)]
        names = [word for word in (one, other) if isinstance(word, str)]
        return 2 if len(names) == 1 and _is_pattern(names[0]) and type(number[0]) is int else 0
    found = (is_dye(one) and _is_pattern(other)) or (is_dye(other) and _is_pattern(one))
    return 2 if found else int(any(is_dye(word) or _is_pattern(word) for word in (one, other)))


def _is_pattern(name: str) -> bool:
    return is_pattern(name) or is_custom(name)


def _splits(text: str) -> list[tuple[str, str]]:
    """A text cut into two names at each separator; `acme:anvil:red` has two."""
    return [
        (text[: match.start()].strip(), text[match.end() :].strip())
        for match in _SEPARATOR.finditer(text.strip())
        if text[: match.start()].strip() and text[match.end() :].strip()
    ]


def _keys(entry: dict[str, DataTree]) -> tuple[str, str] | None:
    """The keys of a layer's pattern and of its colour, or None."""
    plain = {re.sub("[-_ ]", "", key.lower()): key for key in entry}
    pattern = next((plain[key] for key in _PATTERN_KEYS if key in plain), None)
    colour = next((plain[key] for key in _COLOUR_KEYS if key in plain), None)
    return None if pattern is None or colour is None else (pattern, colour)


def _has_keys(entry: dict[DataTree, DataTree]) -> bool:
    return _keys(entry) is not None


def _layer(entry: DataTree, at: str, sample: str) -> Layer:
    if isinstance(entry, dict) and (keys := _keys(entry)):
        pattern, colour = keys
        return Layer(
            pattern_id(entry[pattern], under(at, str(pattern))),
            dye_name(entry[colour], under(at, str(colour))),
        )
    pairs = _splits(entry) if isinstance(entry, str) and len(entry) <= _LONGEST else []
    if not pairs:
        raise DesignError(f"{at}: {shown(entry)} is not a layer: write '{sample}'")
    one, other = max(pairs, key=lambda pair: _known(*pair))
    dye, pattern = (one, other) if is_dye(one) or _is_pattern(other) else (other, one)
    return Layer(pattern_id(pattern, at), dye_name(dye, at))
