"""A blazon as a row of terms, and the words in it that a banner cannot show."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from drapery.banner.blazon.vocabulary import (
    FIELD_STARTS,
    MOST_WORDS,
    OPENINGS,
    TINCTURES,
    Term,
    normal,
    term_of,
)
from drapery.banner.names import is_custom, shown
from drapery.errors import DesignError

MAX_BLAZON = 4000
"""Most characters of a blazon."""

_WORD = re.compile(r"[a-z0-9_.-]+:[a-z0-9_./-]+(?=[\s,;]|$)|[^\W_]+(?:['’][^\W_]+)*|[^\s_-]")
_STOPS = frozenset(",;:.!()")


@dataclass(frozen=True)
class Spoken:
    """A term where it stands in a text. start: its first character. words: as they are written."""

    term: Term
    start: int
    words: str
    after_comma: bool = False


@dataclass(frozen=True)
class Terms:
    """The terms of a text. unknown: the words that are not terms, neighbours together."""

    spoken: list[Spoken]
    unknown: list[str]


def read_terms(text: str) -> Terms:
    """The terms of a text. Raises DesignError for a text that is too long or not a blazon."""
    if not text.strip():
        raise DesignError("the blazon is empty: write one, such as 'Azure, a bend Or'")
    if len(text) > MAX_BLAZON:
        raise DesignError(f"the blazon has {len(text)} characters, over {MAX_BLAZON}: shorten it")
    spoken = list(_spoken(text))
    if not any(one.term.kind in ("TINCTURE", "DIVISION") for one in spoken):
        raise DesignError(
            f"{shown(text)}: not a blazon; begin with the tincture of the field,"
            " as in 'Azure, a bend Or'"
        )
    unknown = [one.words for one in spoken if one.term.kind == "UNKNOWN"]
    return Terms(list(_arranged(spoken)), unknown)


def begins_as_blazon(text: str) -> bool:
    """Whether the first words are of heraldry alone, such as `Azure`, `per pale` or `Arms:`."""
    openings, first = _beginning(text)
    if first is None:
        return False
    return (
        first.term.kind == "DIVISION"
        or (first.term.kind == "TINCTURE" and first.term.value in TINCTURES)
        or (first.term.kind == "TINCTURE" and not _HERALDIC_OPENINGS.isdisjoint(openings))
        or first.words.lower().split()[0] in FIELD_STARTS
    )


def begins_with_dye(text: str) -> bool:
    """Whether the first words are a dye and a comma, as in `Lime, a bend Or`, or an opening."""
    openings, first = _beginning(text)
    is_dye = first is not None and first.term.kind == "TINCTURE"
    return is_dye and bool(openings or "," in text[:_HEAD])


_HERALDIC_OPENINGS = frozenset({"arms", "the arms", "blazon"})
_HEAD = 60


def _beginning(text: str) -> tuple[list[str], Spoken | None]:
    """The openings of a text, and the first term after them."""
    openings: list[str] = []
    for one in _spoken(text[:200]):
        if one.term.kind != "OPENING":
            return openings, one
        openings.append(one.term.value)
    return openings, None


def _spoken(text: str) -> Iterator[Spoken]:
    """The terms, the longest first, and what is not known as one UNKNOWN up to the next term."""
    matches = list(_WORD.finditer(text))
    words = [normal(match[0]) for match in matches]
    place, comma, unknown, is_start = 0, False, -1, True
    while place < len(words):
        found, count = _longest(words, place, is_start)
        is_stop = words[place] in _STOPS
        if found is None and not is_stop:
            unknown, is_start = place if unknown < 0 else unknown, False
            place += 1
            continue
        if unknown >= 0:
            yield _unknown(text, matches, unknown, place)
            unknown = -1
        if found is not None and found.kind != "NOISE":
            start, end = matches[place].start(), matches[place + count - 1].end()
            yield Spoken(found, start, text[start:end], comma)
        comma = is_stop
        is_start = is_start and (is_stop or found is None or found.kind == "OPENING")
        place += count
    if unknown >= 0:
        yield _unknown(text, matches, unknown, place)


def _unknown(text: str, matches: list[re.Match[str]], first: int, end: int) -> Spoken:
    start = matches[first].start()
    return Spoken(Term("UNKNOWN"), start, text[start : matches[end - 1].end()])


def _longest(words: list[str], place: int, is_start: bool) -> tuple[Term | None, int]:
    for count in range(min(MOST_WORDS, len(words) - place), 0, -1):
        part = " ".join(words[place : place + count])
        if is_start and part in OPENINGS:
            return Term("OPENING", part), count
        if found := term_of(part):
            return found, count
    return (Term("NOUN", words[place]), 1) if is_custom(words[place]) else (None, 1)


def _arranged(spoken: list[Spoken]) -> Iterator[Spoken]:
    """The terms as the grammar takes them: without idle `and`, and with both kinds of place.

    An unknown word is a noun where one is due, as in `a lion Or`, and else is left out.
    """
    previous = ""
    for number, one in enumerate(spoken):
        kind = one.term.kind
        following = spoken[number + 1].term.kind if number + 1 < len(spoken) else ""
        if kind == "AND" and (one.after_comma or following not in _PHRASE_STARTS):
            continue
        if kind == "UNKNOWN":
            if previous not in ("COUNT", "BETWEEN", "ON", "AND", "PLACE") or following == "NOUN":
                continue
            one, kind = replace(one, term=Term("NOUN", "")), "NOUN"
        if kind == "PLACE" and following not in ("COUNT", "NOUN", "UNKNOWN"):
            one = replace(one, term=one.term._replace(kind="PLACE_AFTER"))
        previous = kind
        yield one


_PHRASE_STARTS = frozenset(
    {"COUNT", "NOUN", "PLACE", "UNKNOWN", "ON", "BETWEEN", "WITHIN", "OVERALL", "MASONED"}
)
