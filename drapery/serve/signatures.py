"""Signed addresses of pictures: who has no secret draws nothing new.

The signature is HMAC-SHA256, from the standard library; `itsdangerous` signs tokens of its own
form, which programs in other languages cannot make from an address. It ends as the picture's file
does, because wikis and forums show addresses that end so.
"""

import hashlib
import hmac
from collections.abc import Iterable
from pathlib import PurePosixPath
from urllib.parse import parse_qsl, urlencode, urlsplit, urlunsplit

from drapery.errors import OptionError

SECRET = "DRAPERY_SECRET"
"""The variable of the environment with the secret; the words of a command are seen by others."""
MIN_SECRET = 16
"""The fewest characters of a secret."""
PARAMETER = "signature"


def check_secret(secret: str) -> bytes:
    """A secret as bytes; empty for none. Raises OptionError for one that is easily guessed."""
    if 0 < len(secret) < MIN_SECRET:
        raise OptionError(f"{SECRET} has under {MIN_SECRET} characters; choose a longer secret")
    return secret.encode()


def sign_address(address: str, secret: str) -> str:
    """The address of a picture with its signature, which replaces one that it has.

    address: as https://banners.example/banner.png?design=white. secret: the service's.
    Raises OptionError for an address without a query, or a secret that is empty or too short.
    """
    key = check_secret(secret)
    parts = urlsplit(address)
    query = parse_qsl(parts.query, keep_blank_values=True)
    name = _name(parts.path)
    if not key:
        raise OptionError(f"there is no secret; set {SECRET} to the secret of the service")
    if not name or not query:
        raise OptionError(f"{address[:60]!r} names no picture; write …/banner.png?design=white")
    signed = [*unsigned(query), (PARAMETER, _signature(name, query, key))]
    return urlunsplit(parts._replace(query=urlencode(signed)))


def is_signed(path: str, query: Iterable[tuple[str, str]], key: bytes) -> bool:
    """Whether a query holds one signature, which fits its other names and values for this path."""
    listed = list(query)
    given = [value for name, value in listed if name == PARAMETER]
    wanted = _signature(_name(path), listed, key)
    return len(given) == 1 and hmac.compare_digest(given[0].encode(), wanted.encode())


def unsigned(query: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """The names and values of a query without its signature."""
    return [(name, value) for name, value in query if name != PARAMETER]


def _name(path: str) -> str:
    """The last part of a path: a proxy may serve the pictures under a prefix."""
    return path.rpartition("/")[2]


def _signature(name: str, query: Iterable[tuple[str, str]], key: bytes) -> str:
    text = f"{name}?{urlencode(sorted(unsigned(query)))}"
    digits = hmac.new(key, text.encode(), hashlib.sha256).hexdigest()
    return digits + PurePosixPath(name).suffix
