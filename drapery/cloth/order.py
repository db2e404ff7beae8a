"""The order in which springs are corrected: from the pins outwards.

A correction moves an error to the next spring. In this order one sweep moves it from the top of a
hanging cloth to the free edge; in any other order it moves by about one spring.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.mesh import Array


def pin_distances(cloth: Cloth) -> Array:
    """Distance of each particle from the nearest pin along the springs at rest [m], [N].

    Infinite where no springs lead to a pin; 0 everywhere if nothing is pinned.
    """
    pinned = cloth.inv_mass == 0
    return distances_from(cloth, pinned) if pinned.any() else np.zeros(len(pinned))


def distances_from(cloth: Cloth, sources: NDArray[np.bool_]) -> Array:
    """Distance of each particle from the nearest source along the springs at rest [m], [N].

    Bellman and Ford's relaxation, all springs at once.
    """
    a, b = cloth.spring_pairs.T
    distances = np.where(sources, 0.0, np.inf)
    while True:
        before = distances.copy()
        np.minimum.at(distances, b, before[a] + cloth.spring_length)
        np.minimum.at(distances, a, before[b] + cloth.spring_length)
        if np.array_equal(before, distances):
            return distances


def outwards(distances: Array, pairs: NDArray[np.int32], lengths: Array) -> NDArray[np.int64]:
    """The order of pairs [K, 2] from the pins outwards, stable for pairs at equal distance."""
    reach = np.where(np.isfinite(distances), distances, 0.0)[pairs].sum(axis=1)
    # Equal distances may differ in their last bits; the springs of a row must stay together.
    return np.argsort(np.round(reach / max(lengths.min(initial=np.inf), 1e-12), 3), kind="stable")


def across_then_outwards(cloth: Cloth, springs: NDArray[np.integer]) -> NDArray[np.integer]:
    """These springs [S]: first those across the direction to the pins, then those along it.

    Both are in order outwards from the pins. Alternating rows and columns would make projections
    without a limit unstable on fine grids. The springs of a grid already have a suitable order: all
    rows, then all columns from the top down.
    """
    if cloth.grid_shape is not None:
        return springs
    distances = pin_distances(cloth)
    pairs, lengths = cloth.spring_pairs[springs], cloth.spring_length[springs]
    order = outwards(distances, pairs, lengths)
    finite = np.where(np.isfinite(distances), distances, 0.0)
    along = np.abs(finite[pairs[:, 1]] - finite[pairs[:, 0]]) > 0.5 * lengths
    chosen: NDArray[np.integer] = springs[
        np.concatenate([order[~along[order]], order[along[order]]])
    ]
    return chosen


def sweep_order(cloth: Cloth, springs: NDArray[np.integer]) -> NDArray[np.integer]:
    """These springs [S'] from the pins outwards; springs between two pins are left out."""
    pairs = cloth.spring_pairs[springs]
    order = outwards(pin_distances(cloth), pairs, cloth.spring_length[springs])
    movable = (cloth.inv_mass[pairs] > 0).any(axis=1)
    chosen: NDArray[np.integer] = springs[order[movable[order]]]
    return chosen
