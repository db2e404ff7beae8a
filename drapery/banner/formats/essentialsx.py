"""An item of EssentialsX, as in kits: `white_banner 1 basecolor:16383998 cre,8439583`.

A layer is a pattern's code and the dye's colour as one number, red first; `basecolor` is needed by
shields and by versions before 1.13. Colours of Bukkit before 1.12 are read too.
"""

import re
from collections.abc import Iterator

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.tree import base_of, check_count
from drapery.banner.names import dye_name, is_dye, pattern_id, shown
from drapery.banner.patterns import PATTERNS
from drapery.errors import DesignError

NAME = "essentialsx"
TITLE = "item of the plugin EssentialsX"
EXAMPLE = "white_banner 1 basecolor:16383998 cre,8439583 bo,1908001"
SOURCE = "https://github.com/EssentialsX/Website/blob/main/BannerMeta.md"
_ITEM = re.compile(
    r"(?:^|[\s/\"'-])((?:minecraft:)?(?:[a-z_]{1,30}_)?(?:banner|shield))(?::([0-9]{1,2}))?"
    r"(?: +([0-9]{1,4}))?([ \t][^\n]*)?",
    re.IGNORECASE,
)
_WORD = re.compile(r"([A-Za-z_]{1,40})[:+',;.]([0-9]{1,8}|[0-9]{1,3}(?:,[0-9]{1,3}){2}|[A-Za-z_]+)")
_DETAIL = re.compile(r"\bbasecolou?r[:+',;.]|\b[a-z]{1,3},[0-9]{6,8}\b", re.IGNORECASE)
_OLD = (
    *(0xFFFFFF, 0xD87F33, 0xB24CD8, 0x6699D8, 0xE5E533, 0x7FCC19, 0xF27FA5, 0x4C4C4C),
    *(0x999999, 0x4C7F99, 0x7F3FB2, 0x334CB2, 0x664C33, 0x667F33, 0x993333, 0x191919),
)
"""The colours of Bukkit's dyes before 1.12, in the order of the dyes' numbers."""


def _colours() -> dict[int, str]:
    new = {r << 16 | g << 8 | b: dye.name for dye in DYES.values() for r, g, b in [dye.rgb]}
    return dict(zip(_OLD, DYES, strict=True)) | new


def recognises(text: str) -> bool:
    """Whether the text has a word that only this form has."""
    return "{" not in text and "[" not in text and _DETAIL.search(text) is not None


def read(text: str) -> list[FoundBanner]:
    """All banners of the text, such as the lines of a kit. Raises DesignError with the place."""
    found = []
    for number, line in _lines(text):
        match = _ITEM.search(line)
        if match:
            found.append(_item(match, f"line {number} {match[1]}"))
    if not found:
        raise DesignError(f"no item of EssentialsX in the text: write it as {EXAMPLE}")
    return found


def _lines(text: str) -> Iterator[tuple[int, str]]:
    """The lines with their numbers. A line of nothing but parts of an item goes on the last one."""
    first, pieces = 0, [""]
    for number, line in enumerate(text.split("\n"), 1):
        words = line.split()
        if words and all(map(_PART.fullmatch, words)):
            pieces.append(line.strip() if pieces[-1].endswith(",") else f" {line.strip()}")
        else:
            yield first, "".join(pieces)
            first, pieces = number, [line]
        pieces[-1] = pieces[-1].rstrip().rstrip("\\").rstrip()
    yield first, "".join(pieces)


_PART = re.compile(
    r"\\|[0-9]{1,8}\\?|basecolou?r[:+',;.]\S*|[a-z_]{1,40},[0-9]{0,8}\\?", re.IGNORECASE
)


def _item(match: "re.Match[str]", at: str) -> FoundBanner:
    base = base_of(match[1]) or (match[2] and dye_name(int(match[2]), at, inverted=True))
    layers = []
    for word in (match[4] or "").split():
        word = word.strip("\"',")
        parts = _WORD.fullmatch(word)
        name = parts[1].lower() if parts else ""
        if parts and name in ("basecolor", "basecolour"):
            base = _dye(parts[2], at)
        elif parts and name not in _OTHER:
            layers.append(Layer(pattern_id(parts[1], at, bukkit=True), _dye(parts[2], at)))
        elif not parts and _DETAIL.search(word):
            raise DesignError(f"{at}: {shown(word)} is not a layer: write cre,8439583")
    check_count(len(layers), at)
    shield = match[1].lower().endswith("shield")
    if not base and not (shield and layers):
        raise DesignError(f"{at}: the base dye is missing: write it as white_banner")
    return FoundBanner(Banner(base or "white", tuple(layers), "shield" if shield else "banner"), at)


_OTHER = frozenset({"name", "lore", "itemflags", "unbreakable", "custommodeldata", "amount"})


def _dye(word: str, at: str) -> str:
    if is_dye(word):
        return dye_name(word)
    numbers = [int(part) for part in word.split(",") if part.isdecimal() and len(part) < 10]
    colour = numbers[0] if len(numbers) == 1 else None
    if len(numbers) == 3:
        colour = min(numbers[0], 255) << 16 | min(numbers[1], 255) << 8 | min(numbers[2], 255)
    dye = None if colour is None else _colours().get(colour)
    if dye is None:
        raise DesignError(
            f"{at}: {shown(word)} is not the colour of a dye; write a dye's name, such as RED"
        )
    return dye


def write(banner: Banner) -> str:
    """The item. Raises DesignError for patterns without a code."""
    red, green, blue = DYES[banner.base].rgb
    item = "shield" if banner.kind == "shield" else f"{banner.base}_banner"
    words = [item, "1", f"basecolor:{red << 16 | green << 8 | blue}"]
    for number, layer in enumerate(banner.layers, 1):
        pattern = PATTERNS.get(layer.pattern)
        if pattern is None or pattern.code is None:
            raise DesignError(
                f"layer {number}: EssentialsX has no code for {shown(layer.pattern)};"
                " leave the layer out or write another form"
            )
        red, green, blue = DYES[layer.dye].rgb
        words.append(f"{pattern.code},{red << 16 | green << 8 | blue}")
    return " ".join(words)
