"""The names that the game shows in other languages, and a tooltip or shorthand with them.

`Rotes Banner, Weißer Creeper`, or `rot creeper:weiß`. The names are in `languages.json`: for each
language the dyes, the forms that dyes take within a phrase, and for each pattern which form it
takes, and the words before and after the dye, with the capital letters of titles. Words for
`banner` and `shield` are stems.
"""

import json
import re
import unicodedata
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.formats.tree import check_count
from drapery.banner.names import is_pattern, pattern_id, shown
from drapery.errors import DesignError

_LONGEST = 4000
_BREAK = re.compile("[,;、，；]")
_COLONS = str.maketrans({"：": ":"})
_MOST_ENDING = 3
_SHORTEST = 3
_MOST_WORDS = 8


@dataclass(frozen=True)
class Language:
    """The names of one language, in small letters.

    name: as the game spells it, such as `de_de`. banner, shield: stems of the two words.
    dyes: the dye of each name and form. patterns: the pattern of each name that is unique.
    phrases: the layer of each phrase with a pattern and a dye.
    """

    name: str
    banner: str
    shield: str
    dyes: dict[str, str]
    patterns: dict[str, str]
    phrases: dict[str, Layer]


@cache
def known_languages() -> tuple[Language, ...]:
    """Every language of the data file."""
    return tuple(_language(name, entry) for name, entry in _data().items())


@cache
def _data() -> dict[str, Any]:
    data: dict[str, Any] = json.loads(
        files(__package__).joinpath("languages.json").read_text("utf-8")
    )
    return data


def _language(name: str, entry: dict[str, object]) -> Language:
    forms: list[list[str]] = entry["forms"]  # type: ignore[assignment]
    titles: dict[str, tuple[int, str, str]] = entry["patterns"]  # type: ignore[assignment]
    patterns = {p: (form, b.lower(), a.lower()) for p, (form, b, a) in titles.items()}
    dyes = {
        word: dye
        for words in [*forms[::-1], entry["dyes"]]
        for word, dye in zip(words, DYE_NAMES, strict=True)  # type: ignore[call-overload]
    }
    phrases = {
        before + word + after: Layer(pattern, dye)
        for pattern, (form, before, after) in patterns.items()
        for word, dye in zip(forms[form], DYE_NAMES, strict=True)
    }
    alone = {p: " ".join((before + after).split()) for p, (_, before, after) in patterns.items()}
    count = Counter(alone.values())
    unique = {word: pattern for pattern, word in alone.items() if word and count[word] == 1}
    return Language(name, str(entry["banner"]), str(entry["shield"]), dyes, unique, phrases)


def game_languages() -> tuple[str, ...]:
    """The names of the languages with titles, such as `de_de`."""
    return tuple(_data())


def game_titles(name: str) -> tuple[dict[str, str], dict[str, str]]:
    """The titles of dyes and of patterns in a language such as `de_de`, by their ids."""
    entry = _data()[name]
    dyes = {dye: _title(word) for dye, word in zip(DYE_NAMES, entry["dyes"], strict=True)}
    patterns = {
        pattern: _title(" ".join((before + after).split()))
        for pattern, (_, before, after) in entry["patterns"].items()
    }
    return dyes, patterns


def _title(words: str) -> str:
    # In Chinese and Japanese the word for colour follows the dye, which is left out here.
    words = words.removeprefix("色の").removeprefix("色")
    return words[:1].upper() + words[1:]


def may_be(text: str) -> bool:
    """Whether a short text without brackets could be in one of the languages."""
    return len(text) <= _LONGEST and not set("{}[]=/<>@").intersection(text)


def is_known(text: str) -> bool:
    """Whether the text begins with a dye, an item's name or a layer of one of the languages."""
    if not may_be(text):
        return False
    text = _small(text)
    return any(_parse(text, language) for language in possible_languages(text))


@cache
def _starts() -> tuple[dict[str, set[str]], dict[str, set[str]]]:
    """The languages of each dye or layer that a text may begin with, and of each item's stem."""
    names: dict[str, set[str]] = {}
    stems: dict[str, set[str]] = {}
    for language in known_languages():
        for name in (*language.dyes, *language.phrases):
            names.setdefault(name, set()).add(language.name)
        for stem in (language.banner, language.shield):
            stems.setdefault(stem, set()).add(language.name)
    return names, stems


def possible_languages(text: str) -> list[Language]:
    """The languages that can have a text in small letters, by the first of its words.

    One table of all languages is asked, since most texts are of none.
    """
    names, stems = _starts()
    first = next((line for line in text.split("\n") if _BREAK.sub("", line).strip()), "")
    found: set[str] = set()
    for head in {" ".join(first.split()), next(_parts(first), "")}:
        words = re.split("[ :]", head, maxsplit=_MOST_WORDS)
        for count in range(1, len(words) + 1):
            found |= names.get(" ".join(words[:count]), set())
        found |= names.get(head, set())
        found = found.union(*(its for stem, its in stems.items() if stem in head))
    return [language for language in known_languages() if language.name in found]


