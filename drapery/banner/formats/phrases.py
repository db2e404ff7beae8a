"""A banner in plain English: `red banner with white skull`, `white creeper lime border black`.

The base is the dye before `banner`, `shield`, `field` or `background`, or after `on`, or else the
first dye. Then each pattern has its dye before it, or each has it after it.
"""

import re
from itertools import pairwise
from typing import NamedTuple

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.tree import check_count
from drapery.banner.names import dye_name, is_dye, is_pattern, pattern_id, plain, shown
from drapery.errors import DesignError

_LONGEST = 1000
_MOST_WORDS = 5
_BASES = frozenset({"banner", "shield", "field", "background", "flag", "cloth"})
_JOINS = frozenset({"with", "on", "and"})
_FILLERS = frozenset(
    {
        *("a", "an", "the", "and", "with", "of", "in", "then", "has", "having"),
        *("plain", "coloured", "colored", "charge", "pattern", "it", "its", "at", "to", "by"),
    }
)
_ALSO = {
    "top_stripe": "stripe_top",
    "bottom_stripe": "stripe_bottom",
    "left_stripe": "stripe_left",
    "right_stripe": "stripe_right",
    "center_stripe": "stripe_center",
    "centre_stripe": "stripe_center",
    "vertical_stripe": "stripe_center",
    "middle_stripe": "stripe_middle",
    "horizontal_stripe": "stripe_middle",
    "stripes": "small_stripes",
    "vertical_stripes": "small_stripes",
    "top_half": "half_horizontal",
    "bottom_half": "half_horizontal_bottom",
    "left_half": "half_vertical",
    "right_half": "half_vertical_right",
    "top_triangle": "triangle_top",
    "bottom_triangle": "triangle_bottom",
    "dot": "circle",
    "diamond": "rhombus",
    "x": "cross",
    "plus": "straight_cross",
    "daisy": "flower",
    "wither_skull": "skull",
    "indented_border": "curly_border",
    "pig": "piglin",
    "mojang_logo": "mojang",
}


class _Word(NamedTuple):
    """What some words of the text mean: a `dye`, a `pattern`, a `base` or `on`, and its name."""

    kind: str
    name: str
    text: str


def parse(text: str) -> Banner:
    """Read the phrase. Raises DesignError naming the word, or what is missing."""
    if len(text) > _LONGEST or not re.fullmatch(r"[\w\s,.&+-]+", text) or "\n" in text.strip():
        raise DesignError(f"{shown(text)}: not a banner in English words")
    words = _words(re.sub(r"[\s,.&+]+", " ", text).split())
    base, rest, kind = _base(words)
    layers = _layers(rest)
    check_count(len(layers), "the text")
    return Banner(base, layers, "shield" if kind == "shield" else "banner")


def resembles(text: str) -> bool:
    """Whether a text that cannot be read was probably meant as a phrase."""
    words = text.split()
    if len(words) < 3 or ":" in text or set("\n,;").intersection(text.strip()):
        return False
    joins = not _JOINS.isdisjoint(plain(word) for word in words)
    return any(map(is_dye, words)) and (joins or any(map(is_pattern, words)))


def _words(words: list[str]) -> list[_Word]:
    """The dyes, the patterns and the words for the base, the longest names first."""
    found: list[_Word] = []
    place = 0
    while place < len(words):
        for count in range(min(_MOST_WORDS, len(words) - place), 0, -1):
            word = _word(" ".join(words[place : place + count]))
            if word is not None:
                found.append(word)
                place += count
                break
        else:
            if plain(words[place]) not in _FILLERS:
                pattern_id(words[place], "not a dye or a pattern of a banner in words")
            place += 1
    return found


def _word(text: str) -> _Word | None:
    name = plain(text)
    if name in _FILLERS:
        return None
    if name in ("on", "over"):
        return _Word("on", name, text)
    if name in _BASES:
        return _Word("base", name, text)
    if is_dye(text):
        return _Word("dye", dye_name(text), text)
    pattern = _ALSO.get(name)
    if pattern is None and len(name) > 1 and is_pattern(text):
        pattern = pattern_id(text)
    return _Word("pattern", pattern, text) if pattern else None


def _base(words: list[_Word]) -> tuple[str, list[_Word], str]:
    """The base dye, the words of the layers, and whether it is a shield."""
    marks = [number for number, word in enumerate(words) if word.kind == "base"]
    kind = "shield" if any(words[mark].name == "shield" for mark in marks) else "banner"
    before = (mark - 1 for mark in marks if mark and words[mark - 1].kind == "dye")
    after = (n + 1 for n, (word, dye) in enumerate(pairwise(words)) if _is_ground(word, dye))
    place = next(before, next(after, 1 if _begins_with_mark(words) else 0))
    if not words or words[place].kind != "dye":
        raise DesignError(
            "the base is missing: write the banner's dye, as in 'red banner with white skull'"
        )
    rest = [word for n, word in enumerate(words) if n != place and word.kind in ("dye", "pattern")]
    return words[place].name, rest, kind


def _begins_with_mark(words: list[_Word]) -> bool:
    """Whether the base follows the word for the item, as in `shield red with black border`."""
    kinds = [word.kind for word in words[:3]]
    return kinds == ["base", "dye"] or kinds == ["base", "dye", "dye"]


def _is_ground(word: _Word, dye: _Word) -> bool:
    return word.kind == "on" and dye.kind == "dye"


def _layers(words: list[_Word]) -> tuple[Layer, ...]:
    """The layers of an alternating row of dyes and patterns."""
    pairs = list(zip(words[::2], words[1::2], strict=False))
    kinds = {(first.kind, second.kind) for first, second in pairs}
    if len(words) % 2 or len(kinds) > 1 or kinds & {("dye", "dye"), ("pattern", "pattern")}:
        odd = _odd_one(words)
        lacks = "dye" if odd.kind == "pattern" else "pattern"
        raise DesignError(
            f"{shown(odd.text)} has no {lacks}: the base and every pattern need a dye,"
            " as in 'red banner with white skull'"
        )
    return tuple(
        Layer(second.name, first.name) if first.kind == "dye" else Layer(first.name, second.name)
        for first, second in pairs
    )


def _odd_one(words: list[_Word]) -> _Word:
    """The word whose neighbour is not what it should be."""
    for first, second in pairwise(words):
        if first.kind == second.kind:
            return second if first.kind == "pattern" else first
    return words[-1]
