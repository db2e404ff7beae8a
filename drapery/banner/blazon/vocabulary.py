"""The words of blazon: tinctures, divisions, ordinaries, charges, places and numbers.

Dexter is the viewer's left. The terms are those of J. Parker, "A Glossary of Terms Used in
Heraldry" (1894), and the names that the game itself gives to its patterns.
"""

import unicodedata
from functools import cache
from typing import NamedTuple

from drapery.banner.dyes import DYE_NAMES
from drapery.banner.patterns import PATTERNS


class Term(NamedTuple):
    """What some words mean. kind: a terminal of the grammar. value, dye: as the kind has them."""

    kind: str
    value: str = ""
    dye: str = ""


TINCTURES = {
    **{"argent": "white", "silver": "white", "ermine": "white", "pearl": "white"},
    **{"or": "yellow", "gold": "yellow", "golden": "yellow", "erminois": "yellow"},
    **{"gules": "red", "azure": "blue", "vert": "green", "sinople": "green", "purpure": "purple"},
    **{"sable": "black", "ermines": "black", "pean": "black"},
    **{"tenny": "orange", "tenne": "orange", "tawny": "orange", "copper": "orange"},
    **{"murrey": "magenta", "mulberry": "magenta", "sanguine": "brown", "brunatre": "brown"},
    **{"bleu celeste": "light_blue", "celeste": "light_blue", "vair": "light_blue"},
    **{"carnation": "pink", "cendree": "light_gray", "iron": "gray", "steel": "light_gray"},
}
"""The dye of each heraldic tincture. A fur has the dye of its ground."""

_DYES = {
    **{dye.replace("_", " "): dye for dye in DYE_NAMES},
    **{"grey": "gray", "light grey": "light_gray", "dark gray": "gray", "dark grey": "gray"},
    **{"dark green": "green", "light green": "lime"},
}
"""The names of the dyes."""

DYE_WORDS = {
    **{"white": "Argent", "orange": "Tenny", "magenta": "Murrey", "light_blue": "Bleu-celeste"},
    **{"yellow": "Or", "purple": "Purpure", "blue": "Azure", "green": "Vert", "red": "Gules"},
    **{"black": "Sable", "lime": "Lime", "pink": "Pink", "gray": "Gray", "cyan": "Cyan"},
    **{"light_gray": "Light gray", "brown": "Brown"},
}
"""The word that is written for each dye. Dyes without a tincture have the game's own name."""

DIVISIONS = {
    "per pale": ("half_vertical",),
    "per fess": ("half_horizontal",),
    "per bend": ("diagonal_right",),
    "per bend sinister": ("diagonal_left",),
    "per chevron inverted": ("triangle_top",),
    "per chevron": ("triangle_bottom",),
    "per saltire": ("triangle_top", "triangle_bottom"),
    "quarterly": ("half_vertical", "square_bottom_left", "square_bottom_right"),
    "paly": ("small_stripes",),
    "barry": ("stripe_top", "stripe_middle", "stripe_bottom"),
    "tierced per pale": ("stripe_left", "stripe_right"),
    "tierced per fess": ("stripe_top", "stripe_bottom"),
}
"""The patterns of each division of the field."""

_DIVISION_ALSO = {
    **{"per cross": "quarterly", "quartered": "quarterly"},
    **{"per chevron reversed": "per chevron inverted", "per pile": "per chevron inverted"},
    **{"per pile inverted": "per chevron", "per pile reversed": "per chevron"},
    **{"tierced in pale": "tierced per pale", "tierced in fess": "tierced per fess"},
    **{"tierced": "tierced per pale", "tierced paleways": "tierced per pale"},
}

FIRST_ON_PATTERN = frozenset(
    {"per pale", "per fess", "per bend", "per bend sinister", "per chevron inverted"}
    | {"per saltire", "quarterly", "barry"}
)
"""The divisions whose first tincture the pattern has, and whose second the base has."""

