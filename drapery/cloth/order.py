"""In which order springs are corrected: from the pins down.

A correction hands its error on to the next spring. Going outwards from the pins, one sweep
carries it from the top of a hanging cloth to its free edge; in any other order it travels about
one spring a sweep.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.mesh import Array


def pin_distances(cloth: Cloth) -> Array:
    """Distance of each particle from the nearest pin along the springs at rest [m], shape [N].

    Infinite where no pin is in reach; 0 everywhere if nothing is pinned.
    """
    pinned = cloth.inv_mass == 0
    if not pinned.any():
        return np.zeros(len(pinned))
    a, b = cloth.spring_pairs.T
    distances = np.where(pinned, 0.0, np.inf)
    while True:
        before = distances.copy()
        np.minimum.at(distances, b, before[a] + cloth.spring_length)
        np.minimum.at(distances, a, before[b] + cloth.spring_length)
        if np.array_equal(before, distances):
            return distances


def sweep_order(cloth: Cloth, springs: NDArray[np.integer]) -> NDArray[np.integer]:
    """These springs [S'] from the pins outwards; springs between two pins are left out."""
    distances = pin_distances(cloth)
    a, b = cloth.spring_pairs[springs].T
    movable = (cloth.inv_mass[a] > 0) | (cloth.inv_mass[b] > 0)
    reach = distances[a] + distances[b]
    # Distances of equal depth differ in their last bits; a grid row must not fall apart.
    depth = np.round(reach / max(cloth.spring_length.min(), 1e-12), 3)
    order = springs[np.argsort(depth, kind="stable")]
    return order[movable[np.argsort(depth, kind="stable")]]
