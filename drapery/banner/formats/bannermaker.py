"""The code of a banner in the plugin BannerMaker: base64 of `BM`, the byte 2, and a design.

The design is a dye and layers, `red;creeper:black;border:yellow`. The plugin's collections are
YAML, which the form `yaml` reads.
"""

import base64
import binascii
import re

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.tree import check_count
from drapery.banner.names import dye_name, pattern_id, shown
from drapery.errors import DesignError

NAME = "bannermaker"
TITLE = "code of the plugin BannerMaker"
EXAMPLE = "Qk0CcmVkO2NyZWVwZXI6YmxhY2s7Ym9yZGVyOnllbGxvdw=="
SOURCE = "https://github.com/jyhsu2000/BannerMaker"
_HEAD = b"BM\x02"
_CODE = re.compile(r"Qk0C[A-Za-z0-9+/]{4,4000}={0,2}")


def recognises(text: str) -> bool:
    """Whether the text is a code of the plugin."""
    return _CODE.fullmatch(text.strip()) is not None


def parse(text: str) -> Banner:
    """Read a code. Raises DesignError naming the part."""
    code = text.strip()
    try:
        data = base64.b64decode(code.encode("ascii"), validate=True)
        words = data.removeprefix(_HEAD).decode("ascii")
    except (binascii.Error, UnicodeError):
        data, words = b"", ""
    if not data.startswith(_HEAD):
        raise DesignError(f"{shown(code)}: not a whole code of BannerMaker; copy it again")
    base, *layers = words.split(";")
    check_count(len(layers), "the code")
    read = tuple(_layer(layer, f"layer {number}") for number, layer in enumerate(layers, 1))
    return Banner(dye_name(base, "base"), read)


def _layer(text: str, at: str) -> Layer:
    pattern, colon, dye = text.rpartition(":")
    if not colon:
        raise DesignError(f"{at}: {shown(text)} has no dye; copy the code again")
    return Layer(pattern_id(pattern, at), dye_name(dye, at))


def write(banner: Banner) -> str:
    """The code. Raises DesignError for shields."""
    if banner.kind != "banner":
        raise DesignError("BannerMaker has no shields: write another form, such as 'give'")
    words = ";".join([banner.base, *(f"{layer.pattern}:{layer.dye}" for layer in banner.layers)])
    return base64.b64encode(_HEAD + words.encode("ascii")).decode("ascii")
