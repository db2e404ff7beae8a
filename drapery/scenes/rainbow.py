"""Random banners in the colours of the rainbow, and where each stands in a cube of banners."""

import numpy as np
from numpy.typing import NDArray

from drapery.banner import PATTERN_NAMES, Banner, Layer

RAINBOW = (
    *("red", "orange", "yellow", "lime", "green", "cyan", "light_blue", "blue"),
    *("purple", "magenta", "pink"),
)
VARIANTS = 6
"""Different banners in each colour of the rainbow."""


def rainbow_banners(layers: int, seed: int) -> tuple[Banner, ...]:
    """VARIANTS banners in each colour. layers: patterns on each banner. seed: chooses them."""
    random = np.random.default_rng(seed)
    return tuple(_any_banner(dye, random, layers) for dye in RAINBOW for _ in range(VARIANTS))


def numbers_in_cube(side: int) -> NDArray[np.int32]:
    """The number of the banner at each place of a cube, shape [side³].

    Colours change from corner to corner. side: banners along each edge.
    """
    x, y, z = np.indices((side, side, side)).reshape(3, -1)
    band = (x + side - 1 - y + z) * len(RAINBOW) // (3 * side - 2)
    return (VARIANTS * band + (x + 2 * y + z) % VARIANTS).astype(np.int32)


def _any_banner(base: str, random: np.random.Generator, layers: int) -> Banner:
    """Random patterns in dyes beside the base dye in the rainbow, the last in black or white."""
    place = RAINBOW.index(base)
    neighbours = [RAINBOW[(place + step) % len(RAINBOW)] for step in (-1, 1, -2, 2)]
    dyes = [
        *(neighbours[step % 4] for step in range(layers - 1)),
        random.choice(["white", "black"]),
    ]
    patterns = random.choice(PATTERN_NAMES[1:], layers)
    pairs = zip(patterns, dyes, strict=False)
    return Banner(base, tuple(Layer(str(p), str(d)) for p, d in pairs))
