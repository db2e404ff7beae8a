"""Lines of a Skript: `add a creeper banner pattern colored lime to banner patterns of {_banner}`.

The base is the item that the script puts into the variable. Skript has names of its own for the
patterns.
"""

import re

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.tree import check_count
from drapery.banner.names import dye_name, is_dye, pattern_id, shown
from drapery.errors import DesignError

NAME = "skript"
TITLE = "lines of a script of the plugin Skript"
EXAMPLE = (
    "set {_banner} to white banner\n"
    "add creeper banner pattern colored lime to banner patterns of {_banner}\n"
    "add border banner pattern colored black to banner patterns of {_banner}"
)
SOURCE = "https://github.com/SkriptLang/Skript/blob/master/src/main/resources/lang/default.lang"
_NAMES = {
    "curly border": "curly_border",
    "left diagonal": "diagonal_left",
    "right diagonal": "diagonal_right",
    "diagonal up left": "diagonal_up_left",
    "diagonal up right": "diagonal_up_right",
    "gradient up": "gradient_up",
    "horizontal half": "half_horizontal",
    "horizontal bottom half": "half_horizontal_bottom",
    "vertical half": "half_vertical",
    "right vertical half": "half_vertical_right",
    "small stripes": "small_stripes",
    "bottom left square": "square_bottom_left",
    "bottom right square": "square_bottom_right",
    "top left square": "square_top_left",
    "top right square": "square_top_right",
    "straight cross": "straight_cross",
    "bottom stripe": "stripe_bottom",
    "center stripe": "stripe_center",
    "down left stripe": "stripe_downleft",
    "down right stripe": "stripe_downright",
    "left stripe": "stripe_left",
    "middle stripe": "stripe_middle",
    "right stripe": "stripe_right",
    "top stripe": "stripe_top",
    "bottom triangle": "triangle_bottom",
    "top triangle": "triangle_top",
    "tbottom triangles": "triangles_bottom",
    "top triangles": "triangles_top",
}
_ALSO = {
    "bordure": "border",
    "bordure indented": "border",
    "field masoned": "bricks",
    "creeper charged": "creeper",
    "thing": "mojang",
    "snout": "piglin",
    "bottom triangles": "triangles_bottom",
    "small stripe": "small_stripes",
    "left diagonal mirror": "diagonal_up_left",
    "right diagonal mirror": "diagonal_right",
    "middle circle": "circle",
    "middle rhombus": "rhombus",
    "vertical half mirror": "half_vertical_right",
    "horizontal half mirror": "half_horizontal_bottom",
}
_LAYER = re.compile(
    r"\b(?:an? )?([\w ]{1,40}?)\"? banner pattern colou?red ((?:light |dark )?\w{1,20})",
    re.IGNORECASE,
)
_BASE = re.compile(r"\b((?:light |dark )?\w{1,20}) banners?\b(?! patterns?\b)", re.IGNORECASE)
_SET = re.compile(
    r"^\s*set \{[^{}\n]{1,60}\} to (?:an? )?[\w ]{1,40} banner\s*$", re.IGNORECASE | re.M
)
_ONE = re.compile(r"\s*set \{[^{}\n]{1,60}\} to ", re.IGNORECASE)
_OF = re.compile(r"(\{[^{}\n]{1,60}\})")


def recognises(text: str) -> bool:
    """Whether the text has a layer in Skript's words, or puts a banner into a variable."""
    small = text.lower()
    layer = "banner pattern colo" in small and _LAYER.search(text) is not None
    return layer or ("banner" in small and _SET.search(text) is not None)


def read(text: str) -> list[FoundBanner]:
    """The banner of each variable. Raises DesignError with the line."""
    bases: dict[str, str] = {}
    layers: dict[str, list[Layer]] = {}
    lines: dict[str, int] = {}
    kept: dict[str, list[Layer]] = {}
    for number, line in enumerate(text.split("\n"), 1):
        names = _OF.findall(line)
        matches = list(_LAYER.finditer(line))
        of = names[-1] if matches and names else names[0] if names else ""
        read = [_layer(match, f"line {number}") for match in matches]
        if read and _ONE.match(line):
            kept[of] = read
        elif "patterns of" in line and names and names[0] in kept:
            layers.setdefault(names[-1], []).extend(kept[names[0]])
        elif read:
            layers.setdefault(of, []).extend(read)
        dye = None if matches else _base(line)
        if dye is not None:
            bases[of], lines[of] = dye, number
    return [_banner(of, bases, layers, lines) for of in dict.fromkeys([*bases, *layers])]


def _base(line: str) -> str | None:
    """The dye of the banner that a line names, or None."""
    match = _BASE.search(line)
    words = (match[1], match[1].rpartition(" ")[2]) if match else ()
    return next((dye_name(word) for word in words if is_dye(word)), None)


def _banner(
    of: str, bases: dict[str, str], layers: dict[str, list[Layer]], lines: dict[str, int]
) -> FoundBanner:
    if of not in bases:
        raise DesignError(
            f"{of or 'the script'}: the base is missing: add the line"
            f" 'set {of or '{_banner}'} to white banner' above"
        )
    found = layers.get(of, [])
    check_count(len(found), of or "the script")
    return FoundBanner(Banner(bases[of], tuple(found)), f"line {lines[of]} {of}".rstrip())


def _layer(match: "re.Match[str]", at: str) -> Layer:
    words = re.sub(r"^(?:.*\bto |add )?(?:(?:an?|the|and|new) )*", "", match[1].lower().strip())
    pattern = _NAMES.get(words) or _ALSO.get(words) or pattern_id(words, at)
    dye = match[2] if is_dye(match[2]) else match[2].split(" ")[0]
    return Layer(pattern, dye_name(dye, at))


def write(banner: Banner) -> str:
    """The lines of a script. Raises DesignError for shields and the patterns of data packs."""
    if banner.kind != "banner":
        raise DesignError("this form has no shields: write another form, such as 'give'")
    names = {pattern: name for name, pattern in _NAMES.items()}
    lines = [f"set {{_banner}} to {_words(banner.base)} banner"]
    for number, layer in enumerate(banner.layers, 1):
        if ":" in layer.pattern:
            raise DesignError(f"layer {number}: Skript has no pattern {shown(layer.pattern)}")
        name = names.get(layer.pattern, layer.pattern)
        added = f"{name} banner pattern colored {_words(layer.dye)}"
        lines.append(f"add {added} to banner patterns of {{_banner}}")
    return "\n".join(lines)


def _words(dye: str) -> str:
    return dye.replace("_", " ")
