"""An item in CraftTweaker's scripts: `<item:minecraft:red_banner>.withTag({BlockEntityTag: …})`.

The casts of its map (`as int`) are read. Up to 1.12 the item was `<minecraft:banner:15>`.
"""

import re

from drapery.banner.design import Banner
from drapery.banner.formats import give_legacy
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.scripts import banner_of, calls
from drapery.banner.formats.snbt import parse_snbt
from drapery.banner.formats.tree import banner_from_tag
from drapery.errors import DesignError

NAME = "crafttweaker"
TITLE = "item in a script of the mod CraftTweaker"
EXAMPLE = (
    "<item:minecraft:white_banner>.withTag({BlockEntityTag:{Patterns:["
    '{Pattern:"cre",Color:5},{Pattern:"bo",Color:15}]}})'
)
SOURCE = "https://docs.blamejared.com/1.20.1/en/vanilla/api/item/IItemStack"
_CALL = re.compile(
    r"<(?:item:)?((?:minecraft:)?[a-z_]{0,30}(?:banner|shield))(?::([0-9]{1,2}))?>"
    r"(?:\s*\*\s*[0-9]{1,3})?\s*\.\s*(?:withTag|withNBT)\("
)
_CAST = re.compile(r"""("(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')|\s+as\s+[\w.]+(?:\[\w*\])*""")


def recognises(text: str) -> bool:
    """Whether the text has a banner with a tag in this form."""
    return "<" in text and _CALL.search(text) is not None


def read(text: str) -> list[FoundBanner]:
    """All banners of the script. Raises DesignError with the place."""
    found = []
    for match, arguments, at in calls(text, _CALL):
        tag = _CAST.sub(lambda cast: cast[1] or "", arguments[0] if arguments else "")
        at = f"{at} {match[1]}"
        if match[2]:
            found.append(FoundBanner(_old(match[1], tag, int(match[2]), at), at))
        elif banner := banner_of(match[1], tag, at):
            found.append(FoundBanner(banner, at))
    if not found:
        raise DesignError(f"no banner in the script: write it as {EXAMPLE}")
    return found


def _old(identifier: str, tag: str, damage: int, at: str) -> Banner:
    try:
        return banner_from_tag(identifier, parse_snbt(tag), data=damage)
    except DesignError as error:
        raise DesignError(f"{at}: {error}") from None


def write(banner: Banner) -> str:
    """The item, for 1.13 to 1.20.4. Raises DesignError for patterns that came later."""
    item, brace, tag = give_legacy.argument(banner).partition("{")
    return f"<item:{item}>.withTag({brace}{tag})" if brace else f"<item:{item}>.withTag({{}})"
