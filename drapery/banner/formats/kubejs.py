"""An item in KubeJS's scripts: `Item.of('minecraft:red_banner', '{BlockEntityTag:{…}}')`.

Since 1.20.5 the item's name has its components: `Item.of('minecraft:red_banner[…]')`, and in a
recipe such a text is an item without `Item.of`. The tag may be a text, an object or a variable,
after an amount or not; components may also be in an object, or in calls of `set`.
"""

import re
from bisect import bisect
from collections.abc import Callable
from functools import cache, partial

from drapery.banner.design import Banner
from drapery.banner.formats import give
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.scripts import arguments, banner_of, bracketed, literal, places
from drapery.banner.formats.snbt import parse_snbt
from drapery.banner.formats.tree import (
    DataTree,
    banner_from_components,
    bare,
    is_banner_id,
    is_shield_id,
)
from drapery.errors import DesignError

NAME = "kubejs"
TITLE = "item in a script of the mod KubeJS"
EXAMPLE = (
    "Item.of('minecraft:white_banner', '{BlockEntityTag:{Patterns:["
    '{Pattern:"cre",Color:5},{Pattern:"bo",Color:15}]}}\')'
)
SOURCE = "https://kubejs.com/wiki/concepts/item-stack"

_CALL = re.compile(r"\bItem\s*\.\s*of\(")
_EVENT = re.compile(r"\bevent\s*\.\s*\w{1,40}\(")
_QUOTED = re.compile(
    r"['\"`](?=(?:[0-9]{1,3}x\s{1,9})?(?:minecraft:)?[a-z_]{0,30}(?:banner|shield)\[)"
)
"""The start of an item with components, which is an item wherever a script needs one."""

_ITEM = re.compile(f"(?P<call>{_CALL.pattern})|{_QUOTED.pattern}")
_AMOUNT = re.compile(r"\s*[0-9]{1,3}\s*x\s+")
_CHAINED = re.compile(r"\s*\.\s*(\w{1,40})\(")
_VARIABLE = re.compile(r"[A-Za-z_$][\w$]{0,60}")
_DEFINED = re.compile(r"([A-Za-z_$][\w$]{0,60})\s*=\s*(?=[{\[])")
_TAG_NAME = re.compile("nbt|tag|component|pattern|data", re.IGNORECASE)
_COMPONENTS = frozenset({"banner_patterns", "base_color"})

_AMOUNT_NAME = re.compile("count|amount|number|size|stack|total|quantity|^.{1,2}$", re.IGNORECASE)
_NUMBER = re.compile(r"[\d\s.+*/()-]+")

_ValueOf = Callable[[str], str | None]
"""Gives the object or list that is a variable's value at an item, or None if it is not in the
text before it."""


def recognises(text: str) -> bool:
    """Whether the text calls `Item.of`, or an event, and names a banner or a shield."""
    if "banner" not in text and "shield" not in text:
        return False
    if _CALL.search(text) is not None:
        return True
    return _EVENT.search(text) is not None and _QUOTED.search(text) is not None


def read(text: str) -> list[FoundBanner]:
    """All banners of the script. Raises DesignError with the place."""
    place_of, values_before = places(text), _values(text)
    found: list[FoundBanner] = []
    end = 0
    for match in _ITEM.finditer(text):
        if match.start() < end:
            continue
        at = place_of(match.start())
        if match["call"]:
            inner, calls, end = _calls(text, match.end(), at)
        else:
            end = _end_of_quote(text, match.start(), at)
            inner, calls = [text[match.start() : end]], []
        one = _read_item(inner, calls, values_before(match.start()), at)
        found += [one] if one else []
    if not found:
        raise DesignError(f"no banner in the script: write it as {EXAMPLE}")
    return found


def _values(text: str) -> Callable[[int], _ValueOf]:
    """Gives the latest values of variables before a place in the text."""
    starts: dict[str, list[int]] = {}
    for match in _DEFINED.finditer(text):
        starts.setdefault(match[1], []).append(match.end())
    value_from = cache(partial(bracketed, text))

    def values_before(place: int) -> _ValueOf:
        def value_of(name: str) -> str | None:
            known = starts.get(name, [])
            number = bisect(known, place)
            return value_from(known[number - 1]) if number else None

        return value_of

    return values_before