NAMES = {
    **{"base": "a field", "stripe_bottom": "a base", "stripe_top": "a chief"},
    **{"stripe_left": "a pale dexter", "stripe_right": "a pale sinister"},
    **{"stripe_center": "a pale", "stripe_middle": "a fess", "stripe_downright": "a bend"},
    **{"stripe_downleft": "a bend sinister", "small_stripes": "four pallets"},
    **{"cross": "a saltire", "straight_cross": "a cross", "triangle_bottom": "a chevron"},
    **{"triangle_top": "a chevron inverted", "triangles_bottom": "a base indented"},
    **{"triangles_top": "a chief indented", "diagonal_left": "the dexter chief half"},
    **{"diagonal_right": "the sinister chief half", "diagonal_up_left": "the dexter base half"},
    **{"diagonal_up_right": "the sinister base half", "circle": "a roundel"},
    **{"rhombus": "a lozenge", "half_vertical": "the dexter half"},
    **{"half_vertical_right": "the sinister half", "half_horizontal": "the chief half"},
    **{"half_horizontal_bottom": "the base half", "border": "a bordure"},
    **{"curly_border": "a bordure indented", "gradient": "a gradient"},
    **{"gradient_up": "a base gradient", "bricks": "masoned", "globe": "a globe"},
    **{"creeper": "a creeper", "skull": "a skull", "flower": "a flower", "mojang": "a thing"},
    **{"piglin": "a snout", "flow": "a flow", "guster": "a guster"},
    **{"square_bottom_left": "a base dexter canton", "square_top_left": "a chief dexter canton"},
    **{"square_bottom_right": "a base sinister canton"},
    **{"square_top_right": "a chief sinister canton"},
}
"""The words that are written for each pattern."""

_ALSO = """
stripe_bottom: champagne, terrace, plain in base, base couped
stripe_left: dexter pale, dexter pallet, pallet dexter, dexter side, side dexter, dexter tierce
stripe_left: tierce dexter
stripe_right: sinister pale, sinister pallet, pallet sinister, sinister side, side sinister
stripe_right: sinister tierce, tierce sinister
stripe_center: pallet, stripe
stripe_middle: fesse, fess bar, bar, barrulet
stripe_downright: bendlet, bend dexter, ribbon
stripe_downleft: sinister bend, bendlet sinister, sinister bendlet, baton sinister, scarp
cross: cross saltire, saltier, st andrews cross, saint andrews cross
straight_cross: cross throughout, greek cross, st georges cross, saint georges cross
triangle_bottom: pile inverted, pile reversed, inverted pile, point, point pointed, base pointed
triangle_top: chevron reversed, inverted chevron, reversed chevron
triangles_bottom: indented base, base dancetty, base dancette
triangles_top: indented chief, chief dancetty, chief dancette
circle: disc, disk, round, ball
rhombus: rhombus, fusil, diamond
border: border
curly_border: bordure engrailed, bordure dancetty, indented bordure, engrailed bordure
curly_border: border indented, border engrailed
gradient: chief gradient, gradient in chief, shading
gradient_up: gradient in base
bricks: field masoned, masonry
globe: terrestrial globe, orb, sphere
creeper: creeper charge, creeper face, creepers face, creeper head, creepers head
skull: skull charge, skull and crossbones, skull and bones, deaths head, wither skull
flower: flower charge, daisy, oxeye daisy, rose, cinquefoil, sexfoil, octofoil
mojang: mojang logo, mojang charge, mojang, thing
piglin: piglin, piglin snout, piglins snout, pigs snout, pigs head, snout charge
flow: flow charge, spiral
guster: guster charge, breeze
square_top_left: canton, dexter canton, canton dexter, quarter, dexter chief canton, square
square_top_left: dexter quarter, franc quartier
square_top_right: sinister canton, canton sinister, sinister chief canton, sinister quarter
square_bottom_left: dexter base canton
square_bottom_right: sinister base canton
half_vertical: half per pale
half_vertical_right: half per pale inverted
half_horizontal: upper half, half per fess
half_horizontal_bottom: lower half, half per fess inverted
diagonal_right: half per bend
diagonal_up_left: half per bend inverted
diagonal_left: half per bend sinister
diagonal_up_right: half per bend sinister inverted
triangle: triangle
pile: pile, wedge
half: half
side: side, tierce, flank
"""

