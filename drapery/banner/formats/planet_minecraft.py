"""Planet Minecraft's banner editor: `planetminecraft.com/banner/?b=2c729cmcf28`.

The code is one character for the base dye, then two for each layer: dye, pattern. A
character stands for its place in the alphabet, from 0; patterns 0 and 1 do not exist.
"""

from drapery.banner.design import MAX_LAYERS, Banner, Layer
from drapery.banner.formats.urls import (
    COLOURS,
    character,
    is_bare_code,
    is_no_word,
    refuse,
    refuse_pattern,
    site_address,
)

NAME = "planet_minecraft"
TITLE = "Planet Minecraft's address"
EXAMPLE = "https://www.planetminecraft.com/banner/?b=2c729cmcf28"
SOURCE = "https://www.planetminecraft.com/banner/"
KINDS = ("banner",)
SITE = "Planet Minecraft"
HOST = "planetminecraft.com"
ALPHABET = "123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0_-"
FIRST_PATTERN = 2
_ORDER = """
border bricks circle creeper cross curly_border diagonal_left diagonal_right flower gradient
half_horizontal half_vertical mojang rhombus skull small_stripes square_bottom_left
square_bottom_right square_top_left square_top_right straight_cross stripe_bottom stripe_center
stripe_downleft stripe_downright stripe_left stripe_middle stripe_right stripe_top
triangles_bottom triangles_top triangle_bottom triangle_top diagonal_up_left diagonal_up_right
gradient_up half_horizontal_bottom half_vertical_right globe piglin flow guster
"""
PATTERN_ORDER = _ORDER.split()
REMEDY = "copy the address from the editor's 'Remix Banner', planetminecraft.com/banner/?b=…"


def recognises(text: str) -> bool:
    """Whether the text is an address of this site, or a code of the editor.

    A code has a digit or a capital, as words have none.
    """
    return site_address(text, HOST) is not None or _is_code(text.strip())


def parse(text: str) -> Banner:
    """Read an address of the editor, or its code alone.

    Raises DesignError for gallery pages, which have no code, and for incomplete codes.
    """
    text = text.strip()
    code = _code(text)
    if len(code) % 2 == 0:
        refuse(SITE, text, f"the code has {len(code)} characters, not an odd number", REMEDY)
    if len(code) > 1 + 2 * MAX_LAYERS:
        refuse(SITE, text, f"the code has {len(code) // 2} layers, over {MAX_LAYERS}", REMEDY)
    layers = tuple(_layer(text, code, place) for place in range(1, len(code), 2))
    return Banner(_dye(text, code, 0), layers)


def write(banner: Banner) -> str:
    """The address that opens the banner in the editor.

    Raises DesignError for patterns that the editor lacks: `base`, and those of data packs.
    """
    code = ALPHABET[COLOURS.index(banner.base)]
    for number, layer in enumerate(banner.layers, 1):
        if layer.pattern not in PATTERN_ORDER:
            refuse_pattern(SITE, number, layer.pattern)
        index = PATTERN_ORDER.index(layer.pattern) + FIRST_PATTERN
        code += ALPHABET[COLOURS.index(layer.dye)] + ALPHABET[index]
    return f"https://www.{HOST}/banner/?b={code}"


def _is_code(text: str) -> bool:
    if not is_bare_code(text, ALPHABET) or not 3 <= len(text) <= 1 + 2 * MAX_LAYERS:
        return False
    dyes, patterns = text[0] + text[1::2], text[2::2]
    known = all(ALPHABET.index(c) < len(COLOURS) for c in dyes) and all(
        FIRST_PATTERN <= ALPHABET.index(c) < FIRST_PATTERN + len(PATTERN_ORDER) for c in patterns
    )
    return known and len(text) % 2 == 1 and is_no_word(text)


def _code(text: str) -> str:
    if is_bare_code(text, ALPHABET):
        return text
    address = site_address(text, HOST)
    if address is None:
        refuse(SITE, text, "neither an address of the site nor a code", REMEDY)
    for name, value in address.pairs():
        if name in ("b", "e") and value:
            return value
    refuse(SITE, text, "the page carries no code (no ?b= or ?e=)", REMEDY)


def _layer(text: str, code: str, place: int) -> Layer:
    index = _index(text, code, place + 1) - FIRST_PATTERN
    if not 0 <= index < len(PATTERN_ORDER):
        refuse(SITE, text, f"{character(code, place + 1)} is not the code of a pattern", REMEDY)
    return Layer(PATTERN_ORDER[index], _dye(text, code, place))


def _dye(text: str, code: str, place: int) -> str:
    index = _index(text, code, place)
    if index >= len(COLOURS):
        refuse(SITE, text, f"{character(code, place)} is not the code of a dye", REMEDY)
    return COLOURS[index]


def _index(text: str, code: str, place: int) -> int:
    index = ALPHABET.find(code[place])
    if index < 0:
        refuse(SITE, text, f"{character(code, place)} is not in the site's alphabet", REMEDY)
    return index
