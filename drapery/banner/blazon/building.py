"""From the parts of a blazon to the layers of a banner."""

from dataclasses import dataclass, replace
from typing import Literal

from drapery.banner.blazon.problems import refusal
from drapery.banner.blazon.terms import Spoken
from drapery.banner.blazon.vocabulary import (
    CENTRAL,
    DIVISIONS,
    FIRST_ON_PATTERN,
    INSIDE,
    OUTSIDE,
    PLACED,
    SPLIT,
    THROUGH_CENTRE,
)
from drapery.banner.design import Banner, Layer
from drapery.banner.names import is_custom
from drapery.banner.patterns import PATTERNS
from drapery.errors import DesignError


@dataclass(frozen=True)
class BlazonField:
    """The field. division: None if it is of one tincture. tinctures: in the order of the text."""

    division: Spoken | None
    tinctures: tuple[Spoken, ...]


@dataclass(frozen=True)
class Charge:
    """An ordinary or a charge.

    start, words: where it stands in the text. noun: a pattern, a key of PLACED, or empty if it is
    not known. dye: of a noun that has its own. colour: None if the text gives it later. below: the
    charge on which it lies.
    """

    start: int
    words: str
    noun: str
    dye: str
    count: int
    place: str
    colour: Spoken | None
    below: "Charge | None" = None

    @staticmethod
    def of(parts: list[Spoken]) -> "Charge":
        """The charge that some terms of one phrase are."""
        by_kind = {part.term.kind: part for part in parts}
        noun = by_kind.get("NOUN") or by_kind["MASONED"]
        count, place = by_kind.get("COUNT"), by_kind.get("PLACE") or by_kind.get("PLACE_AFTER")
        colour = next((by_kind[k] for k in _COLOURS if k in by_kind), None)
        told = [part for part in (count, noun, place) if part is not None]
        return Charge(
            parts[0].start,
            " ".join(part.words for part in sorted(told, key=lambda part: part.start)),
            "bricks" if noun.term.kind == "MASONED" else noun.term.value,
            noun.term.dye,
            int(count.term.value) if count else 1,
            place.term.value if place else "",
            colour,
        )

    def on(self, below: "Charge") -> "Charge":
        """The same charge, lying on another."""
        return replace(self, below=below)

    @property
    def patterns(self) -> tuple[str, ...]:
        """The patterns that show it; empty if there are none."""
        found = PLACED.get((self.noun, min(self.count, _MANY), self.place))
        if found is None and self.noun == "triangle" and self.count > _MANY:
            found = PLACED.get((self.noun, 3, self.place))
        is_here = not self.place or (self.place == "centre" and self.noun in THROUGH_CENTRE)
        is_here = is_here or PLACED.get((self.noun, 1, self.place)) == (self.noun,)
        if found is None and self.count == 1 and is_here:
            known = self.noun in PATTERNS or is_custom(self.noun)
            found = (self.noun,) if known else None
        return found or ()

    @property
    def problem(self) -> str:
        """What of it a banner cannot show; empty if nothing."""
        words = " ".join(self.words.split())
        if self.noun and not self.patterns:
            return f"'{words}' (a banner has {'it at one place' if self.place else 'only one'})"
        base = self.below
        if base is None or not CENTRAL.intersection(self.patterns):
            return ""
        if base.patterns and not THROUGH_CENTRE.intersection(base.patterns):
            return f"'{words}' on '{base.words}' (charges stand at the centre of a banner)"
        return ""


_MANY = 5
_COLOURS = ("TINCTURE", "REFERENCE", "COUNTERCHANGED")
_LEAST, _MOST_TINCTURES = 2, 3


def build(
    field: BlazonField, charges: list[Charge], unknown: list[str], kind: Literal["banner", "shield"]
) -> Banner:
    """The banner of a field and of charges, lowest first.

    unknown: words that are not terms. Raises DesignError that names all that cannot be shown.
    """
    problems = [f"'{' '.join(words.split())}'" for words in unknown]
    problems += [problem for charge in charges if (problem := charge.problem)]
    base, layers = "", list[Layer]()
    try:
        base, layers = _field(field)
        layers += _layers(field, charges, problems)
    except DesignError:
        if not problems:  # what cannot be shown comes first
            raise
    if problems:
        raise refusal(problems)
    return Banner(base, tuple(layers), kind)


