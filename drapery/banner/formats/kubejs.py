"""An item in KubeJS's scripts: `Item.of('minecraft:red_banner', '{BlockEntityTag:{…}}')`.

Since 1.20.5 the item's name has its components: `Item.of('minecraft:red_banner[…]')`. The tag may
be a text or an object, after an amount or not.
"""

import re

from drapery.banner.design import Banner
from drapery.banner.formats import give
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.scripts import banner_of, calls, literal
from drapery.banner.formats.tree import bare
from drapery.errors import DesignError

NAME = "kubejs"
TITLE = "item in a script of the mod KubeJS"
EXAMPLE = (
    "Item.of('minecraft:white_banner', '{BlockEntityTag:{Patterns:["
    '{Pattern:"cre",Color:5},{Pattern:"bo",Color:15}]}}\')'
)
SOURCE = "https://kubejs.com/wiki/ref/ItemStack"
_CALL = re.compile(r"\bItem\s*\.\s*of\(")
_AFTER = re.compile(r"\bItem\s*\.\s*of\(\s*['\"]([\w:]{1,60})['\"][^()\n]{0,20}\)\s*\.\s*withNBT\(")


def recognises(text: str) -> bool:
    """Whether the text calls `Item.of` and names a banner or a shield."""
    return _CALL.search(text) is not None and ("banner" in text or "shield" in text)


def read(text: str) -> list[FoundBanner]:
    """All banners of the script. Raises DesignError with the place."""
    found = []
    after = {match.start(): (match[1], inner) for match, inner, _ in calls(text, _AFTER)}
    for match, inner, at in calls(text, _CALL):
        name, tags = literal(inner[0]) if inner else None, inner[1:]
        if match.start() in after:
            name, tags = after[match.start()]
        if name is None:
            continue
        identifier, bracket, components = name.partition("[")
        words = (literal(tag) or tag for tag in tags)
        tag = next((word for word in words if word.startswith(("{", "["))), None)
        at = f"{at} {bare(identifier)}"
        banner = banner_of(identifier.strip(), bracket + components if bracket else tag, at)
        if banner:
            found.append(FoundBanner(banner, at))
    if not found:
        raise DesignError(f"no banner in the script: write it as {EXAMPLE}")
    return found


def write(banner: Banner) -> str:
    """The item with its components, for 1.20.5 and later."""
    item = give.argument(banner)
    return "Item.of('" + item.replace("\\", "\\\\").replace("'", "\\'") + "')"
