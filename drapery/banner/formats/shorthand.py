"""Typed by hand: `white creeper:lime border:black`, or as the game's tooltip shows it.

The base dye comes first, then the layers, lowest first. A layer is `pattern:dye`, or, between
commas or on its own line, `Lime Creeper Charge`. A dye may be a number, from white, which is 0.
`shield` before the base makes a shield; `ominous banner` is the banner of the illagers. What is not
of this form is read as English words (`phrases`) or as another language's (`languages`).
"""

from drapery.banner.design import Banner, Layer
from drapery.banner.formats import languages, phrases
from drapery.banner.formats.tree import OMINOUS, base_of, check_count
from drapery.banner.names import dye_name, is_dye, is_pattern, pattern_id, plain, shown
from drapery.errors import DesignError

NAME = "shorthand"
TITLE = "typed by hand"
EXAMPLE = "white creeper:lime border:black"
SOURCE = "our own, and the game's tooltip"

_LONGEST_PHRASE = 1000
_BREAKS = str.maketrans(dict.fromkeys(",;\r", "\n"))


def recognises(text: str) -> bool:
    """Whether the text holds none of the brackets and quotes that the other forms have."""
    other = text.lstrip().startswith("/") or "//" in text
    return not other and not set('{}[]"@=').intersection(text)


def parse(text: str) -> Banner:
    """Read the shorthand, English words, or the names of another language.

    Raises DesignError in the words of the way of writing that the text resembles.
    """
    try:
        return _shorthand(text)
    except DesignError as error:
        fault = error
    faults = {"shorthand": fault}
    for name, parse_other in (("phrase", phrases.parse), ("language", languages.parse)):
        try:
            return parse_other(text)
        except DesignError as error:
            faults[name] = error
    raise faults[_resembles(text)]


def _resembles(text: str) -> str:
    """The way of writing of a text that none of them can read."""
    first = text.split(maxsplit=1)[0] if text.strip() else ""
    foreign = not text.isascii() or (not is_dye(first) and languages.is_known(text))
    if languages.may_be(text) and foreign:
        return "language"
    if len(text) < _LONGEST_PHRASE and phrases.resembles(text):
        return "phrase"
    return "shorthand"


def _shorthand(text: str) -> Banner:
    """Read the shorthand. Raises DesignError naming the layer, counted from 1."""
    if plain(text) in ("ominous", "ominous_banner"):
        return OMINOUS
    pieces = [words for line in text.translate(_BREAKS).split("\n") if (words := _words(line))]
    if not pieces:
        raise DesignError(f"the text is empty: write a base dye and layers, such as {EXAMPLE!r}")
    shield = pieces[0][0].lower() == "shield" and bool(pieces[0].pop(0))
    if not pieces[0]:
        raise DesignError("the shield has no base dye: write 'shield white creeper:lime'")
    if len(pieces) > 1 and _is_layer(pieces[0]):
        raise DesignError(
            f"{shown(' '.join(pieces[0]))}: this is a layer, but the base is missing:"
            " write the banner's name in the first line, such as 'White Banner'"
        )
    base = _base(pieces[0].pop(0))
    if pieces[0][:1] in (["banner"], ["Banner"]):
        pieces[0].pop(0)
    layers = [layer for words in pieces for layer in _phrases(words)]
    check_count(len(layers), "the text")
    read = tuple(_layer(layer, f"layer {n}") for n, layer in enumerate(layers, 1))
    return Banner(base, read, kind="shield" if shield else "banner")


def write(banner: Banner) -> str:
    """The shorthand; it can hold every banner."""
    kind = "shield " if banner.kind == "shield" else ""
    return kind + " ".join([banner.base, *(f"{x.pattern}:{x.dye}" for x in banner.layers)])


def _words(line: str) -> list[str]:
    """The words of a line; `a : b` and `light blue` become one word each."""
    words: list[str] = []
    for word in ":".join(part.strip() for part in line.split(":")).split():
        light = words and words[-1].lower().endswith("light")
        if light and word.lower().partition(":")[0] in ("blue", "gray", "grey"):
            words[-1] += "_" + word
        else:
            words.append(word)
    return words


def _base(word: str) -> str:
    if word == "-":
        raise DesignError(
            "a list of layers without a base dye: write it in a line before them, as 'white'"
        )
    if ":" in word.removeprefix("minecraft:"):
        raise DesignError(f"{shown(word)}: a base dye comes first, as in {EXAMPLE!r}")
    return base_of(word) or dye_name(word, "base")


def _is_layer(words: list[str]) -> bool:
    """Whether words are a dye and a pattern, as in a line of a tooltip."""
    return len(words) > 1 and is_dye(words[0]) and is_pattern(" ".join(words[1:]))


def _phrases(words: list[str]) -> list[str]:
    """The layers in a row of words. Each ends with its `:dye`; the last may have none."""
    phrases: list[list[str]] = [[]]
    for word in words:
        phrases[-1].append(word)
        if ":" in word:
            phrases.append([])
    return [" ".join(phrase) for phrase in phrases if phrase]


def _layer(phrase: str, at: str) -> Layer:
    at = f"{at} {shown(phrase)}"
    pattern, colon, dye = phrase.rpartition(":")
    if not colon:
        dye, _, pattern = phrase.partition(" ")
        if not pattern or not is_dye(dye):
            raise DesignError(f"{at}: it has no dye: write pattern:dye, such as 'creeper:lime'")
    number = int(dye) if dye.isdecimal() and len(dye) < 4 else dye
    return Layer(pattern_id(pattern, at), dye_name(number, at))