def _layers(field: BlazonField, charges: list[Charge], problems: list[str]) -> list[Layer]:
    """The layers of the charges. What cannot be counterchanged is added to `problems`."""
    dyes = _dyes(field, charges)
    layers: list[Layer] = []
    for charge in charges:
        dye = dyes[charge.start]
        if dye is not None:
            layers += [Layer(pattern, dye) for pattern in charge.patterns]
            continue
        pairs = [_counterchanged(pattern, field) for pattern in charge.patterns]
        if not all(pairs):
            problems.append(f"'{charge.words} counterchanged' (it lies on both parts)")
        layers += [Layer(pattern, dye) for some in pairs for pattern, dye in some]
    return layers


def _field(field: BlazonField) -> tuple[str, list[Layer]]:
    """The base and the layers of a field."""
    dyes = [one.term.dye for one in field.tinctures]
    if field.division is None:
        return dyes[0], []
    name = field.division.term.value
    patterns = DIVISIONS[name]
    count = _MOST_TINCTURES if name.startswith("tierced") else _LEAST
    if len(dyes) != count:
        raise DesignError(
            f"{field.division.words!r} has {len(dyes)} tincture{'s' * (len(dyes) != 1)};"
            f" write {count}, as in '{name} {_EXAMPLES[count]}'"
        )
    if count == _MOST_TINCTURES:
        first, base, last = dyes
        return base, [Layer(patterns[0], first), Layer(patterns[1], last)]
    first, second = dyes
    if name == "quarterly":
        colours = (first, second, first)
        return second, [Layer(p, dye) for p, dye in zip(patterns, colours, strict=True)]
    base, dye = (second, first) if name in FIRST_ON_PATTERN else (first, second)
    return base, [Layer(pattern, dye) for pattern in patterns]


_EXAMPLES = {2: "Argent and Gules", 3: "Azure, Argent and Gules"}


def _dyes(field: BlazonField, charges: list[Charge]) -> dict[int, str | None]:
    """The dye of each charge by its place in the text; None for one that is counterchanged.

    Raises DesignError for a charge without a tincture.
    """
    mentioned = list(dict.fromkeys(one.term.dye for one in field.tinctures))
    last = field.tinctures[-1].term.dye
    found: dict[int, str | None] = {}
    waiting: list[Charge] = []
    for charge in sorted(charges, key=lambda charge: charge.start):
        if charge.dye:
            found[charge.start] = last = charge.dye
            continue
        waiting.append(charge)
        colour = charge.colour
        if colour is None:
            continue
        dye = None
        if colour.term.kind != "COUNTERCHANGED":
            dye = colour.term.dye or _referred(colour, field, mentioned, last)
            mentioned += [dye] if dye not in mentioned else []
            last = dye
        found |= {one.start: dye for one in waiting}
        waiting = []
    if waiting:
        words = waiting[-1].words
        raise DesignError(f"'{words}' has no tincture; write one, as in '{words} Or'")
    return found


def _referred(colour: Spoken, field: BlazonField, mentioned: list[str], last: str) -> str:
    """The dye of `of the field`, `of the second` or `of the last`."""
    value = colour.term.value
    if value == "last":
        return last
    if value == "field":
        if field.division is not None:
            raise DesignError(f"{colour.words!r}: the field has two tinctures; name one of them")
        return field.tinctures[0].term.dye
    if int(value) > len(mentioned):
        raise DesignError(
            f"{colour.words!r}: tinctures before it: {len(mentioned)}; name the tincture itself"
        )
    return mentioned[int(value) - 1]


def _counterchanged(pattern: str, field: BlazonField) -> list[tuple[str, str]]:
    """The patterns and dyes that show a pattern with the tinctures of the field exchanged.

    Empty if no patterns show it: if it crosses the line of the division.
    """
    if field.division is None or len(field.tinctures) != _LEAST:
        raise DesignError("'counterchanged' needs a field of two tinctures, such as 'per pale'")
    name = field.division.term.value
    patterns = DIVISIONS[name]
    first, second = (one.term.dye for one in field.tinctures)
    on_pattern, on_base = (first, second) if name in FIRST_ON_PATTERN else (second, first)
    if len(patterns) != 1:
        return []
    if pattern in INSIDE.get(patterns[0], ()):
        return [(pattern, on_base)]
    if pattern in OUTSIDE.get(patterns[0], ()):
        return [(pattern, on_pattern)]
    if name == "per pale" and pattern in SPLIT:
        dexter, sinister = SPLIT[pattern]
        return [(dexter, on_base), (sinister, on_pattern)]
    return []
