"""The address of a page of `drapery studio`, which holds its design.

The value of `d` begins with the version. The rest is JSON, compressed as a zlib stream (RFC 1950)
and encoded as URL-safe base64 (RFC 4648, section 5) without padding. The JSON is our own form of a
design; `hidden` lists the places of layers that the page does not show.
"""

import json
import re
import zlib
from base64 import urlsafe_b64decode, urlsafe_b64encode
from dataclasses import replace

from drapery.banner.design import Banner
from drapery.banner.formats import own_json
from drapery.banner.names import shown
from drapery.errors import DesignError, counted

NAME = "studio"
TITLE = "the address of a page of Drapery Studio"
EXAMPLE = (
    "http://127.0.0.1:8080/?d="
    "aeNpVyjEOgCAQRNG7TM0JuIqxWGAK4-qShcYQ7i6ltv_9gSSNiHAWBKg89Ia4DVTpnX4vyk5W-uJsar6"
    "KHhcxw3dK5uX3JJV8Yu7zBW8mIUE"
)
SOURCE = "our own"

ADDRESS = "http://127.0.0.1:8080/?d="
VERSION = "a"
MAX_LINK = 4096
"""Most characters of a link; a design of sixteen layers takes about 400."""
MAX_JSON = 16 << 10
"""The largest size of a link's data after it is decompressed [bytes]."""

_LETTERS = frozenset("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_")
_REMEDY = "copy the whole link again"
_ADDRESS = re.compile(
    r"\s*https?://[^\s?#]{1,256}\?(?:[^\s#]{0,256}&)?d=(a[\w-]{8,})(?![\w-])[^\s]*\s*"
)


def recognises(text: str) -> bool:
    """Whether the text is such an address."""
    return len(text) <= 2 * MAX_LINK and _ADDRESS.fullmatch(text) is not None


def write(banner: Banner) -> str:
    """The address at a studio that was started with its defaults."""
    return ADDRESS + pack_link(json.loads(own_json.write(banner)))


def parse(text: str) -> Banner:
    """The design of such an address, or of the value of its `d`. Raises DesignError."""
    address = _ADDRESS.fullmatch(text)
    return banner_of(unpack_link(address[1] if address else text))


def banner_of(tree: object) -> Banner:
    """The visible layers of a link's JSON. Raises DesignError."""
    if not isinstance(tree, dict):
        raise DesignError(f"the link does not hold a design; {_REMEDY}")
    banner = own_json.from_tree({key: tree[key] for key in KEYS if key in tree})
    hidden = hidden_layers(tree, len(banner.layers))
    layers = (layer for place, layer in enumerate(banner.layers) if place not in hidden)
    return replace(banner, layers=tuple(layers))


KEYS = ("base", "layers", "kind")
"""The keys of a link's JSON that describe the design."""


def hidden_layers(tree: dict[str, object], count: int) -> frozenset[int]:
    """The places of hidden layers in the tree of a link, from 0.

    tree: of a studio's link.
    count: number of the design's layers.

    Raises DesignError for places that are not among them.
    """
    hidden = tree.get("hidden", [])
    if not isinstance(hidden, list) or not all(
        type(place) is int and 0 <= place < count for place in hidden
    ):
        raise DesignError(f"hidden: not a list of places of {counted(count, 'layer')}; {_REMEDY}")
    return frozenset(hidden)


def pack_link(tree: object) -> str:
    """JSON as the characters of a link."""
    text = json.dumps(tree, separators=(",", ":"), ensure_ascii=False)
    return VERSION + urlsafe_b64encode(zlib.compress(text.encode(), 9)).decode().rstrip("=")


def unpack_link(text: str) -> object:
    """The JSON of a link.

    Raises DesignError for any other text.
    """
    word = text.strip()
    if len(word) > MAX_LINK:
        raise DesignError(f"the link has {len(word)} characters, over {MAX_LINK}; {_REMEDY}")
    if not word or not _LETTERS.issuperset(word):
        raise DesignError(f"the link is empty or has characters that no link has; {_REMEDY}")
    if word[0] != VERSION:
        raise DesignError(
            f"the link has version {shown(word[0])}; this Drapery reads {VERSION!r}; update Drapery"
        )
    try:
        return json.loads(_inflated(word[1:]))
    except (ValueError, RecursionError):
        raise DesignError(f"the link does not hold a design; {_REMEDY}") from None


def _inflated(text: str) -> bytes:
    try:
        squeezed = urlsafe_b64decode(text + "=" * (-len(text) % 4))
        stream = zlib.decompressobj()
        data = stream.decompress(squeezed, MAX_JSON + 1)
    except (ValueError, zlib.error):
        raise DesignError(f"the link is damaged; {_REMEDY}") from None
    if len(data) > MAX_JSON:
        raise DesignError(
            f"the link unpacks to over {MAX_JSON} bytes, more than any design has; {_REMEDY}"
        )
    if not stream.eof or stream.unused_data:
        raise DesignError(f"the link is cut short or has characters after its end; {_REMEDY}")
    return data