ROUNDELS = {
    **{
        "bezant": "yellow",
        "besant": "yellow",
        "plate": "white",
        "torteau": "red",
        "torteaux": "red",
        "hurt": "blue",
    },
    **{"pellet": "black", "ogress": "black", "gunstone": "black", "pomme": "green"},
    **{"pomeis": "green", "golpe": "purple", "guze": "brown"},
}
"""Roundels that are named by their tincture."""

_LEFT = ("square_top_left", "square_bottom_left")
_RIGHT = ("square_top_right", "square_bottom_right")
_TOP = ("square_top_left", "square_top_right")
_BOTTOM = ("square_bottom_left", "square_bottom_right")
_CORNERS = {
    **{"dexter chief": "square_top_left", "sinister chief": "square_top_right"},
    **{"dexter base": "square_bottom_left", "sinister base": "square_bottom_right"},
    **{"dexter": "square_top_left", "sinister": "square_top_right"},
}

PLACED: dict[tuple[str, int, str], tuple[str, ...]] = {
    ("stripe_center", 1, "dexter"): ("stripe_left",),
    ("stripe_center", 1, "sinister"): ("stripe_right",),
    ("stripe_center", 2, ""): ("stripe_left", "stripe_right"),
    ("stripe_center", 3, ""): ("stripe_left", "stripe_center", "stripe_right"),
    ("stripe_center", 4, ""): ("small_stripes",),
    ("stripe_middle", 1, "chief"): ("stripe_top",),
    ("stripe_middle", 1, "base"): ("stripe_bottom",),
    ("stripe_middle", 2, ""): ("stripe_top", "stripe_bottom"),
    ("stripe_middle", 3, ""): ("stripe_top", "stripe_middle", "stripe_bottom"),
    **{("square_top_left", 1, place): (corner,) for place, corner in _CORNERS.items()},
    ("square_top_left", 2, ""): _TOP,
    ("square_top_left", 2, "chief"): _TOP,
    ("square_top_left", 2, "base"): _BOTTOM,
    ("square_top_left", 2, "dexter"): _LEFT,
    ("square_top_left", 2, "sinister"): _RIGHT,
    ("square_top_left", 4, ""): (*_TOP, *_BOTTOM),
    ("triangle", 1, ""): ("triangle_bottom",),
    ("triangle", 1, "base"): ("triangle_bottom",),
    ("triangle", 1, "chief"): ("triangle_top",),
    ("triangle", 2, ""): ("triangle_top", "triangle_bottom"),
    ("triangle", 3, "chief"): ("triangles_top",),
    ("triangle", 3, "base"): ("triangles_bottom",),
    ("pile", 1, ""): ("triangle_top",),
    ("pile", 1, "chief"): ("triangle_top",),
    ("pile", 1, "base"): ("triangle_bottom",),
    ("half", 1, "dexter"): ("half_vertical",),
    ("half", 1, "sinister"): ("half_vertical_right",),
    ("half", 1, "chief"): ("half_horizontal",),
    ("half", 1, "base"): ("half_horizontal_bottom",),
    ("half", 1, "dexter chief"): ("diagonal_left",),
    ("half", 1, "sinister chief"): ("diagonal_right",),
    ("half", 1, "dexter base"): ("diagonal_up_left",),
    ("half", 1, "sinister base"): ("diagonal_up_right",),
    ("side", 1, "dexter"): ("stripe_left",),
    ("side", 1, "sinister"): ("stripe_right",),
    ("side", 2, ""): ("stripe_left", "stripe_right"),
    ("gradient", 1, "chief"): ("gradient",),
    ("gradient", 1, "base"): ("gradient_up",),
}
"""The patterns of a noun by how many there are and where, if that is not the noun's own pattern."""

CENTRAL = frozenset(
    {"circle", "rhombus", "globe", "creeper", "skull", "flower", "mojang", "piglin"}
    | {"flow", "guster"}
)
"""The patterns that stand at the centre of a banner."""

THROUGH_CENTRE = CENTRAL | {
    *("stripe_center", "stripe_middle", "stripe_downright", "stripe_downleft", "cross"),
    *("straight_cross", "base", "small_stripes"),
}
"""The patterns on which a central charge can lie."""

