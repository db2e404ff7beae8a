"""The design of a banner: a base dye and layers of (pattern, dye), lowest first."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from drapery.banner.dyes import DYES
from drapery.banner.names import dye_name, is_custom, pattern_id, shown
from drapery.banner.patterns import PATTERNS
from drapery.errors import DesignError

MAX_LAYERS = 16
"""The most layers that a command can give."""

LOOM_LAYERS = 6
"""The most layers that the loom makes."""


@dataclass(frozen=True)
class Layer:
    """One pattern in one dye. Other known names of a pattern or dye are converted.

    pattern: the id without `minecraft:`, or `namespace:path` for a pattern of a data pack.
    dye: one of the sixteen dye names.

    Raises DesignError for an unknown name.
    """

    pattern: str
    dye: str

    def __post_init__(self) -> None:
        if self.pattern not in PATTERNS and not is_custom(self.pattern):
            object.__setattr__(self, "pattern", pattern_id(self.pattern))
        if self.dye not in DYES:
            object.__setattr__(self, "dye", dye_name(self.dye))


@dataclass(frozen=True)
class Banner:
    """A design: its base dye and up to sixteen layers, lowest first.

    base: one of the sixteen dye names.
    layers: lowest first.
    kind: a banner or a shield.

    Raises DesignError for an unknown dye, a layer that is not a Layer, or more than sixteen.
    """

    base: str = "white"
    layers: tuple[Layer, ...] = ()
    kind: Literal["banner", "shield"] = "banner"

    def __post_init__(self) -> None:
        object.__setattr__(self, "layers", tuple(self.layers))
        if self.base not in DYES:
            object.__setattr__(self, "base", dye_name(self.base, "base"))
        _check_layers(self.layers)
        if len(self.layers) > MAX_LAYERS:
            raise DesignError(
                f"the banner has {len(self.layers)} layers; the game shows at most {MAX_LAYERS}:"
                " leave some out"
            )

    @staticmethod
    def parse(text: str) -> "Banner":
        """The banner of a text in any form that `drapery.banner.formats` knows.

        Raises DesignError, naming the place in the text and the remedy.
        """
        return _parsers[-1](text)


def use_parser(parser: Callable[[str], Banner]) -> None:
    """Set the function that `Banner.parse` calls; `drapery.banner` does so when it is imported.

    The forms import this module to build banners, so this module cannot import the forms.
    """
    _parsers.append(parser)


_parsers: list[Callable[[str], Banner]] = []


def _check_layers(layers: tuple[object, ...]) -> None:
    for number, layer in enumerate(layers, 1):
        if not isinstance(layer, Layer):
            raise DesignError(f"layer {number} is {shown(layer)}; write Layer('creeper', 'lime')")
