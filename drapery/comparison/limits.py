"""The limits of a comparison, whose names are the same in commands, goldens, cases and defaults."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from drapery.option import Option

Box = tuple[int, int, int, int]
"""Left, top, width and height [px]."""


def is_box(value: object) -> bool:
    """Whether a value is four whole numbers."""
    return (
        isinstance(value, tuple | list)
        and len(value) == 4
        and all(isinstance(number, int) and not isinstance(number, bool) for number in value)
    )


def _is_picture(value: object) -> bool:
    """Whether a value is a picture of a program, and not the path of one."""
    return value is not None and not isinstance(value, str | Path)


_TABLE = (
    Option("tolerance", "Channel errors up to this do not count", int, 0, bounds=(0, 255)),
    Option("pixels", "Number of pixels that may differ more", int, 0, bounds=(0, 1 << 28)),
    Option("ratio", "Share of the pixels that may differ more", float, 0.0, bounds=(0, 1)),
    Option(
        "colour",
        "Only perceived differences above this count; 0.1 is usual",
        float,
        default_text="all count",
        bounds=(0, 1),
    ),
    Option(
        "antialiasing",
        "Whether pixels of smoothed edges count",
        bool,
        True,
        flag="--antialiasing/--no-antialiasing",
    ),
    Option(
        "ignore",
        "A box of pixels that does not count",
        str,
        (),
        several=True,
        takes=is_box,
        metavar="X,Y,W,H",
    ),
    Option(
        "mask",
        "A picture whose bright pixels do not count",
        Path,
        default_text="all count",
        takes=_is_picture,
        metavar="FILE",
    ),
    Option("flip", "Largest mean FLIP error", float, default_text="any", bounds=(0, 1)),
    Option("ssim", "Least structural similarity", float, default_text="any", bounds=(0, 1)),
    Option("ciede2000", "Largest mean CIEDE2000", float, default_text="any", bounds=(0, 200)),
)

LIMIT_OPTIONS: Mapping[str, Option] = MappingProxyType({option.name: option for option in _TABLE})
"""How much two pictures may differ."""