INSIDE = {
    "half_vertical": {"stripe_left", "square_top_left", "square_bottom_left"},
    "half_horizontal": {"stripe_top", "triangle_top", "triangles_top", *_TOP},
    "diagonal_right": {"square_top_right"},
    "diagonal_left": {"square_top_left"},
    "triangle_top": set[str](),
    "triangle_bottom": set[str](),
}
"""The patterns that lie wholly in a division's pattern."""

OUTSIDE = {
    "half_vertical": {"stripe_right", "square_top_right", "square_bottom_right"},
    "half_horizontal": {"stripe_bottom", "triangle_bottom", "triangles_bottom", *_BOTTOM},
    "diagonal_right": {"square_bottom_left"},
    "diagonal_left": {"square_bottom_right"},
    "triangle_top": {"stripe_bottom", "triangle_bottom", "triangles_bottom", *_BOTTOM},
    "triangle_bottom": {"stripe_top", "triangle_top", "triangles_top", *_TOP},
}
"""The patterns that lie wholly beside a division's pattern."""

SPLIT = {"stripe_top": _TOP, "stripe_bottom": _BOTTOM}
"""The two cantons, dexter and sinister, that together are another pattern."""

_PLACES = {
    "chief": ("chief", "the chief", "chief point", "the chief point", "the upper part"),
    "base": ("base", "the base", "base point", "the base point", "the lower part"),
    "dexter": ("dexter", "the dexter", "dexter flank", "the dexter flank", "dexter fess"),
    "sinister": ("sinister", "the sinister", "sinister flank", "the sinister flank"),
    "centre": ("centre", "the centre", "center", "the center", "fess", "fess point"),
}
_PREPOSITIONS = ("in", "to", "at", "from", "issuant from", "issuing from", "on the")

_NUMBERS = (
    *("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve"),
)
_ORDINALS = {
    **{"first": "1", "second": "2", "third": "3", "fourth": "4", "fifth": "5", "sixth": "6"},
    **{"1st": "1", "2nd": "2", "3rd": "3", "4th": "4", "5th": "5", "6th": "6"},
    **{"field": "field", "last": "last", "same": "last", "like": "last"},
}

_SMALL_WORDS = {
    "AND": "and,&,with,also,as well as,accompanied by,and with",
    "ON": "on,upon",
    "BETWEEN": "between,betwixt",
    "WITHIN": "within,all within,enclosed by,surrounded by,inside",
    "OVERALL": "overall,over all,over",
    "UPON": "charged with,thereon,surmounted by,debruised by,bearing,ensigned with",
    "MASONED": "masoned",
    "COUNTERCHANGED": "counterchanged,countercharged,all counterchanged",
    "NOISE": "throughout,plain,of,its,field of,that is,whole,entire,party,parted,both,all,banner",
}

OPENINGS = (
    *("on a shield", "a shield", "shield", "on a banner", "a banner", "banner", "a flag", "flag"),
    *("arms", "the arms", "blazon", "on a field", "on a field of", "a field", "field", "party"),
    *("a field of", "parted"),
)
"""Words before a field, at the beginning of a text."""

NOT_SHOWN = {
    **{"annulet": "roundel", "billet": "canton", "escutcheon": "lozenge", "mascle": "lozenge"},
    **{"orle": "bordure", "tressure": "bordure", "gyron": "canton", "inescutcheon": "lozenge"},
    **{"mullet": "flower", "estoile": "flower", "star": "flower", "sun": "roundel"},
    **{"crescent": "roundel", "fleur de lis": "flower", "fleurs de lis": "flower"},
    **{"lion": "creeper", "boar": "snout", "trefoil": "flower", "flaunches": "pallets"},
    **{"bendy": "bend", "chevronny": "chevron", "chequy": "paly", "checky": "paly"},
    **{"fret": "saltire", "pall": "chevron inverted", "label": "chief", "fountain": "roundel"},
    **{"lozengy": "lozenge", "gyronny": "per saltire", "fusily": "lozenge"},
}
"""Terms that a banner has no pattern for, and what comes closest."""

FIELD_STARTS = frozenset(
    {"chequy", "checky", "gyronny", "bendy", "lozengy", "fusily", "chevronny", "vairy", "semy"}
)
"""Words that begin a blazon, but cannot be shown."""


