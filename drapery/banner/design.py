"""What a banner is: a base dye and layers of (pattern, dye), in the order they were loomed."""

from dataclasses import dataclass

from drapery.banner.dyes import DYES
from drapery.errors import DesignError

MAX_LAYERS = 16
"""The most layers that a command can give; the loom stops at six."""

LOOM_LAYERS = 6


@dataclass(frozen=True)
class Layer:
    """One pattern in one dye.

    pattern: the id without `minecraft:`, or `namespace:path` for a pattern of a data pack.
    dye: one of the sixteen dye names.
    """

    pattern: str
    dye: str

    def __post_init__(self) -> None:
        if self.dye not in DYES:
            raise DesignError(f"dye {self.dye!r} is none of the sixteen: {', '.join(DYES)}")


@dataclass(frozen=True)
class Banner:
    """A design: its base dye and up to sixteen layers, lowest first.

    Raises DesignError for an unknown dye or more than sixteen layers.
    """

    base: str = "white"
    layers: tuple[Layer, ...] = ()

    def __post_init__(self) -> None:
        if self.base not in DYES:
            raise DesignError(f"base dye {self.base!r} is none of the sixteen: {', '.join(DYES)}")
        if len(self.layers) > MAX_LAYERS:
            raise DesignError(
                f"the banner has {len(self.layers)} layers; the game shows at most {MAX_LAYERS}:"
                " leave some out"
            )

    @staticmethod
    def parse(text: str) -> "Banner":
        """Read a banner from any form that `drapery.banner.formats` knows.

        Raises DesignError, naming the place in the text and the remedy.
        """
        from drapery.banner.formats import parse_banner

        return parse_banner(text)
