"""What the forms that live in a web address share: taking the address apart, and its refusals."""

from dataclasses import dataclass
from typing import NoReturn
from urllib.parse import parse_qsl, unquote, urlsplit

from drapery.errors import DesignError

MAX_ADDRESS = 4096
"""Characters; the longest address that any of the sites makes is under 400."""

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
"""The dyes as all the sites count them: 15 minus the game's number."""


@dataclass(frozen=True)
class Address:
    """A web address: host in lower case without `www.`, path, and the query as it was written."""

    host: str
    path: str
    query: str

    def pairs(self) -> list[tuple[str, str]]:
        """The query as (name, value), where a plus sign stays a plus sign."""
        return parse_qsl(self.query.replace("+", "%2B"), keep_blank_values=True)


def split_address(text: str) -> Address | None:
    """Take a web address apart, with or without its scheme; None where the text is none."""
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
    return Address(host, unquote(parts.path), parts.query)


def site_address(text: str, *hosts: str) -> Address | None:
    """The address, if it is one of these sites' or of a place under them (`de.site.com`)."""
    address = split_address(text)
    if address and any(("." + address.host).endswith("." + host) for host in hosts):
        return address
    return None


def is_bare_code(text: str, alphabet: str) -> bool:
    """Whether a text could be the code alone: some characters, all of the alphabet."""
    return 0 < len(text) <= MAX_ADDRESS and all(character in alphabet for character in text)


def clip(text: str, limit: int = 60) -> str:
    """A text as an error may show it: quoted, on one line, and no longer than `limit`."""
    return repr(text if len(text) <= limit else text[: limit - 1] + "…")


def letter(code: str, place: int) -> str:
    """A character of a code as an error names it."""
    return f"{code[place]!r} at character {place + 1} of the code"


def refuse(site: str, text: str, place: str, remedy: str) -> NoReturn:
    """Raise the one-line error: the site, the address, the place in it, what to do."""
    raise DesignError(f"{site} address {clip(text)}: {place}; {remedy}")


def refuse_pattern(site: str, number: int, pattern: str) -> NoReturn:
    """Raise the one-line error of a layer that a site's code cannot hold."""
    remedy = "leave the layer out or write another form"
    raise DesignError(f"{site} has no code for pattern {clip(pattern)} (layer {number}); {remedy}")
