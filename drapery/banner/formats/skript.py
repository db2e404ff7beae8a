"""Lines of a Skript: `add a creeper banner pattern colored lime to banner patterns of {_banner}`.

The lines are followed from the first to the last: what they put into variables, and how they add,
set, remove and clear patterns. Skript has names of its own for the patterns.
"""

import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field

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
    r"(?:(?:an?|the|new) )*([\w ]{1,40}?)\"? banner pattern colou?red ((?:light |dark )?\w{1,20})",
    re.IGNORECASE,
)
_BASE = re.compile(
    r"\b((?:light |dark )?\w{1,20}) banners?\b(?! patterns?\b)(?=[^{}]*$)", re.IGNORECASE
)
_SET = re.compile(
    r"^\s*set \{[^{}\n]{1,60}\} to (?:an? )?[\w ]{1,40} banner\s*$", re.IGNORECASE | re.M
)
_STRING = re.compile(r'"(?:[^"]|"")*"')
_COMMENT = re.compile(r"(?<!#)#(?!#).*")
_SECTION = re.compile(r"(?:if|else|loop|while|for|chance of|switch|case|default)\b", re.IGNORECASE)
_SHOWS = frozenset(
    {"send", "message", "broadcast", "log", "return", "give", "drop", "equip", "wait", "stop"}
)
"""The first words of lines that talk of patterns and change none."""

_CHANGES = (
    ("set", re.compile(r"set (?P<place>.+?) to (?P<value>.+)", re.IGNORECASE)),
    ("add", re.compile(r"add (?P<value>.+) to (?P<place>.+)", re.IGNORECASE)),
    (
        "remove",
        re.compile(r"remove (?:all |every )?(?P<value>.+) from (?P<place>.+)", re.IGNORECASE),
    ),
    ("clear", re.compile(r"(?:clear|delete) (?P<place>.+)", re.IGNORECASE)),
)
_PATTERNS = (
    re.compile(
        r"(?:all (?:of )?(?:the )?|the )?(?:(?P<n>[0-9]{1,4})(?:st|nd|rd|th) )?banner patterns? of"
        r" (?P<of>.+)",
        re.IGNORECASE,
    ),
    re.compile(
        r"(?P<of>.+?)'s? (?:(?P<n>[0-9]{1,4})(?:st|nd|rd|th) )?banner patterns?", re.IGNORECASE
    ),
)
_FILLER = Layer("base", "white")
"""What Skript adds below a pattern whose number is over the number of patterns."""


_MOST_KEPT = 1000
"""Most layers of a list from which a script takes some."""


@dataclass
class _MadeBanner:
    """A banner that a script makes. line: where. copied: the layers that another one had."""

    base: str
    of: str
    line: int
    layers: list[Layer] = field(default_factory=list)
    copied: list[Layer] | None = None


@dataclass
class _Script:
    """What a script has made so far. items, patterns: those in each variable now."""

    made: list[_MadeBanner] = field(default_factory=list)
    items: dict[str, _MadeBanner] = field(default_factory=dict)
    patterns: dict[str, list[Layer]] = field(default_factory=dict)


def recognises(text: str) -> bool:
    """Whether the text has a layer in Skript's words, or puts a banner into a variable."""
    small = text.lower()
    layer = "banner pattern colo" in small and _LAYER.search(text) is not None
    return layer or ("banner" in small and _SET.search(text) is not None)


def read(text: str) -> list[FoundBanner]:
    """The banners that the lines of a script make, each as the last of them leaves it.

    A line that may be run several times or not at all is read as if it is run once; a warning
    names the first one. Raises DesignError with the line, also for a line that changes patterns
    in a way that is not known.
    """
    script = _Script()
    uncertain = ""
    for number, line, section in _lines(text):
        if line.endswith(":"):
            if not section:
                _leave_scope(script)
            continue
        if _follow(script, line, number) and section and not uncertain:
            uncertain = f"line {number} stands below {shown(section)}"
    if uncertain:
        warnings.warn(f"{uncertain}: it is read as if it is run once", stacklevel=2)
    for item in script.made:
        check_count(len(item.layers), f"line {item.line} {item.of}".rstrip())
    return [
        FoundBanner(Banner(item.base, tuple(item.layers)), f"line {item.line} {item.of}".rstrip())
        for item in script.made
        if item.copied != item.layers
    ]


def _lines(text: str) -> Iterator[tuple[int, str, str]]:
    """The lines with their numbers, without comments, and the section of each that is not sure.

    A section that begins a script, such as a command, has the empty text, and so have its lines.
    """
    open_sections: list[tuple[int, str]] = []
    for number, row in enumerate(text.split("\n"), 1):
        bare = _STRING.sub(lambda match: match[0].replace("#", "##"), row)
        line = _COMMENT.sub("", bare).replace("##", "#").strip()
        if not line:
            continue
        indent = len(row) - len(row.lstrip())
        while open_sections and indent <= open_sections[-1][0]:
            open_sections.pop()
        sure = next((name for _, name in open_sections if _SECTION.match(name)), "")
        yield number, line, sure or ("section" if line.endswith(":") and open_sections else "")
        if line.endswith(":"):
            open_sections.append((indent, line))


def _leave_scope(script: _Script) -> None:
    """Forget the local variables, which begin with `_`, where another part of a script begins."""
    for known in (script.items, script.patterns):
        for name in [name for name in known if name.startswith("{_")]:
            del known[name]


