"""Words as banners: one design of at most six layers for each character, in any two dyes.

`letters.txt` holds the designs, of at most five layers and a border. `python -m benchmarks.letters`
finds designs for our own glyphs; each design of the file has been looked at.
"""

from functools import cache
from importlib.resources import files

from drapery.banner.design import Banner, Layer
from drapery.banner.names import dye_name, shown
from drapery.errors import DesignError

MAX_LETTERS = 200
"""The most characters of a text."""

NO_BORDER = "none"
"""The border of letters that reach the edges of the flag."""

_SAME = str.maketrans("‘’“”‐‑–—", "''\"\"----")
"""Signs that are written with the letter of a plainer one."""

_Design = tuple[str, tuple[tuple[str, str], ...]]
"""The colour of the base, and (pattern, colour) from the lowest layer; `ink` or `ground`."""


@cache
def _designs() -> dict[str, _Design]:
    """The designs by character, without a border."""
    found = {}
    text = files("drapery.banner").joinpath("letters.txt").read_text("utf-8")
    for line in text.splitlines():
        if line and not line.startswith("# "):
            character, base, *layers = line.split()
            pairs = tuple((name, colour) for name, _, colour in (x.partition(":") for x in layers))
            found[character] = base, pairs
    return found


def letter_characters() -> str:
    """The characters that have a design, beside the space: A to Z, digits and punctuation."""
    return "".join(_designs())


def letter_banners(
    text: str, *, ink: str = "black", ground: str = "white", border: str | None = None
) -> tuple[Banner, ...]:
    """The banners of a text, one for each character; a space is a plain banner.

    A design has at most six layers.

    text: A to Z in either case, digits, spaces, and the punctuation of `letter_characters`.
    ink: the dye of the letters.
    ground: the dye of what is around them.
    border: its dye, the ground's if None, or "none" for letters that reach the edges.

    Raises DesignError for an empty text, one of over 200 characters, a character without a design,
    an unknown dye, or the same dye for ink and ground.
    """
    dyes = {"ink": dye_name(ink, "ink"), "ground": dye_name(ground, "ground")}
    if dyes["ink"] == dyes["ground"]:
        raise DesignError(f"ink and ground are both {dyes['ink']}; use two dyes")
    edge = None if border == NO_BORDER else dye_name(border or ground, "border")
    letters = _checked(text)
    return tuple(_banner(letter, dyes, edge) for letter in letters)


def _checked(text: str) -> str:
    letters = text.strip().translate(_SAME).upper()
    if not letters:
        raise DesignError("the text is empty; write letters such as 'HELLO 42'")
    if len(letters) > MAX_LETTERS:
        raise DesignError(
            f"the text has {len(letters)} characters; write at most {MAX_LETTERS} at once"
        )
    known = letter_characters()
    missing = [letter for letter in dict.fromkeys(letters) if letter != " " and letter not in known]
    if missing:
        names = ", ".join(shown(letter) for letter in missing[:8])
        raise DesignError(f"no letter for {names}; use A to Z, 0 to 9, spaces and {known[36:]}")
    return letters


def _banner(letter: str, dyes: dict[str, str], edge: str | None) -> Banner:
    base, pairs = ("ground", ()) if letter == " " else _designs()[letter]
    layers = [Layer(pattern, dyes[colour]) for pattern, colour in pairs]
    # A border in the ground's dye does not show on a plain banner.
    if edge is not None and not (letter == " " and edge == dyes["ground"]):
        layers.append(Layer("border", edge))
    return Banner(dyes[base], tuple(layers))
