"""BannerFont, text of private characters, each of them a layer; of the site Banner Writer.

A character is U+Edpp: d is the dye and pp, in decimal digits, the pattern; pattern 00 is the base.
The character U+CFFF7 stands between the layers of a banner. A text has one banner or several, with
spaces or underscores between them; U+E00A begins a line, and U+E00D to U+E00F mark the direction
and the end.
"""

import re

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.tree import check_count
from drapery.banner.formats.urls import site_address
from drapery.errors import DesignError

NAME = "bannerfont"
TITLE = "BannerFont, characters of the site Banner Writer"
EXAMPLE = "\ue000\U000cfff7\ue804\U000cfff7\ue301"
SOURCE = "https://github.com/electraminer/banner-writer"
HOST = "banner-writer.web.app"
_BETWEEN = "\U000cfff7"
_DYE_TABLE = """
white light_gray gray black yellow orange red brown lime green light_blue cyan blue pink magenta
purple
"""
_DYES = _DYE_TABLE.split()
_PATTERN_TABLE = """
base border bricks circle creeper cross curly_border diagonal_left diagonal_right
diagonal_up_left diagonal_up_right flower globe gradient gradient_up half_horizontal
half_horizontal_bottom half_vertical half_vertical_right mojang piglin rhombus skull small_stripes
square_bottom_left square_bottom_right square_top_left square_top_right straight_cross
stripe_bottom stripe_center stripe_downleft stripe_downright stripe_left stripe_middle
stripe_right stripe_top triangle_bottom triangle_top triangles_bottom triangles_top flow guster
"""
_PATTERNS = _PATTERN_TABLE.split()
_MARKS = re.compile("[\ue00a\ue00d\ue00e\ue00f_\\s]+")
_LAYER = re.compile("[\ue000-\uefff]")


def recognises(text: str) -> bool:
    """Whether the text begins with a character of the font, or is an address with some."""
    return _LAYER.match(_writing(text)) is not None


def read(text: str) -> list[FoundBanner]:
    """All banners of a text, numbered from 1 if there are several.

    Raises DesignError naming the character.
    """
    banners: list[tuple[str, list[Layer]]] = []
    after = ""
    for place, character in enumerate(_writing(text), 1):
        if _MARKS.fullmatch(character) or character == _BETWEEN:
            after = character
            continue
        dye, pattern = _layer(character, place)
        if pattern == "base":
            banners.append((dye, []))
        elif banners and after == _BETWEEN:
            banners[-1][1].append(Layer(pattern, dye))
        else:
            raise DesignError(
                f"character {place}, {_code(character)}: a layer follows U+CFFF7 and its banner's"
                " base, such as U+E000 for white"
            )
        after = character
    if not banners:
        raise DesignError("the text has no base, such as U+E000 for a white banner")
    for _, layers in banners:
        check_count(len(layers), "the text")
    several = len(banners) > 1
    return [
        FoundBanner(Banner(dye, tuple(layers)), f"banner {number}" if several else "")
        for number, (dye, layers) in enumerate(banners, 1)
    ]


def write(banner: Banner) -> str:
    """The characters. Raises DesignError for shields and for patterns that the font lacks."""
    if banner.kind != "banner":
        raise DesignError("BannerFont has no shields: write another form, such as 'give'")
    codes = [_character(banner.base, "base")]
    for number, layer in enumerate(banner.layers, 1):
        if layer.pattern not in _PATTERNS[1:]:
            raise DesignError(
                f"layer {number}: BannerFont has no character for {layer.pattern}; leave the"
                " layer out or write another form, such as 'give'"
            )
        codes.append(_character(layer.dye, layer.pattern))
    return _BETWEEN.join(codes)


def _writing(text: str) -> str:
    """The characters of a text, or those in an address of the site."""
    text = text.strip()
    address = site_address(text, HOST)
    if address is None:
        return _MARKS.sub("", text[:1]) + text[1:]
    query = dict(reversed(address.pairs())).get("writing", "")
    return query or address.path.partition("/image/")[2].removesuffix(".png")


def _layer(character: str, place: int) -> tuple[str, str]:
    code = ord(character)
    tens, ones = code >> 4 & 15, code & 15
    pattern = 10 * tens + ones
    if not 0xE000 <= code <= 0xEFFF or ones > 9 or pattern >= len(_PATTERNS):
        raise DesignError(
            f"character {place}, {_code(character)}: not a layer of BannerFont; copy the text at"
            f" {HOST} again"
        )
    return _DYES[code >> 8 & 15], _PATTERNS[pattern]


def _character(dye: str, pattern: str) -> str:
    tens, ones = divmod(_PATTERNS.index(pattern), 10)
    return chr(0xE000 | _DYES.index(dye) << 8 | tens << 4 | ones)


def _code(character: str) -> str:
    return f"U+{ord(character):04X}"
