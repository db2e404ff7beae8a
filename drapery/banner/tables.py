"""The tables with which a program in another language reads designs as `drapery.banner` does."""

from collections.abc import Iterable, Sequence
from typing import Any

from drapery.banner.design import MAX_LAYERS, Banner
from drapery.banner.dyes import DYE_NAMES, DYES
from drapery.banner.formats import (
    gamergeeks,
    minecraft_tools,
    needcoolshoes,
    planet_minecraft,
    snbt,
    urls,
)
from drapery.banner.formats.tree import OLD_BANNERS, OMINOUS, base_of
from drapery.banner.names import dye_aliases, pattern_aliases
from drapery.banner.patterns import BY_CODE

MAX_TEXT = 32_768
"""Most characters of a design that a page reads; the game's command blocks hold 32,500."""

_Names = Iterable[tuple[str, str]]
_FIRST = r"^[^?#]*\?(?:[^#]*?&)??"
"""What stands before the first parameter of a link that fits; it reads each character once."""


def reader_tables() -> dict[str, Any]:
    """Names and codes of dyes, patterns and links, as JSON can hold them.

    dyes: the names by number. rgb: of each dye, 8-bit sRGB. items: from every id of an item or
    block to the kind of its design and its base dye, which old ids and shields do not name.
    dyeNames, patterns: from every name, spelt as ids are, to the id. bukkit: names of the server
    API that are read only in capitals. ominous: the illagers' banner. maxLayers, maxText, maxLink,
    maxDepth: of a design, its text [characters], a link [characters] and brackets inside each
    other. sites: how the links of editors are read, see `_site`.
    """
    return {
        "dyes": list(DYE_NAMES),
        "rgb": {name: list(dye.rgb) for name, dye in DYES.items()},
        "items": _items(),
        "dyeNames": dye_aliases(),
        "patterns": pattern_aliases(),
        "bukkit": {"DIAGONAL_RIGHT": "diagonal_up_right"},
        "ominous": _plain(OMINOUS),
        "maxLayers": MAX_LAYERS,
        "maxText": MAX_TEXT,
        "maxLink": urls.MAX_ADDRESS,
        "maxDepth": snbt.MAX_DEPTH,
        "sites": [_planet_minecraft(), _needcoolshoes(), _minecraft_tools(), _gamergeeks()],
    }


def _items() -> dict[str, tuple[str, str | None]]:
    named = [f"{dye}{kind}_banner" for dye in (*DYE_NAMES, "silver") for kind in ("", "_wall")]
    banners = [*named, *sorted(OLD_BANNERS)]
    return {**{name: ("banner", base_of(name)) for name in banners}, "shield": ("shield", None)}


def _site(
    hosts: Sequence[str], code: str, base: str, layer: str, dyes: _Names, patterns: _Names
) -> dict[str, Any]:
    """How a link is read, with regular expressions that JavaScript knows too.

    code: finds the code of a design in a link. base, layer: the parts of the code, with groups
    `dye` and `pattern`, whose texts `dyes` and `patterns` name.
    """
    found = {"hosts": list(hosts), "code": code, "base": base, "layer": layer}
    return found | {"dyes": dict(dyes), "patterns": dict(patterns)}


def _planet_minecraft() -> dict[str, Any]:
    site = planet_minecraft
    dyes = zip(site.ALPHABET, urls.COLOURS, strict=False)
    patterns = zip(site.ALPHABET[site.FIRST_PATTERN :], site.PATTERN_ORDER, strict=False)
    code = _FIRST + "[be]=([^&#]+)"
    return _site([site.HOST], code, "(?<dye>.)", "(?<dye>.)(?<pattern>.)", dyes, patterns)


def _needcoolshoes() -> dict[str, Any]:
    site = needcoolshoes
    dyes = ((letter, urls.COLOURS[n % 16]) for n, letter in enumerate(site.ALPHABET))
    patterns = zip(site.ALPHABET, site.PATTERN_ORDER, strict=False)
    code = _FIRST + "(?:b|banner)?=([^&#]+)"
    base, layer = "(?<dye>[\\w+/])[\\w+/]", "(?<dye>[a-p])(?<pattern>.)"
    return _site(site.HOSTS, code, base, layer, dyes, patterns)


def _minecraft_tools() -> dict[str, Any]:
    """Its links have a parameter for each number, which the reader puts in order first."""
    site = minecraft_tools
    dyes = ((str(n), dye) for n, dye in enumerate(urls.COLOURS))
    patterns = ((str(n), name) for n, name in enumerate(site.PATTERN_ORDER, 1))
    layer = "(?<pattern>[^:]+):(?<dye>[^;]+);"
    return _site([site.HOST], "", "(?<dye>[^;]+);", layer, dyes, patterns)


def _gamergeeks() -> dict[str, Any]:
    site = gamergeeks
    dyes = ((str(n), dye) for n, dye in enumerate(DYE_NAMES))
    patterns = ((code, pattern.name) for code, pattern in BY_CODE.items())
    base, dye = "(?<dye>\\d{1,2})(?!\\d)", "(?<dye>\\d{1,2})(?!\\d)"
    return _site(
        site.HOSTS, "^[^#]*#mcb=a(.+)", base, f"(?<pattern>[a-z]{{1,3}}){dye}", dyes, patterns
    )


def _plain(banner: Banner) -> dict[str, Any]:
    layers = [{"pattern": layer.pattern, "dye": layer.dye} for layer in banner.layers]
    return {"base": banner.base, "layers": layers, "kind": banner.kind}
