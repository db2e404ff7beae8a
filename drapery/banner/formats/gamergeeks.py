"""Gamer Geeks' banner maker: `gamergeeks.net/apps/minecraft/banner-maker#mcb=a15cre5bo0`.

`a` and the base dye's number, then each layer's code of the versions before 1.20.5 and its dye's
number; white is 0.
"""

import re

from drapery.banner.design import MAX_LAYERS, Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.formats.urls import character, clip, refuse, refuse_pattern, site_address
from drapery.banner.names import dye_name
from drapery.banner.patterns import BY_CODE, PATTERNS

NAME = "gamergeeks"
TITLE = "Gamer Geeks' address"
EXAMPLE = "https://www.gamergeeks.net/apps/minecraft/banner-maker#mcb=a15bs0ls0ts0rs0dls0bo15"
SOURCE = "https://www.gamergeeks.net/apps/minecraft/banner-maker"
KINDS = ("banner",)
SITE = "Gamer Geeks"
HOSTS = ("gamergeeks.net", "gamergeeks.nz")
REMEDY = "copy the address of the banner maker, …/banner-maker#mcb=a15cre5…"
_CODE = re.compile(r"a[0-9]{1,2}(?:[a-z]{1,3}[0-9]{1,2})*")
_LAYER = re.compile(r"([a-z]{1,3})([0-9]{1,2})(?![0-9])")


def recognises(text: str) -> bool:
    """Whether the text is an address of this site, or a code with a layer at least."""
    if site_address(text, *HOSTS):
        return True
    return len(text) < 400 and bool(_CODE.fullmatch(text.strip())) and len(text.strip()) > 3


def parse(text: str) -> Banner:
    """Read an address of the banner maker, or its code alone.

    Raises DesignError for other pages, and for codes without a meaning.
    """
    text = text.strip()
    code = _code(text)
    base = re.match("a([0-9]{1,2})(?![0-9])", code)
    if base is None:
        refuse(SITE, text, "the code has no base, such as 'a15' for black", REMEDY)
    where = f"{SITE} address {clip(text)}"
    layers: list[Layer] = []
    place = base.end()
    while match := _LAYER.match(code, place):
        if match[1] not in BY_CODE:
            refuse(SITE, text, f"{match[1]!r} is not the code of a pattern", REMEDY)
        layers.append(Layer(BY_CODE[match[1]].name, dye_name(int(match[2]), where)))
        place = match.end()
    if place < len(code):
        what = "begins neither a pattern's code nor its dye's number"
        refuse(SITE, text, f"{character(code, place)} {what}", REMEDY)
    if len(layers) > MAX_LAYERS:
        refuse(SITE, text, f"the code has {len(layers)} layers, over {MAX_LAYERS}", REMEDY)
    return Banner(dye_name(int(base[1]), where), tuple(layers))


def write(banner: Banner) -> str:
    """The address that opens the banner in the maker.

    Raises DesignError for patterns without a code: `flow`, `guster`, and those of data packs.
    """
    code = f"a{DYES[banner.base].number}"
    for number, layer in enumerate(banner.layers, 1):
        pattern = PATTERNS.get(layer.pattern)
        if pattern is None or pattern.code is None:
            refuse_pattern(SITE, number, layer.pattern)
        code += f"{pattern.code}{DYES[layer.dye].number}"
    return f"{SOURCE}#mcb={code}"


def _code(text: str) -> str:
    address = site_address(text, *HOSTS)
    if address is None:
        return text
    name, _, code = address.fragment.partition("=")
    if name != "mcb" or not code:
        refuse(SITE, text, "the page carries no code (no #mcb=)", REMEDY)
    return code
