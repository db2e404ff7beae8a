"""Designs in full names, such as `white creeper:lime border:black`, read without the forms.

The forms, which read all other texts, take as long to import as a picture takes to be drawn.
"""

from pathlib import Path

from drapery.banner.design import MAX_LAYERS, Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.patterns import PATTERNS

_LONGEST = 1000


def plain_design(text: str) -> Banner | None:
    """The banner of a text that is a dye and any number of `pattern:dye`; None for other texts.

    Only the full names of dyes and of the game's patterns count, with one space between them.
    """
    base, *words = text.split(" ") if len(text) < _LONGEST else [""]
    pairs = [word.split(":") for word in words]
    known = all(len(pair) == 2 and pair[0] in PATTERNS and pair[1] in DYES for pair in pairs)
    if base not in DYES or not known or len(pairs) > MAX_LAYERS:
        return None
    return Banner(base, tuple(Layer(*pair) for pair in pairs))


def parse_design(text: str) -> Banner:
    """The banner of a text in any form. Raises DesignError."""
    if isinstance(text, str) and (plain := plain_design(text)):
        return plain
    from drapery.banner.formats.registry import parse_banner

    return parse_banner(text)


def read_design(
    source: str | Path, *, form: str | None = None, number: int | None = None
) -> Banner:
    """The banner of a text, of a file, or of standard input.

    source: a text, or the path of a file if one of that name exists; "-" is standard input.
    form: one of FORMS, or None to recognise it.
    number: which banner, from 1, if the text holds several.

    Raises DesignError as `parse_banner` does, and for files that cannot be read.
    """
    if isinstance(source, str) and form is None and number is None:
        plain = plain_design(source)
        if plain is not None and not _is_file(source):
            return plain
    from drapery.banner.formats.reading import read_designs
    from drapery.banner.formats.registry import choose_banner

    return choose_banner(read_designs(source, form=form), number)


def _is_file(name: str) -> bool:
    """Whether there is a file or folder of that name."""
    try:
        return Path(name).exists()
    except OSError:  # the name is too long for one
        return False
