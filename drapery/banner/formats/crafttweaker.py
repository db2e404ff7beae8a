"""An item in CraftTweaker's scripts: `<item:minecraft:red_banner>.withTag({BlockEntityTag: …})`.

The casts of its map (`as int`) are read. Since 1.20.5 it has components,
`.withJsonComponent(<componenttype:minecraft:banner_patterns>, […])`; up to 1.12 the item was
`<minecraft:banner:15>`.
"""

import json
import re
from collections.abc import Iterator

from drapery.banner.design import Banner
from drapery.banner.formats import give_legacy
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.item import item_object
from drapery.banner.formats.scripts import arguments, banner_of, places
from drapery.banner.formats.snbt import parse_snbt
from drapery.banner.formats.tree import DataTree, banner_from_components, banner_from_tag, under
from drapery.errors import DesignError

NAME = "crafttweaker"
TITLE = "item in a script of the mod CraftTweaker"
EXAMPLE = (
    "<item:minecraft:white_banner>.withTag({BlockEntityTag:{Patterns:["
    '{Pattern:"cre",Color:5},{Pattern:"bo",Color:15}]}})'
)
SOURCE = "https://docs.blamejared.com/1.20.1/en/vanilla/api/item/IItemStack"
_ITEM = re.compile(
    r"<(?:item:)?((?:minecraft:)?[a-z_]{0,30}(?:banner|shield))(?::([0-9]{1,2}))?>"
    r"(?:\s*\*\s*[0-9]{1,3})?(?=\s*\.\s*with)"
)
_CALL = re.compile(r"\s*\.\s*(withTag|withNBT|withJsonComponent)\(")
_COMPONENT = re.compile(r"<componenttype:([\w:]{1,60})>")
_CAST = re.compile(r"""("(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')|\s+as\s+[\w.]+(?:\[\w*\])*""")


def recognises(text: str) -> bool:
    """Whether the text has a banner or a shield with a call in this form."""
    return any(_CALL.match(text, match.end()) for match in _ITEM.finditer(text))


def read(text: str) -> list[FoundBanner]:
    """All banners of the script. Raises DesignError with the place."""
    found, place_of = [], places(text)
    for match in _ITEM.finditer(text):
        at = f"{place_of(match.start())} {match[1]}"
        banner = _item(match, list(_calls(text, match.end(), at)), at)
        if banner is not None:
            found.append(FoundBanner(banner, at))
    if not found:
        raise DesignError(f"no banner in the script: write it as {EXAMPLE}")
    return found


def _calls(text: str, place: int, at: str) -> Iterator[tuple[str, list[str]]]:
    """The names and arguments of the calls after an item."""
    while match := _CALL.match(text, place):
        inner = arguments(text, match.end())
        if inner is None:
            raise DesignError(f"{at}: the call '{match[1]}(' is not closed; add ')'")
        yield match[1], inner[0]
        place = inner[1]


def _item(match: "re.Match[str]", calls: list[tuple[str, list[str]]], at: str) -> Banner | None:
    components: dict[str, DataTree] = {}
    for name, inner in calls:
        component = _COMPONENT.fullmatch(inner[0]) if inner else None
        if name == "withJsonComponent" and component and len(inner) > 1:
            components[component[1]] = _tree(inner[1], under(at, component[1]))
        elif name != "withJsonComponent":
            tag = _without_casts(inner[0] if inner else "")
            if match[2]:
                return banner_from_tag(match[1], _tree(tag, at), at, data=int(match[2]))
            return banner_of(match[1], tag, at)
    return banner_from_components(match[1], components, at) if components else None


def _tree(text: str, at: str) -> DataTree:
    try:
        return parse_snbt(_without_casts(text))
    except DesignError as error:
        raise DesignError(f"{at}: {error}") from None


def _without_casts(text: str) -> str:
    return _CAST.sub(lambda cast: cast[1] or "", text)


def write(banner: Banner) -> str:
    """The item, for 1.13 to 1.20.4 if these can hold it, or else with components."""
    try:
        item, brace, tag = give_legacy.argument(banner).partition("{")
        return f"<item:{item}>.withTag({brace or '{'}{tag or '}'})"
    except DesignError:
        tree = item_object(banner)
        calls = [
            f".withJsonComponent(<componenttype:{name}>, {json.dumps(value)})"
            for name, value in tree["components"].items()
        ]
        return f"<item:{tree['id']}>{''.join(calls)}"