def _follow(script: _Script, line: str, number: int) -> bool:
    """Do what a line does. Returns whether it has to do with banners."""
    at = f"line {number}"
    for verb, change in _CHANGES:
        match = change.fullmatch(line)
        if match is None:
            continue
        value = match.groupdict().get("value") or ""
        if place := _place(match["place"]):
            of, index = place
            _change(_item(script, of), verb, index, _values(script, value, at), at)
            return True
        return _assign(script, verb, _name(match["place"]), value, number)
    words = _STRING.sub('""', line)
    first = words.split(maxsplit=1)[0].lower()
    if "banner pattern" in words.lower() and first not in _SHOWS:
        raise DesignError(
            f"{at}: {shown(line)} is not a way to change patterns that is known; write add, set,"
            " remove or clear"
        )
    dye = _base(words) if first in ("give", "drop", "equip") else None
    if dye:
        script.made.append(_MadeBanner(dye, "", number))
    return dye is not None


def _assign(script: _Script, verb: str, name: str, value: str, number: int) -> bool:
    """Change what a variable, a slot or a block holds."""
    item, kept = script.items.get(name), script.patterns.get(name)
    if verb in ("set", "clear"):
        script.items.pop(name, None)
        script.patterns.pop(name, None)
    words = _STRING.sub('""', value)
    if "banner pattern" in words.lower() or all(map(script.patterns.__contains__, _parts(words))):
        layers = _values(script, value, f"line {number}")
        if verb == "set":
            script.patterns[name] = layers
        elif verb == "add":
            script.patterns[name] = _bounded([*(kept or ()), *layers], f"line {number}")
        elif verb == "remove":
            script.patterns[name] = [layer for layer in kept or () if layer not in layers]
        return bool(value)
    if verb == "set" and (source := script.items.get(_name(value))):
        copy = list(source.layers)
        made = _MadeBanner(source.base, name, number, copy, list(copy))
    elif verb in ("set", "add") and (dye := _base(words)):
        made = _MadeBanner(dye, name if verb == "set" else "", number)
    else:
        return item is not None
    script.made.append(made)
    if verb == "set":
        script.items[name] = made
    return True


def _base(words: str) -> str | None:
    """The dye of the banner that words name, or None."""
    match = _BASE.search(words)
    dyes = (match[1], match[1].rpartition(" ")[2]) if match else ()
    return next((dye_name(dye) for dye in dyes if is_dye(dye)), None)


def _name(words: str) -> str:
    """A variable, a slot or a block, as one spelling of it."""
    return " ".join(words.lower().removeprefix("the ").split())


def _place(words: str) -> tuple[str, int] | None:
    """The banner whose patterns the words name, and the number of one, or 0 for all."""
    match = next((m for form in _PATTERNS if (m := form.fullmatch(words.strip()))), None)
    return (_name(match["of"]), int(match["n"] or 0)) if match else None


def _item(script: _Script, of: str) -> _MadeBanner:
    if of not in script.items:
        name = of if of.startswith("{") else shown(of)
        raise DesignError(
            f"{name}: the base is missing: add the line 'set {of} to white banner' above"
        )
    return script.items[of]


def _parts(value: str) -> list[str]:
    parts = (part.strip(" ()") for part in re.split(r",| and ", value))
    return [_name(part) for part in parts if part]


def _values(script: _Script, value: str, at: str) -> list[Layer]:
    """The layers that an expression names."""
    layers: list[Layer] = []
    for part in _parts(value):
        match = _LAYER.fullmatch(part)
        place = _place(part)
        if match:
            layers.append(_layer(match, at))
        elif part in script.patterns:
            layers += script.patterns[part]
        elif place and place[0] in script.items:
            of, number = place
            layers += script.items[of].layers[max(number - 1, 0) : number or None]
        else:
            raise DesignError(
                f"{at}: {shown(part)} is not a pattern that is known here; write it as"
                " creeper banner pattern colored lime"
            )
    return _bounded(layers, at)


def _bounded(layers: list[Layer], at: str) -> list[Layer]:
    """The layers, which lines such as `add {_p::*} to {_p::*}` double. A list may be long."""
    if len(layers) > _MOST_KEPT:
        check_count(len(layers), at)
    return layers


def _change(item: _MadeBanner, verb: str, index: int, given: list[Layer], at: str) -> None:
    """Change a banner's patterns as Skript does. index: of one pattern from 1, or 0 for all."""
    layers = item.layers
    if index and (verb in ("add", "remove") or len(given) != (verb == "set")):
        raise DesignError(f"{at}: one pattern by its number can only be set to one, or cleared")
    if index and verb == "set":
        check_count(index, at)
        layers += [_FILLER] * (index - len(layers))
        layers[index - 1] = given[0]
    elif index:
        del layers[index - 1 : index]
    elif verb == "add":
        item.layers = _bounded(layers + given, at)
    elif verb == "remove":
        layers[:] = [layer for layer in layers if layer not in given]
    else:
        layers[:] = given


def _layer(match: "re.Match[str]", at: str) -> Layer:
    words = match[1].lower().strip()
    pattern = _NAMES.get(words) or _ALSO.get(words) or pattern_id(words, at)
    return Layer(pattern, dye_name(match[2], at))


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
