"""Helpers for the forms of web addresses: they split an address and raise its errors."""

from dataclasses import dataclass
from typing import NoReturn
from urllib.parse import parse_qsl, unquote, urlsplit

from drapery.errors import DesignError

MAX_ADDRESS = 4096
"""Most characters of an address; those of the sites have under 400."""

COLOURS = (
    "black",
    "red",
    "green",
    "brown",
    "blue",
    "purple",
    "cyan",
    "light_gray",
    "gray",
    "pink",
    "lime",
    "yellow",
    "light_blue",
    "magenta",
    "orange",
    "white",
)
"""The dyes in the order of all the sites: 15 minus the game's number."""


@dataclass(frozen=True)
class Address:
    """A web address: host in lower case without `www.`, path, query and fragment, not decoded."""

    host: str
    path: str
    query: str
    fragment: str = ""

    def pairs(self) -> list[tuple[str, str]]:
        """The query as pairs of name and value. A plus sign is not a space here."""
        return parse_qsl(self.query.replace("+", "%2B"), keep_blank_values=True)


def split_address(text: str) -> Address | None:
    """The parts of a web address, with or without its scheme; None for another text."""
    text = text.strip()
    if not text or len(text) > MAX_ADDRESS or any(c.isspace() for c in text):
        return None
    if "://" not in text:
        text = "https://" + text.lstrip("/")
    try:
        parts = urlsplit(text)
        host = (parts.hostname or "").removeprefix("www.")
    except ValueError:
        return None
    if parts.scheme not in ("http", "https") or "." not in host:
        return None
    return Address(host, unquote(parts.path), parts.query, parts.fragment)


def site_address(text: str, *hosts: str) -> Address | None:
    """The address if its host is one of these or below one (`de.site.com`), otherwise None."""
    address = split_address(text)
    if address and any(("." + address.host).endswith("." + host) for host in hosts):
        return address
    return None


def is_bare_code(text: str, alphabet: str) -> bool:
    """Whether all characters of a text are in the alphabet, as in a code without address."""
    return 0 < len(text) <= MAX_ADDRESS and all(character in alphabet for character in text)


def is_no_word(text: str) -> bool:
    """Whether a code cannot be a typed word: it mixes capitals or digits with small letters."""
    digits = any(character.isdigit() for character in text)
    return any(c.isalpha() for c in text) and (digits or not (text.islower() or text.isupper()))


def clip(text: str, limit: int = 60) -> str:
    """A text as errors show it: quoted, on one line, at most `limit` characters."""
    return repr(text if len(text) <= limit else text[: limit - 1] + "…")


def character(code: str, place: int) -> str:
    """A character of a code as errors name it."""
    return f"{code[place]!r} at character {place + 1} of the code"


def refuse(site: str, text: str, place: str, remedy: str) -> NoReturn:
    """Raise the one-line error: the site, the address, the place in it, what to do."""
    raise DesignError(f"{site} address {clip(text)}: {place}; {remedy}")


def refuse_pattern(site: str, number: int, pattern: str) -> NoReturn:
    """Raise the one-line error of a layer that a site's code cannot hold."""
    remedy = "leave the layer out or write another form"
    raise DesignError(f"{site} has no code for pattern {clip(pattern)} (layer {number}); {remedy}")
