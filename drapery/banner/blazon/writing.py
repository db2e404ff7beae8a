"""Writes a banner as a blazon that `parse_blazon` reads as the same banner."""

from itertools import groupby

from drapery.banner.blazon.plain_words import plain_text
from drapery.banner.blazon.vocabulary import DYE_WORDS, NAMES
from drapery.banner.design import Banner, Layer

_FIELDS = {
    "half_vertical": "Per pale",
    "half_horizontal": "Per fess",
    "diagonal_right": "Per bend",
    "diagonal_left": "Per bend sinister",
}


def write_blazon(banner: Banner) -> str:
    """The blazon of a banner. It can hold every banner, those of data packs too."""
    base, layers = DYE_WORDS[banner.base], list(banner.layers)
    words = base
    if layers and layers[0].pattern in _FIELDS:
        first = layers.pop(0)
        words = f"{_FIELDS[first.pattern]} {DYE_WORDS[first.dye]} and {base}"
    bordure = layers.pop() if len(layers) > 1 and layers[-1].pattern in _BORDURES else None
    words = ", ".join([words, *_phrases(layers)])
    if bordure is not None:
        words += f" within {_name(bordure)} {DYE_WORDS[bordure.dye]}"
    words = f"On a shield {words}" if banner.kind == "shield" else words
    named_alike = all(DYE_WORDS[dye].lower() == dye.replace("_", " ") for dye in _dyes(banner))
    # With the game's dyes alone, plain English would read `a cross` as the pattern `cross`.
    return f"Arms: {words}" if named_alike and banner.layers else words


def alt_text(banner: Banner, *, plain: bool = False) -> str:
    """A banner in words, for people who cannot see its picture: `Banner: Azure, a bend Or`.

    banner: the design.
    plain: in everyday English, `A red banner with a white cross`; `Banner.parse` does not read it.
    """
    if plain:
        return plain_text(banner)
    # The words of a shield begin with `On a shield`.
    words = write_blazon(banner).removeprefix("Arms: ")
    return words if banner.kind == "shield" else f"Banner: {words}"


def _dyes(banner: Banner) -> list[str]:
    return [banner.base, *(layer.dye for layer in banner.layers)]


_BORDURES = ("border", "curly_border")


def _phrases(layers: list[Layer]) -> list[str]:
    """The charges, those that follow each other with one tincture together."""
    phrases = []
    for (dye, masoned), group in groupby(layers, lambda x: (x.dye, x.pattern == "bricks")):
        names = [_name(layer) for layer in group]
        if masoned:
            phrases += [f"{name} {DYE_WORDS[dye]}" for name in names]
        else:
            *others, last = names
            together = ", ".join(others) + " and " if others else ""
            phrases.append(f"{together}{last} {DYE_WORDS[dye]}")
    return phrases


def _name(layer: Layer) -> str:
    if layer.pattern in NAMES:
        return NAMES[layer.pattern]
    return f"{'an' if layer.pattern[0] in 'aeiou' else 'a'} {layer.pattern}"
