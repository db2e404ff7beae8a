"""A blazon, the words of English heraldry: `Azure, a bend Or within a bordure Argent`.

A text that can be read as shorthand or in plain English words is not a blazon.
"""

from drapery.banner.blazon import parse_blazon, write_blazon
from drapery.banner.blazon.terms import MAX_BLAZON, begins_as_blazon, begins_with_dye
from drapery.banner.design import Banner
from drapery.banner.formats import shorthand
from drapery.errors import DesignError

NAME = "blazon"
TITLE = "blazon, the words of English heraldry"
EXAMPLE = "Azure, a bend Or within a bordure Argent"
SOURCE = "https://en.wikipedia.org/wiki/Blazon"
_OTHER = frozenset('{}[]"@=<>#|')


def recognises(text: str) -> bool:
    """Whether a text begins as a blazon, and no other way of typing a banner reads it."""
    if text.lstrip().startswith("/") or _OTHER.intersection(text[:MAX_BLAZON]):
        return False
    if begins_as_blazon(text):
        return "\n" not in text.strip() if len(text) > MAX_BLAZON else not _is_shorthand(text)
    if len(text) > MAX_BLAZON or not begins_with_dye(text) or _is_shorthand(text):
        return False
    try:
        parse(text)
    except DesignError:
        return False
    return True


def _is_shorthand(text: str) -> bool:
    try:
        shorthand.parse(text)
    except DesignError:
        return False
    return True


def parse(text: str) -> Banner:
    """Read the blazon. Raises DesignError that names every term that a banner cannot show."""
    return parse_blazon(text)


def write(banner: Banner) -> str:
    """The blazon; it can hold every banner."""
    return write_blazon(banner)
