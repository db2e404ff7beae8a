"""BANNotation, an algebraic notation: `Wh. Bk-Cc. Pi-Tb+Tt.`

The base's dye first, then a dye with one pattern or several, each part ended by a full stop. A base
`Gn+Li-Gx.` is a gradient from green at the top to lime at the bottom.
"""

import re

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.tree import check_count
from drapery.banner.names import shown
from drapery.errors import DesignError

NAME = "bannotation"
TITLE = "BANNotation, an algebraic notation"
EXAMPLE = "Wh. Bk-Cc. Pi-Tb+Tt."
SOURCE = "the notes 'BANNotation' of 2023-12-22"
_DYES = {
    **{"Wh": "white", "Lg": "light_gray", "Gr": "gray", "Bk": "black", "Br": "brown", "Rd": "red"},
    **{"Or": "orange", "Ye": "yellow", "Li": "lime", "Gn": "green", "Cy": "cyan"},
    **{"Lb": "light_blue", "Bl": "blue", "Pu": "purple", "Ma": "magenta", "Pi": "pink"},
}
_TABLE = """
Sb stripe_bottom St stripe_top Sl stripe_left Sr stripe_right Scv stripe_center Sch stripe_middle
Sdw stripe_downright Suw stripe_downleft Sbar small_stripes Sx cross Scr straight_cross
Wtl diagonal_left Wtr diagonal_right Wbl diagonal_up_left Wbr diagonal_up_right
Bl half_vertical Br half_vertical_right Bt half_horizontal Bb half_horizontal_bottom
Bbl square_bottom_left Bbr square_bottom_right Btl square_top_left Btr square_top_right
Tb triangle_bottom Tt triangle_top Tmb triangles_bottom Tmt triangles_top Cc circle Cd rhombus
F border Fw curly_border Cb bricks Gt gradient Gb gradient_up Cr creeper Cs skull Cf flower
Cm mojang Cg globe Cp piglin
"""
_PATTERNS = dict(zip(_TABLE.split()[::2], _TABLE.split()[1::2], strict=True))
_BASE = re.compile(r"([A-Z][a-z])(?:\+([A-Z][a-z])-Gx)?")
_SHAPE = re.compile(
    r"(?:[A-Z][a-z]|[A-Z][a-z]\+[A-Z][a-z]-Gx)\."
    r"(?:\s*[A-Z][a-z]-[A-Z][a-z]*(?:\+[A-Z][a-z]*){0,16}\.?){0,16}"
)


def recognises(text: str) -> bool:
    """Whether the text has the shape of the notation."""
    return len(text) < 400 and _SHAPE.fullmatch(text.strip()) is not None


def parse(text: str) -> Banner:
    """Read the notation. Raises DesignError naming the part."""
    base, *parts = [part.strip() for part in text.strip().rstrip(".").split(".")]
    match = _BASE.fullmatch(base)
    if match is None:
        raise DesignError(f"{shown(base)}: not a base; write a dye and a full stop, such as 'Wh.'")
    layers = [Layer("gradient_up", _dye(match[2], base))] if match[2] else []
    for part in parts:
        dye, dash, patterns = part.partition("-")
        if not dash:
            raise DesignError(f"{shown(part)}: not a layer; write dye-pattern, such as 'Bk-Cc.'")
        layers += [Layer(_pattern(name, part), _dye(dye, part)) for name in patterns.split("+")]
    check_count(len(layers), "the notation")
    return Banner(_dye(match[1], base), tuple(layers))


def _dye(code: str, part: str) -> str:
    if code not in _DYES:
        known = ", ".join(_DYES)
        raise DesignError(f"{shown(part)}: {shown(code)} is not a dye; the sixteen are {known}")
    return _DYES[code]


def _pattern(code: str, part: str) -> str:
    if code not in _PATTERNS:
        raise DesignError(f"{shown(part)}: {shown(code)} is not a pattern, such as 'Cr' or 'Tb'")
    return _PATTERNS[code]


def write(banner: Banner) -> str:
    """The notation. Raises DesignError for shields and for patterns that it has no code for."""
    if banner.kind != "banner":
        raise DesignError("the notation has no shields: write another form, such as 'give'")
    dyes = {dye: code for code, dye in _DYES.items()}
    patterns = {pattern: code for code, pattern in _PATTERNS.items()}
    parts = [dyes[banner.base]]
    for number, layer in enumerate(banner.layers, 1):
        if layer.pattern not in patterns:
            raise DesignError(
                f"layer {number}: the notation has no code for {shown(layer.pattern)};"
                " leave the layer out or write another form"
            )
        parts.append(f"{dyes[layer.dye]}-{patterns[layer.pattern]}")
    return " ".join(f"{part}." for part in parts)
