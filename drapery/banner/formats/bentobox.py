"""The banner of a language in BentoBox: `RED_BANNER:1:STRIPE_RIGHT:BLACK:STRIPE_LEFT:YELLOW`.

An item, an amount, then pairs of Bukkit's pattern and dye. A file of a language has it as the value
of `banner`.
"""

import re

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.scripts import places
from drapery.banner.formats.tree import check_count
from drapery.banner.formats.yaml_items import kind_and_base, material
from drapery.banner.names import bukkit_pattern, dye_name, pattern_id, shown
from drapery.errors import DesignError

NAME = "bentobox"
TITLE = "item of the plugin BentoBox"
EXAMPLE = "RED_BANNER:1:STRIPE_RIGHT:BLACK:STRIPE_LEFT:YELLOW"
SOURCE = "https://github.com/BentoBoxWorld/BentoBox"
_ITEM = re.compile(r"\b([A-Z_]{0,40}BANNER):([0-9]{1,4})((?::[A-Za-z0-9_-]{0,80})*)")

_AMOUNT = re.compile(r" +[0-9]{1,4}(?!\S)")


def recognises(text: str) -> bool:
    """Whether the text has an item of this form, and not an old one of EssentialsX."""
    match = _ITEM.search(text) if "BANNER:" in text else None
    return match is not None and _AMOUNT.match(text, match.end()) is None


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    place_of = places(text)
    found = [_read_one(match, place_of(match.start())) for match in _ITEM.finditer(text)]
    if not found:
        raise DesignError(f"no banner in the text: write it as {EXAMPLE}")
    return found


def _read_one(match: "re.Match[str]", line: str) -> FoundBanner:
    at = f"{line} {match[1]}"
    item = kind_and_base(match[1])
    if item is None or item[1] is None:
        raise DesignError(f"{at}: {shown(match[1])} names no dye: write it as RED_BANNER")
    names = [name for name in match[3].split(":")[1:] if name and not name.startswith("CMD-")]
    if len(names) % 2:
        raise DesignError(f"{at}: the pattern {shown(names[-1])} has no dye: write PATTERN:DYE")
    check_count(len(names) // 2, at)
    layers = tuple(
        Layer(pattern_id(name, at, bukkit=True), dye_name(dye, at))
        for name, dye in zip(names[::2], names[1::2], strict=True)
    )
    return FoundBanner(Banner(item[1], layers), at)


def write(banner: Banner) -> str:
    """The item. Raises DesignError for shields and the patterns of data packs."""
    if banner.kind != "banner":
        raise DesignError("BentoBox has no shields: write another form, such as 'give'")
    words = [material(banner), "1"]
    for number, layer in enumerate(banner.layers, 1):
        words += [bukkit_pattern(layer.pattern, f"layer {number}"), layer.dye.upper()]
    return ":".join(words)
