"""Self-collision: particles of a cloth stay at least a thickness apart.

Particles are sorted into the cells of a spatial hash (Teschner et al. 2003, "Optimized spatial
hashing for collision detection of deformable objects"), and pairs that are too near are pushed
apart along the line between them, one after another in the order of their indices. Only particles
are tested, so the thickness should be about the distance between neighbours, not less.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.errors import OptionError
from drapery.jit import entry_point, kernel
from drapery.mesh import Array

PASSES = 4
PRIMES = (73856093, 19349663, 83492791)
"""Teschner's primes for the three cell coordinates."""


class SelfContact(NamedTuple):
    """What self-collision needs of a cloth.

    thickness: least distance [m] between particles.
    first, excluded: excluded[first[i] : first[i+1]] are the particles that may be nearer to i.
    inv_mass: [1/kg], shape [N].
    """

    thickness: float
    first: NDArray[np.int32]
    excluded: NDArray[np.int32]
    inv_mass: Array


def self_contact(cloth: Cloth, thickness: float) -> SelfContact:
    """Self-collision of a cloth, without the ends of springs and pairs that are nearer at rest.

    thickness: least distance between other particles [m]. Raises OptionError unless it is above 0.
    """
    if not 0 < thickness < np.inf:
        raise OptionError(
            f"self-collision thickness {thickness} is out of range; use a length above 0 [m]"
        )
    from scipy.spatial import cKDTree

    rest = np.asarray(cloth.rest_positions, float)
    near = cKDTree(rest).query_pairs(thickness, output_type="ndarray")
    pairs = np.concatenate([np.asarray(cloth.spring_pairs), near])
    ends = np.unique(np.concatenate([pairs, pairs[:, ::-1]]).astype(np.int32), axis=0)
    first = np.searchsorted(ends[:, 0], np.arange(len(rest) + 1)).astype(np.int32)
    inv_mass = np.ascontiguousarray(cloth.inv_mass, float)
    return SelfContact(float(thickness), first, np.ascontiguousarray(ends[:, 1]), inv_mass)


@entry_point
def separate_all(x: Array, v: Array, begin: int, end: int, contact: SelfContact) -> None:
    """Separate the particles of cloths begin..end of a batch, and stop their approach.

    x, v: positions [m] and velocities [m/s], shape [B, N, 3], changed in place.
    """
    for cloth in range(begin, end):
        for _ in range(PASSES):
            if separate_pass(x[cloth], v[cloth], contact) == 0:
                break


@kernel
def separate_pass(x: Array, v: Array, contact: SelfContact) -> int:
    """Push apart every pair found in the hash once; returns how many pairs were too near."""
    cells = cells_of(x, contact.thickness)
    starts, members = hashed(cells)
    found = 0
    for i in range(len(x)):
        for a in range(-1, 2):
            for b in range(-1, 2):
                for c in range(-1, 2):
                    key = key_of(cells[i, 0] + a, cells[i, 1] + b, cells[i, 2] + c, len(starts) - 1)
                    for place in range(starts[key], starts[key + 1]):
                        j = members[place]
                        if j > i and not is_excluded(i, j, contact):
                            found += push_apart(x, v, i, j, contact)
    return found


@kernel
def cells_of(x: Array, size: float) -> NDArray[np.int64]:
    cells = np.empty(x.shape, np.int64)
    for i in range(len(x)):
        for axis in range(3):
            cells[i, axis] = int(np.floor(x[i, axis] / size))
    return cells


@kernel
def key_of(a: int, b: int, c: int, slots: int) -> int:
    return ((a * PRIMES[0]) ^ (b * PRIMES[1]) ^ (c * PRIMES[2])) % slots


@kernel
def hashed(cells: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Counting sort of the particles by key; equal keys stay in the order of their indices."""
    count = len(cells)
    slots = 2 * count + 1
    starts = np.zeros(slots + 1, np.int64)
    keys = np.empty(count, np.int64)
    for i in range(count):
        keys[i] = key_of(cells[i, 0], cells[i, 1], cells[i, 2], slots)
        starts[keys[i] + 1] += 1
    for slot in range(slots):
        starts[slot + 1] += starts[slot]
    fill, members = starts[:-1].copy(), np.empty(count, np.int64)
    for i in range(count):
        members[fill[keys[i]]] = i
        fill[keys[i]] += 1
    return starts, members


@kernel
def is_excluded(i: int, j: int, contact: SelfContact) -> bool:
    """Whether particles i and j may be nearer than the thickness; excluded ones are sorted."""
    for place in range(contact.first[i], contact.first[i + 1]):
        if contact.excluded[place] >= j:
            return bool(contact.excluded[place] == j)
    return False


@kernel
def push_apart(x: Array, v: Array, i: int, j: int, contact: SelfContact) -> int:
    """Share the missing distance, and the approach speed, by inverse mass."""
    thickness, inv_mass = contact.thickness, contact.inv_mass
    dx, dy, dz = x[j, 0] - x[i, 0], x[j, 1] - x[i, 1], x[j, 2] - x[i, 2]
    square = dx * dx + dy * dy + dz * dz
    total = inv_mass[i] + inv_mass[j]
    if square >= thickness * thickness or total == 0.0:
        return 0
    length = np.sqrt(square)
    n = (dx / length, dy / length, dz / length) if length > 0.0 else (0.0, 0.0, 1.0)
    approach = 0.0
    for axis in range(3):
        approach += (v[j, axis] - v[i, axis]) * n[axis]
    stop = min(approach, 0.0)
    for axis in range(3):
        push = (thickness - length) * n[axis] / total
        x[i, axis] -= inv_mass[i] * push
        x[j, axis] += inv_mass[j] * push
        v[i, axis] += inv_mass[i] / total * stop * n[axis]
        v[j, axis] -= inv_mass[j] / total * stop * n[axis]
    return 1
