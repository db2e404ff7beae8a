"""A tile of blue noise: thresholds whose neighbours differ as much as they can.

The method is Ulichney's ("The void-and-cluster method for dither array generation", 1993). All
sums are of whole numbers, so that the tile has the same bits everywhere.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from drapery.elementary import exp

SIDE = 32
"""Side of the tile [pixels]."""
LEVELS = 32
"""Different thresholds in the tile."""
SPREAD = 1.5
"""Standard deviation of the weights of neighbours [pixels]."""
FIRST = SIDE * SIDE // 10
"""Points of the first pattern."""


@cache
def blue_noise() -> NDArray[np.int32]:
    """Thresholds 0..LEVELS - 1, each as frequent, shape [SIDE, SIDE]."""
    tile: NDArray[np.int32] = (_ranks() * LEVELS // (SIDE * SIDE)).astype(np.int32)
    tile.flags.writeable = False
    return tile


def _ranks() -> NDArray[np.int64]:
    """In which order the points of the tile are set, 0..SIDE² - 1."""
    pattern, energy = _even_pattern()
    ranks = np.zeros((SIDE, SIDE), np.int64)
    removed, thinned = pattern.copy(), energy.copy()
    for rank in range(FIRST - 1, -1, -1):
        place = _extreme(thinned, removed, 1)
        _toggle(removed, thinned, place)
        ranks[place] = rank
    for rank in range(FIRST, SIDE * SIDE):
        place = _extreme(energy, ~pattern, -1)
        _toggle(pattern, energy, place)
        ranks[place] = rank
    return ranks


def _even_pattern() -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """FIRST points spread evenly, and the energy that they have at each place."""
    pattern = np.zeros((SIDE, SIDE), np.bool_)
    energy = np.zeros((SIDE, SIDE), np.int64)
    for number in np.random.default_rng(0).permutation(SIDE * SIDE)[:FIRST]:
        _toggle(pattern, energy, divmod(int(number), SIDE))
    while True:
        cluster = _extreme(energy, pattern, 1)
        _toggle(pattern, energy, cluster)
        void = _extreme(energy, ~pattern, -1)
        _toggle(pattern, energy, void)
        if void == cluster:
            return pattern, energy


def _extreme(energy: NDArray[np.int64], among: NDArray[np.bool_], sign: int) -> tuple[int, int]:
    """The place of the greatest energy among some (sign 1), or of the least (sign -1)."""
    lowest = np.iinfo(np.int64).min
    return divmod(int(np.argmax(np.where(among, sign * energy, lowest))), SIDE)


def _toggle(pattern: NDArray[np.bool_], energy: NDArray[np.int64], place: tuple[int, int]) -> None:
    """Set a point, or take it away."""
    moved = np.roll(_weights(), place, (0, 1))
    energy += -moved if pattern[place] else moved
    pattern[place] = not pattern[place]


@cache
def _weights() -> NDArray[np.int64]:
    """The energy around a point at the corner of the tile, which repeats."""
    away = np.minimum(np.arange(SIDE), SIDE - np.arange(SIDE))
    squares = away[:, None] ** 2 + away[None] ** 2
    weights = (1 << 20) * exp(-squares / (2 * SPREAD**2))
    whole: NDArray[np.int64] = np.rint(weights).astype(np.int64)
    return whole
