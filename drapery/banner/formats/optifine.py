"""A banner on an OptiFine cape: `optifine.net/showBanner?format=ealleN&valign=m`.

Miners Need Cool Shoes writes the same code. OptiFine shows eight layers, and not Mojang's pattern.
"""

from urllib.parse import quote

from drapery.banner.design import Banner
from drapery.banner.formats import needcoolshoes
from drapery.banner.formats.urls import refuse, refuse_pattern, site_address
from drapery.errors import DesignError

NAME = "optifine"
TITLE = "OptiFine's address"
EXAMPLE = "https://optifine.net/showBanner?format=ealleNhEehppai&valign=m"
SOURCE = "https://github.com/sp614x/optifine/issues/3237"
KINDS = ("banner",)
SITE = "OptiFine"
HOST = "optifine.net"
MAX_LAYERS = 8
REMEDY = "copy the banner's address at NeedCoolShoes, …/banner?=ealleN…"


def recognises(text: str) -> bool:
    """Whether the text is an address of this site."""
    return site_address(text, HOST) is not None


def parse(text: str) -> Banner:
    """Read the address of a cape's banner. Raises DesignError for pages without a code."""
    text = text.strip()
    address = site_address(text, HOST)
    if address is None:
        return needcoolshoes.parse(text)
    code = dict(reversed(address.pairs())).get("format") or address.path.partition("&&")[2]
    if not code:
        refuse(SITE, text, "the page carries no code (no ?format=)", REMEDY)
    return needcoolshoes.parse(code)


def write(banner: Banner) -> str:
    """The address of the cape's picture.

    Raises DesignError for over eight layers, for `mojang`, and for the patterns of data packs.
    """
    if len(banner.layers) > MAX_LAYERS:
        raise DesignError(
            f"{SITE} shows at most {MAX_LAYERS} layers, but there are {len(banner.layers)}:"
            " leave some out"
        )
    for number, layer in enumerate(banner.layers, 1):
        if layer.pattern == "mojang":
            refuse_pattern(SITE, number, layer.pattern)
    code = needcoolshoes.encode(banner)
    return f"https://{HOST}/showBanner?format={quote(code, safe='')}&valign=m"