def _parts(line: str) -> Iterator[str]:
    """The parts of a line between its commas."""
    return (piece for part in _BREAK.split(" ".join(line.split())) if (piece := part.strip()))


def _small(text: str) -> str:
    return unicodedata.normalize("NFC", text).lower().translate(_COLONS)


def parse(text: str) -> Banner:
    """Read a tooltip or a shorthand in any of the languages.

    Raises DesignError if no language fits, or if languages read it in different ways.
    """
    if not may_be(text):
        raise DesignError(f"{shown(text)}: not a name that the game shows in a known language")
    text = _small(text)
    read = {language.name: _parse(text, language) for language in possible_languages(text)}
    found = {name: banner for name, banner in read.items() if isinstance(banner, Banner)}
    if len(set(found.values())) > 1:
        raise DesignError(
            f"{shown(text)}: read in different ways in {', '.join(found)};"
            " write the patterns' ids, such as 'white creeper:lime'"
        )
    if not found:
        raise DesignError(_best(text, [fault for fault in read.values() if isinstance(fault, str)]))
    return next(iter(found.values()))


def _best(text: str, faults: list[str]) -> str:
    """The fault of the language that came furthest."""
    told = [fault for fault in faults if fault]
    if told:
        return told[0]
    names = ", ".join(language.name for language in known_languages())
    return f"{shown(text)}: not a name that the game shows; known languages are {names}"


def _parse(text: str, language: Language) -> Banner | str:
    """The banner, or what is wrong: empty if the text is not of the language."""
    pieces = [piece for line in text.split("\n") for piece in _pieces(line, language)]
    if not pieces:
        return ""
    if pieces[0] in language.phrases and _is_foreign(pieces[0]):
        return (
            f"{shown(pieces[0])}: this is a layer, but the base is missing:"
            f" write the banner's name in the first line ({language.name})"
        )
    head, *rest = pieces
    words = head.split(" ")
    kind = "shield" if language.shield in head else "banner"
    base, used = _base(words, language)
    if base is None:
        return ""
    entries = [*_shorthand(words[used:]), *rest]
    layers = []
    for number, entry in enumerate(entries, 1):
        layer = _layer(entry, language)
        if layer is None:
            return (
                f"layer {number} {shown(entry)}: not a name of a pattern with its dye"
                f" ({language.name}): copy the tooltip, or write pattern:dye"
            )
        layers.append(layer)
    check_count(len(layers), "the text")
    return Banner(base, tuple(layers), "shield" if kind == "shield" else "banner")


def _pieces(line: str, language: Language) -> list[str]:
    """The parts of a line between its commas; a layer's phrase with a comma is one part."""
    line = " ".join(line.split())
    if line in language.phrases:
        return [line]
    return [*_parts(line)]


def _is_foreign(piece: str) -> bool:
    return any(not character.isascii() for character in piece) or " " in piece


def _base(words: list[str], language: Language) -> tuple[str | None, int]:
    """The dye at the start of the first line, and how many words tell it."""
    colons = [number for number, word in enumerate(words) if ":" in word]
    end = min(len(words) if not colons else colons[0], _MOST_WORDS)
    for count in range(end, 0, -1):
        text = " ".join(words[:count])
        dye = language.dyes.get(text) or _dye_of_item(text, language)
        if dye is not None:
            return dye, count
    return None, 0


def _dye_of_item(text: str, language: Language) -> str | None:
    """The dye of an item's name: `rotes banner`, `bannière blanche`, `红色旗帜`."""
    stem = next((stem for stem in (language.banner, language.shield) if stem in text), None)
    if stem is None:
        return None
    if stem.isascii() or " " in text:
        rest = " ".join(word for word in text.split(" ") if stem not in word)
    else:
        rest = text.replace(stem, "").removesuffix("の").strip()
    return language.dyes.get(rest) or _inflected(rest, language)


def _inflected(text: str, language: Language) -> str | None:
    """The dye of which a text is another form: `blanche` is `blanc`."""
    found = [
        dye
        for name, dye in language.dyes.items()
        if len(name) >= _SHORTEST
        and text.startswith(name)
        and len(text) - len(name) <= _MOST_ENDING
    ]
    return found[0] if len(set(found)) == 1 else None


def _shorthand(words: list[str]) -> list[str]:
    """The layers `pattern:dye` in a row of words; a pattern or a dye may have several words."""
    if not any(":" in word for word in words):
        return [" ".join(words)] if words else []
    entries: list[list[str]] = [[]]
    for word in words:
        entries[-1].append(word)
        if ":" in word:
            entries.append([])
    return [" ".join(entry) for entry in entries if entry]


def _layer(entry: str, language: Language) -> Layer | None:
    if entry in language.phrases:
        return language.phrases[entry]
    name, colon, dye = (part.strip() for part in entry.rpartition(":"))
    if not colon or dye not in language.dyes:
        return None
    if name in language.patterns:
        return Layer(language.patterns[name], language.dyes[dye])
    # Ids are the same in every language.
    return Layer(pattern_id(name), language.dyes[dye]) if is_pattern(name) else None