def _end_of_quote(text: str, start: int, at: str) -> int:
    end = re.compile(rf"(?:[^{text[start]}\\]|\\.)*{text[start]}", re.DOTALL).match(text, start + 1)
    if end is None:
        raise DesignError(f"{at}: the quote {text[start]} is not closed; add it")
    return end.end()


def _calls(text: str, place: int, at: str) -> tuple[list[str], list[tuple[str, list[str]]], int]:
    """The arguments of `Item.of`, the calls after it with theirs, and the end of all."""
    first = _arguments(text, place, "Item.of", at)
    calls, end = [], first[1]
    while match := _CHAINED.match(text, end):
        inner, end = _arguments(text, match.end(), match[1], at)
        calls.append((match[1], inner))
    return first[0], calls, end


def _arguments(text: str, place: int, name: str, at: str) -> tuple[list[str], int]:
    found = arguments(text, place)
    if found is None:
        raise DesignError(f"{at}: the call '{name}(' is not closed; add ')'")
    return found


def _read_item(
    inner: list[str], calls: list[tuple[str, list[str]]], value_of: _ValueOf, at: str
) -> FoundBanner | None:
    """The banner of an item's name, its other arguments and the calls after it."""
    text = literal(inner[0]) if inner else None
    name = _AMOUNT.sub("", text or "", count=1).strip()
    place = min((at for at in map(name.find, "[{") if at >= 0), default=len(name))
    name, tag = name[:place].strip(), name[place:]
    if not (is_banner_id(name) or is_shield_id(name)):
        return None
    at = f"{at} {bare(name)}"
    tags = [*inner[2:], *(call[1][0] for call in calls if call[0] == "withNBT" and call[1])]
    tags = [word for word in inner[1:2] if not _is_amount(word)] + tags
    tag = tag or next((_tag(word, value_of, at) for word in tags), "")
    sets = (call[1] for call in calls if call[0] == "set" and len(call[1]) == 2)
    named = [(literal(words[0]) or words[0], words[1]) for words in sets]
    components = {
        component: _tree(value, value_of, at)
        for component, value in named
        if bare(component) in _COMPONENTS
    }
    banner = _banner(name, tag, components, at)
    return FoundBanner(banner, at) if banner else None


def _banner(name: str, tag: str, components: dict[str, DataTree], at: str) -> Banner | None:
    if components and tag:
        raise DesignError(f"{at}: it has a tag and calls of set(); write the components in one")
    if components:
        return banner_from_components(name, components, at)
    if tag.startswith("{"):
        tree = _tree(tag, lambda name: None, at)
        if isinstance(tree, dict) and _COMPONENTS.intersection(map(bare, tree)):
            return banner_from_components(name, tree, at)
    return banner_of(name, tag or None, at)


def _is_amount(argument: str) -> bool:
    """Whether the second argument of `Item.of` is an amount, not a tag."""
    text = literal(argument) or argument
    if _VARIABLE.fullmatch(text):
        return _AMOUNT_NAME.search(text) is not None and _TAG_NAME.search(text) is None
    return _NUMBER.fullmatch(text) is not None


def _tag(argument: str, value_of: _ValueOf, at: str) -> str:
    """The tag or components that an argument is. Raises DesignError if it cannot be read."""
    text = literal(argument)
    if text is None:
        text = (value_of(argument) or "") if _VARIABLE.fullmatch(argument) else argument
    if not text.startswith(("{", "[")):
        raise DesignError(
            f"{at}: the value of {argument[:40]} is not in the text; write it into the call"
        )
    return text


def _tree(argument: str, value_of: _ValueOf, at: str) -> DataTree:
    quoted = literal(argument)
    is_name = quoted is None and _VARIABLE.fullmatch(argument) is not None
    try:
        is_value = is_name or (quoted or argument).startswith(("{", "["))
        return parse_snbt(_tag(argument, value_of, at) if is_value else argument)
    except DesignError as error:
        raise error if str(error).startswith(at) else DesignError(f"{at}: {error}") from None


def write(banner: Banner) -> str:
    """The item with its components, for 1.20.5 and later."""
    item = give.argument(banner)
    return "Item.of('" + item.replace("\\", "\\\\").replace("'", "\\'") + "')"
