"""Miners Need Cool Shoes and sites like it: `needcoolshoes.com/banner?=ealleNhEehppai`.

ncrs.skin, needcoolershoes.com and skinmc.net write the same code: pairs of characters, the
first pair for the base. For a pair at the places (e, a) of the alphabet, the dye is
`e & 15` and the pattern `(e >> 4) << 6 | a`.
"""

from drapery.banner.design import MAX_LAYERS, Banner, Layer
from drapery.banner.formats.urls import (
    COLOURS,
    Address,
    character,
    is_bare_code,
    is_no_word,
    refuse,
    refuse_pattern,
    site_address,
)
from drapery.banner.patterns import BY_CODE, PATTERNS
from drapery.errors import counted

NAME = "needcoolshoes"
TITLE = "NeedCoolShoes', ncrs.skin's or skinmc's address"
EXAMPLE = "https://www.needcoolshoes.com/banner?=ealleNhEehppai"
KINDS = ("banner",)
SOURCE = "https://www.needcoolshoes.com/banner"
SITE = "NeedCoolShoes"
HOSTS = ("needcoolshoes.com", "needcoolershoes.com", "ncrs.skin", "skinmc.net")
ALPHABET = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+/"
_ORDER = """
b bl bo br bri bs bt bts cbo cr cre cs dls drs flo gra hh ld ls mc moj mr ms rd rs sc sku ss
tl tr ts tt tts vh lud rud gru hhb vhr glb pig flow guster
"""
PATTERN_ORDER = [code if code in PATTERNS else BY_CODE[code].name for code in _ORDER.split()]
REMEDY = "open the banner in the site's editor and copy the address there, …/banner?=ealleN…"


def recognises(text: str) -> bool:
    """Whether the text is an address of one of the sites, or the code of an editor.

    A code has a capital or a digit, as words have none; its first pair ends with `a`.
    """
    return site_address(text, *HOSTS) is not None or _is_code(text.strip())


def parse(text: str) -> Banner:
    """Read an address of the editors, or its code alone.

    Raises DesignError for gallery pages, which have no code, and for incomplete codes.
    """
    text = text.strip()
    code = _code(text)
    if len(code) % 2:
        have = counted(len(code), "character")
        refuse(SITE, text, f"the code has {have}, not an even number", REMEDY)
    if len(code) > 2 + 2 * MAX_LAYERS:
        refuse(SITE, text, f"the code has {len(code) // 2 - 1} layers, over {MAX_LAYERS}", REMEDY)
    layers = tuple(_layer(text, code, place) for place in range(2, len(code), 2))
    _index(text, code, 1)
    return Banner(_dye(text, code, 0), layers)


def write(banner: Banner) -> str:
    """The address that opens the banner in the editor.

    Raises DesignError for the patterns of data packs, for which the editor has no code.
    """
    return f"https://www.{HOSTS[0]}/banner?={encode(banner)}"


def encode(banner: Banner) -> str:
    """The editor's code of a banner. Raises DesignError for the patterns of data packs."""
    code = ALPHABET[COLOURS.index(banner.base)] + ALPHABET[0]
    for number, layer in enumerate(banner.layers, 1):
        if layer.pattern not in PATTERN_ORDER:
            refuse_pattern(SITE, number, layer.pattern)
        code += ALPHABET[COLOURS.index(layer.dye)]
        code += ALPHABET[PATTERN_ORDER.index(layer.pattern)]
    return code


def _is_code(text: str) -> bool:
    if not is_bare_code(text, ALPHABET) or len(text) % 2 or not 4 <= len(text) <= 2 + 32:
        return False
    places = [ALPHABET.index(character) for character in text]
    pairs = list(zip(places[::2], places[1::2], strict=True))
    known = all((e >> 4 << 6 | a) < len(PATTERN_ORDER) for e, a in pairs)
    return known and pairs[0][1] == 0 and is_no_word(text)


def _code(text: str) -> str:
    if is_bare_code(text, ALPHABET):
        return text
    address = site_address(text, *HOSTS)
    if address is None:
        refuse(SITE, text, "neither an address of the sites nor a code", REMEDY)
    code = _query_code(address)
    if not code:
        refuse(SITE, text, "the page carries no code (no ?=)", REMEDY)
    return code


def _query_code(address: Address) -> str:
    """The value of the parameter without a name; some pages call it `b` or `banner`."""
    given = (value for name, value in address.pairs() if name in ("", "b", "banner"))
    return next(filter(None, given), "")


def _layer(text: str, code: str, place: int) -> Layer:
    high, low = _index(text, code, place), _index(text, code, place + 1)
    index = high >> 4 << 6 | low
    if index >= len(PATTERN_ORDER):
        refuse(SITE, text, f"{character(code, place + 1)} is not the code of a pattern", REMEDY)
    return Layer(PATTERN_ORDER[index], _dye(text, code, place))


def _dye(text: str, code: str, place: int) -> str:
    return COLOURS[_index(text, code, place) & 15]


def _index(text: str, code: str, place: int) -> int:
    index = ALPHABET.find(code[place])
    if index < 0:
        refuse(SITE, text, f"{character(code, place)} is not in the site's alphabet", REMEDY)
    return index
