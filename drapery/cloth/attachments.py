"""Attachments: pairs of particles that may not be farther apart than a longest length.

Provot (1995) shortens each long spring in turn. One sweep moves an error by one spring, so twenty
sweeps are not enough on fine grids. Three corrections move it farther. They are made in this order:

1. Long-range attachments bound the distance of each particle from its pins (Kim, Chentanez, Müller,
   "Long range attachments", SCA 2012).
2. Attachments over 2, 4, 8, … cells bound the distance between particles that are far apart on the
   cloth, the longest first (after Müller, "Hierarchical position based dynamics", VRIPHYS 2008).
3. The springs are corrected from the pins outwards. One sweep then moves an error from the top of a
   hanging cloth to its free edge.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import STRUCTURAL, Cloth
from drapery.cloth.order import across_then_outwards, distances_from, pin_distances
from drapery.mesh import Array

FEW_PINS = 4
"""Particles are attached to every pin if there are no more than this, else to the nearest."""

MAX_LEVELS = 16
"""The longest attachments span 2^16 springs."""


class Attachments(NamedTuple):
    """Pairs in the order of correction, with the share of the correction that each end takes.

    pairs: [K, 2]. longest: [m], [K]. share_i, share_j: [K].
    """

    pairs: NDArray[np.int32]
    longest: Array
    share_i: Array
    share_j: Array


def stretch_limits(cloth: Cloth, limit: float, sweeps: int) -> Attachments:
    """Attachments that limit a cloth's structural springs to `limit` times their rest length."""
    groups = attachment_groups(cloth, limit, sweeps)
    return (
        concatenated(groups) if groups else shared(cloth, np.zeros((0, 2), np.int32), np.zeros(0))
    )


def attachment_groups(cloth: Cloth, limit: float, sweeps: int) -> list[Attachments]:
    """Groups in the order of correction; an empty list for 0 sweeps.

    Attachments to the pins come first, then long attachments, the longest first, then the springs,
    once a sweep. The attachments to the pins come again at the end, to remove the stretch next to
    the pins.
    """
    if sweeps == 0:
        return []
    springs = across_then_outwards(cloth, np.flatnonzero(cloth.spring_kind == STRUCTURAL))
    fine = cloth.spring_pairs[springs], limit * cloth.spring_length[springs]
    held = long_range_attachments(cloth, limit)
    groups = [held, *_long_attachments(cloth, limit), *[fine] * sweeps, held]
    return [shared(cloth, *group) for group in groups]


def concatenated(groups: Sequence[Attachments]) -> Attachments:
    """All groups as one, in their order."""
    pairs, longest, share_i, share_j = zip(*groups, strict=True)
    return Attachments(
        np.concatenate(pairs),
        np.concatenate(longest),
        np.concatenate(share_i),
        np.concatenate(share_j),
    )


def shared(cloth: Cloth, pairs: NDArray[np.int32], longest: Array) -> Attachments:
    """Attachments whose ends share a correction by inverse mass; pinned ends take none."""
    w = cloth.inv_mass[pairs]
    total = w.sum(axis=1)
    free = total > 0
    shares = w[free] / total[free, None]
    pairs = pairs[free].astype(np.int32)
    return Attachments(pairs, longest[free], shares[:, 0].copy(), shares[:, 1].copy())


def long_range_attachments(cloth: Cloth, slack: float) -> tuple[NDArray[np.int32], Array]:
    """Pin and particle pairs [K, 2] and the farthest they may be apart [m], [K].

    slack: that distance over the distance on the cloth at rest. It should be at least the factor by
    which springs may stretch. Otherwise the attachments carry the cloth's weight instead of the
    springs, and each particle swings separately and too fast.
    """
    pins = np.flatnonzero(cloth.inv_mass == 0)
    free = np.flatnonzero(cloth.inv_mass > 0)
    if not len(pins):
        return np.zeros((0, 2), np.int32), np.zeros(0)
    if len(pins) <= FEW_PINS:
        pairs = np.stack([np.repeat(pins, len(free)), np.tile(free, len(pins))], axis=1)
    else:
        pairs = np.stack([nearest_pins(cloth)[free], free], axis=1)
    max_distance = np.empty(len(pairs))
    for pin in sorted(set(pairs[:, 0].tolist())):  # np.unique would import numpy.ma
        mine = pairs[:, 0] == pin
        max_distance[mine] = _max_distances(cloth, pin, pairs[mine, 1])
    found = np.isfinite(max_distance)
    return pairs[found].astype(np.int32), slack * max_distance[found]


