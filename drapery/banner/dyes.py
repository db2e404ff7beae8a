"""The sixteen dyes and the colours they give to a banner's cloth."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Dye:
    """One dye.

    name: its id in commands.
    number: 0 to 15, white is 0.
    rgb: the colour that it gives to a banner's cloth, 8-bit sRGB, as in the game's class
        `DyeColor`.
    """

    name: str
    number: int
    rgb: tuple[int, int, int]


_COLOURS = {
    "white": 0xF9FFFE,
    "orange": 0xF9801D,
    "magenta": 0xC74EBD,
    "light_blue": 0x3AB3DA,
    "yellow": 0xFED83D,
    "lime": 0x80C71F,
    "pink": 0xF38BAA,
    "gray": 0x474F52,
    "light_gray": 0x9D9D97,
    "cyan": 0x169C9C,
    "purple": 0x8932B8,
    "blue": 0x3C44AA,
    "brown": 0x835432,
    "green": 0x5E7C16,
    "red": 0xB02E26,
    "black": 0x1D1D21,
}

DYES: dict[str, Dye] = {
    name: Dye(name, number, (colour >> 16, colour >> 8 & 255, colour & 255))
    for number, (name, colour) in enumerate(_COLOURS.items())
}
"""Every dye by name, in the order of their numbers."""

DYE_NAMES: tuple[str, ...] = tuple(DYES)
"""The names of the sixteen dyes, in the order of their numbers."""