def normal(word: str) -> str:
    """A word as the tables have it: small letters without accents and apostrophes."""
    letters = unicodedata.normalize("NFKD", word.lower())
    return "".join(c for c in letters if not unicodedata.combining(c) and c not in "'’")


MOST_WORDS = 5
"""Most words of a term."""


@cache
def terms() -> dict[str, Term]:
    """Every term by its words, except those of OPENINGS."""
    found = {
        words: Term(kind, words) for kind, text in _SMALL_WORDS.items() for words in _cut(text)
    }
    found |= {words: Term("NOUN", pattern) for words, pattern in _nouns().items()}
    found |= {words: Term("NOUN", "circle", dye) for words, dye in _plurals(ROUNDELS).items()}
    found |= {words: Term("TINCTURE", words, dye) for words, dye in (_DYES | TINCTURES).items()}
    found |= dict(_division_terms())
    found |= dict(_place_terms())
    found |= dict(_number_terms())
    return found


def term_of(words: str) -> Term | None:
    """The term that some words are, in small letters; None for others."""
    return terms().get(words)


def _cut(text: str) -> list[str]:
    return [part.strip() for part in text.split(",")]


def _nouns() -> dict[str, str]:
    """The pattern, or the key of PLACED, of each noun in both numbers."""
    also = [line.split(":") for line in _ALSO.strip().splitlines()]
    found = {title.lower(): name for name, title in ((p.name, p.title) for p in PATTERNS.values())}
    # The game's own names of divisions are those of fields here.
    found = {words: name for words, name in found.items() if not words.startswith("per ")}
    found |= {words.partition(" ")[2]: name for name, words in NAMES.items() if words[0] in "at"}
    found |= {words: pattern for pattern, text in also for words in _cut(text)}
    for not_noun in ("paly", "masoned", "field of"):
        found.pop(not_noun, None)
    return _plurals(found)


def _plurals(nouns: dict[str, str]) -> dict[str, str]:
    found = dict(nouns)
    for words, value in nouns.items():
        parts = words.split()
        for place, part in enumerate(parts):
            ending = "es" if part.endswith(("s", "x", "ss")) else "s"
            plural = part[:-1] + "ies" if part.endswith("sy") else part + ending
            found.setdefault(" ".join([*parts[:place], plural, *parts[place + 1 :]]), value)
    return found


def _division_terms() -> list[tuple[str, Term]]:
    names = dict.fromkeys(DIVISIONS) | _DIVISION_ALSO
    found = []
    for words, name in names.items():
        for spelt in {words, words.replace("fess", "fesse")}:
            for lead in ("", "party ", "parted "):
                found.append((lead + spelt, Term("DIVISION", name or words)))
    return found


def _place_terms() -> list[tuple[str, Term]]:
    sides = [(f"{a} {b}", f"{a} {b}", f"{b} {a}") for a in _SIDES for b in _ENDS]
    places = {key: list(words) for key, words in _PLACES.items()}
    for key, *orders in sides:
        places[key] = [t for o in orders for t in (o, f"the {o}", f"{o} point", f"the {o} point")]
    found = [
        (f"{preposition} {words}", Term("PLACE", key))
        for key, all_words in places.items()
        for words in all_words
        for preposition in _PREPOSITIONS
    ]
    return [(words, term) for words, term in found if not words.startswith("on the the")]


_SIDES = ("dexter", "sinister")
_ENDS = ("chief", "base")


def _number_terms() -> list[tuple[str, Term]]:
    counts = dict.fromkeys(("a", "an", "the"), "1")
    counts |= {word: str(number) for number, word in enumerate(_NUMBERS, 1)}
    counts |= {str(number): str(number) for number in range(1, 21)}
    found = [(word, Term("COUNT", count)) for word, count in counts.items()]
    for word, count in counts.items():
        if word not in ("a", "an", "the"):
            found += [(f"of {word}{rest}", Term("PIECES", count)) for rest in ("", " pieces")]
    for word, value in _ORDINALS.items():
        found += [(f"{lead} the {word}", Term("REFERENCE", value)) for lead in ("of", "as")]
    return found
