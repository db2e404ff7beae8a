"""minecraft.tools: `minecraft.tools/en/banner.php?color_id_0=4&shape_id_1=28&color_id_1=15`.

`color_id_0` is the base; layer N has `shape_id_N` and `color_id_N`. Shape 0 is no layer.
"""

import re
from typing import Literal

from drapery.banner.design import MAX_LAYERS, Banner, Layer
from drapery.banner.formats.urls import (
    COLOURS,
    Address,
    refuse,
    refuse_pattern,
    site_address,
    split_address,
)
from drapery.banner.patterns import BY_CODE

NAME = "minecraft_tools"
TITLE = "minecraft.tools' address"
EXAMPLE = "https://minecraft.tools/en/banner.php?color_id_0=4&shape_id_1=28&color_id_1=15"
SOURCE = "https://minecraft.tools/en/banner.php"
KINDS = ("banner", "shield")
SITE = "minecraft.tools"
HOST = "minecraft.tools"
_ORDER = """
mc bl br tl tr hh bs ts vh ls cs rs ms sc dls drs cr ld rud tt bt mr tts bts cbo bo ss bri
gra cre sku flo moj lud rd gru hhb vhr glb pig
"""
PATTERN_ORDER = [BY_CODE[code].name for code in _ORDER.split()]
REMEDY = "copy the address of the banner editor, minecraft.tools/en/banner.php?color_id_0=…"
_PARAMETER = re.compile(r"(color|shape)_id_(0|[1-9][0-9]?)")


def recognises(text: str) -> bool:
    """Whether the text is an address of this site, or the parameters of its editor."""
    if text.lstrip("? \n").startswith(("color_id_", "shape_id_")):
        return True
    address = split_address(text)
    return address is not None and (address.host == HOST or address.host.endswith("." + HOST))


def parse(text: str) -> Banner:
    """Read an address of the editor of banners or shields, or its parameters alone.

    Raises DesignError for gallery pages and for numbers without a meaning.
    """
    text = text.strip()
    address = _address(text)
    numbers = _numbers(text, address)
    shapes = sorted(key[1] for key, value in numbers.items() if key[0] == "shape" and value)
    if len(shapes) > MAX_LAYERS:
        refuse(SITE, text, f"{len(shapes)} layers, over {MAX_LAYERS}", REMEDY)
    layers = tuple(_layer(text, numbers, n) for n in shapes)
    kind: Literal["banner", "shield"] = "shield" if "shield" in address.path else "banner"
    return Banner(_dye(text, numbers, 0), layers, kind)


def write(banner: Banner) -> str:
    """The address that opens the banner or shield in its editor.

    Raises DesignError for patterns that the editor lacks: `base`, `flow`, `guster`, and those
    of data packs.
    """
    query = f"color_id_0={COLOURS.index(banner.base)}"
    for number, layer in enumerate(banner.layers, 1):
        if layer.pattern not in PATTERN_ORDER:
            refuse_pattern(SITE, number, layer.pattern)
        shape = PATTERN_ORDER.index(layer.pattern) + 1
        query += f"&shape_id_{number}={shape}&color_id_{number}={COLOURS.index(layer.dye)}"
    return f"https://{HOST}/en/{banner.kind}.php?{query}"


def _address(text: str) -> Address:
    bare = text.lstrip("?").startswith(("color_id_", "shape_id_"))
    address = split_address(f"{HOST}/?{text.lstrip('?')}") if bare else site_address(text, HOST)
    if address is None:
        refuse(SITE, text, "not an address of the site", REMEDY)
    return address


def _numbers(text: str, address: Address) -> dict[tuple[str, int], int]:
    """The parameters by kind and layer."""
    numbers = {}
    for name, value in address.pairs():
        if match := _PARAMETER.fullmatch(name):
            numbers[match[1], int(match[2])] = _number(text, name, value)
    if not numbers:
        refuse(SITE, text, "the page carries no design (no color_id_0=)", REMEDY)
    return numbers


def _number(text: str, name: str, value: str) -> int:
    if not re.fullmatch("[0-9]{1,3}", value):
        refuse(SITE, text, f"{name} is {value[:9]!r}, not a small number", REMEDY)
    return int(value)


def _layer(text: str, numbers: dict[tuple[str, int], int], layer: int) -> Layer:
    shape = numbers["shape", layer]
    if shape > len(PATTERN_ORDER):
        place = f"shape_id_{layer}={shape} is not a pattern (1 to {len(PATTERN_ORDER)})"
        refuse(SITE, text, place, REMEDY)
    return Layer(PATTERN_ORDER[shape - 1], _dye(text, numbers, layer))


def _dye(text: str, numbers: dict[tuple[str, int], int], layer: int) -> str:
    index = numbers.get(("color", layer))
    if index is None:
        refuse(SITE, text, f"color_id_{layer} is missing", REMEDY)
    if index >= len(COLOURS):
        refuse(SITE, text, f"color_id_{layer}={index} is not a dye (0 to 15)", REMEDY)
    return COLOURS[index]