def _max_distances(cloth: Cloth, pin: int, particles: NDArray[np.integer]) -> Array:
    """Distance of particles from a pin over the cloth at rest [m].

    On a flat grid it is the straight distance. Elsewhere it is the distance along the springs; it
    is never too short and may be slightly too long.
    """
    if cloth.grid_shape is not None and _is_flat(cloth):
        away: Array = cloth.rest_positions[particles] - cloth.rest_positions[pin]
        lengths: Array = np.sqrt((away * away).sum(axis=1))
        return lengths
    along: Array = distances_from(cloth, np.arange(len(cloth.inv_mass)) == pin)[particles]
    return along


def _is_flat(cloth: Cloth) -> bool:
    """Whether a grid's corners and rest lengths are those of a flat rectangle."""
    assert cloth.grid_shape is not None
    rows, columns = cloth.grid_shape
    x = cloth.rest_positions.reshape(rows, columns, 3)
    across, down = x[0, -1] - x[0, 0], x[-1, 0] - x[0, 0]
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows))
    flat = x[0, 0] + u[..., None] * across + v[..., None] * down
    return bool(np.abs(x - flat).max() <= 1e-9 * (np.abs(across).max() + np.abs(down).max()))


def nearest_pins(cloth: Cloth) -> NDArray[np.int64]:
    """The index of the pin nearest to each particle at rest, in a straight line, [N]."""
    pins = np.flatnonzero(cloth.inv_mass == 0)
    best = np.full(len(cloth.inv_mass), np.inf)
    nearest = np.zeros(len(best), np.int64)
    for pin in pins:
        away = ((cloth.rest_positions - cloth.rest_positions[pin]) ** 2).sum(axis=1)
        nearer = away < best * (1 - 1e-9)
        best[nearer], nearest[nearer] = away[nearer], pin
    return nearest


def _long_attachments(cloth: Cloth, limit: float) -> list[tuple[NDArray[np.int32], Array]]:
    """Pairs and longest distances over 2^n springs, the longest first."""
    if cloth.grid_shape is None:
        return _path_attachments(cloth, limit)
    index = np.arange(len(cloth.inv_mass), dtype=np.int32).reshape(cloth.grid_shape)
    stride, groups = 2, []
    while 2 * stride < max(cloth.grid_shape):
        pairs = np.concatenate(
            [
                np.stack([index[:, :-stride].ravel(), index[:, stride:].ravel()], axis=1),
                np.stack([index[:-stride].ravel(), index[stride:].ravel()], axis=1),
            ]
        )
        groups.append((pairs, limit * _path_lengths(cloth, pairs, stride)))
        stride *= 2
    return groups[::-1]


def _path_attachments(cloth: Cloth, limit: float) -> list[tuple[NDArray[np.int32], Array]]:
    """The same for any cloth: each particle and that 2^n springs up its shortest path to a pin."""
    if not (cloth.inv_mass == 0).any():
        return []
    distances = pin_distances(cloth)
    above = _next_towards_pins(cloth, distances)
    groups: list[tuple[NDArray[np.int32], Array]] = []
    while True:
        above = above[above]
        below = np.flatnonzero((cloth.inv_mass[above] > 0) & np.isfinite(distances))
        if not len(below) or len(groups) == MAX_LEVELS:
            return groups[::-1]
        below = below[np.argsort(distances[below], kind="stable")]
        pairs = np.stack([above[below], below], axis=1).astype(np.int32)
        groups.append((pairs, limit * (distances[below] - distances[above[below]])))


def _next_towards_pins(cloth: Cloth, distances: Array) -> NDArray[np.int64]:
    """For each particle its neighbour on the shortest path to a pin, [N]; itself for pins."""
    a, b = np.concatenate([cloth.spring_pairs, cloth.spring_pairs[:, ::-1]]).T
    lengths = np.tile(cloth.spring_length, 2)
    shortest = np.isfinite(distances[a]) & (distances[a] + lengths <= distances[b] * (1 + 1e-12))
    towards = np.arange(len(distances))
    # In reverse order, so that the first of several springs is the one that stays.
    towards[b[shortest][::-1]] = a[shortest][::-1]
    pinned = np.flatnonzero(cloth.inv_mass == 0)
    towards[pinned] = pinned
    return towards


def _path_lengths(cloth: Cloth, pairs: NDArray[np.int32], stride: int) -> Array:
    """Length at rest along a grid's row or column between particles `stride` apart [m]."""
    a, b = pairs.T
    step = (b - a) // stride
    x = cloth.rest_positions
    lengths = np.zeros(len(pairs))
    for i in range(stride):
        lengths += np.linalg.norm(x[a + (i + 1) * step] - x[a + i * step], axis=1)
    return lengths
