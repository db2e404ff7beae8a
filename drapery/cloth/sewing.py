"""Several cloths sewn into one."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Integers
from drapery.cloth.bending import Bending
from drapery.cloth.cloth import Cloth
from drapery.errors import OptionError, counted


class Seam(NamedTuple):
    """Pairs of particles of two cloths; `sew` merges each pair into one particle.

    first: index of the one cloth in the list given to `sew`.
    first_particles: its particles, shape [K].
    second: index of the other cloth.
    second_particles: its particles, shape [K]; the k-th is merged with the k-th of the first.
    """

    first: int
    first_particles: Sequence[int] | Integers
    second: int
    second_particles: Sequence[int] | Integers


def sew(cloths: Sequence[Cloth], seams: Sequence[Seam] = ()) -> Cloth:
    """Join several cloths into one; the two particles of each pair in a seam become one.

    A merged particle has the mean rest position, the sum of the masses and the UVs of the first of
    its particles; it is pinned if any of them is. Springs keep their lengths; of two springs that
    join the same particles only the first stays. A seam does not resist bending.

    cloths: all of the same drag, and those with bending of the same damping.
    seams: each two cloths and the pairs of their particles.

    Raises OptionError for cloths that differ in these, and for particles that do not exist.
    """
    if not cloths:
        raise OptionError("nothing to sew: give at least one cloth")
    drags = sorted({cloth.drag for cloth in cloths})
    if len(drags) > 1:
        raise OptionError(
            f"sewn cloths have drags of {drags[0]:g} and {drags[-1]:g} 1/s; give all the same drag"
        )
    starts = _starts(cloths)
    number = np.concatenate(sewn_particles(cloths, seams))
    count = int(number.max()) + 1
    places = np.concatenate([cloth.rest_positions for cloth in cloths])
    rest = np.zeros((count, 3))
    np.add.at(rest, number, places)
    rest /= np.bincount(number, minlength=count)[:, None]
    first = np.full(count, len(number))
    np.minimum.at(first, number, np.arange(len(number)))
    pairs, kept = _sewn_springs(cloths, starts, number)
    return Cloth(
        rest_positions=rest,
        inv_mass=_sewn_masses(np.concatenate([cloth.inv_mass for cloth in cloths]), number, count),
        spring_pairs=pairs,
        spring_length=np.concatenate([cloth.spring_length for cloth in cloths])[kept],
        spring_stiffness=np.concatenate([cloth.spring_stiffness for cloth in cloths])[kept],
        spring_kind=np.concatenate([cloth.spring_kind for cloth in cloths])[kept],
        bending=_sewn_bending(cloths, starts, number),
        triangles=_sewn_triangles(cloths, starts, number),
        uvs=np.concatenate([cloth.uvs for cloth in cloths])[first],
        drag=drags[0],
    )


def sewn_particles(cloths: Sequence[Cloth], seams: Sequence[Seam] = ()) -> list[NDArray[np.int64]]:
    """The particle of the sewn cloth that each particle of each cloth becomes. Raises OptionError.

    cloths, seams: those of `sew`.
    """
    starts = _starts(cloths)
    number = _merged(int(starts[-1]), _pairs(cloths, starts, seams))
    return np.split(number, starts[1:-1])


def _starts(cloths: Sequence[Cloth]) -> NDArray[np.int64]:
    return np.cumsum([0, *(len(cloth.inv_mass) for cloth in cloths)])


def _pairs(
    cloths: Sequence[Cloth], starts: NDArray[np.int64], seams: Sequence[Seam]
) -> NDArray[np.int64]:
    """Pairs of particles to merge, numbered over all cloths, [K, 2]."""
    pairs = [np.zeros((0, 2), np.int64)]
    for place, seam in enumerate(seams):
        sides = []
        for cloth, particles in ((seam.first, seam.first_particles), (seam[2], seam[3])):
            if not 0 <= cloth < len(cloths):
                raise OptionError(f"seam {place} names cloth {cloth}; use 0 to {len(cloths) - 1}")
            chosen, last = np.asarray(particles), len(cloths[cloth].inv_mass) - 1
            if chosen.size and (chosen.min() < 0 or chosen.max() > last):
                raise OptionError(f"seam {place} names particles outside 0 to {last}")
            sides.append(chosen + starts[cloth])
        if len(sides[0]) != len(sides[1]):
            raise OptionError(
                f"seam {place} joins {len(sides[0])} to {counted(len(sides[1]), 'particle')}"
            )
        pairs.append(np.stack(sides, axis=1))
    return np.concatenate(pairs)


def _merged(count: int, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
    """New numbers of `count` particles after merging pairs, in the order of first occurrence."""
    first_number = np.arange(count)
    while True:
        before = first_number.copy()
        for a, b in (pairs.T, pairs.T[::-1]):
            np.minimum.at(first_number, b, first_number[a])
        first_number = first_number[first_number]
        if np.array_equal(before, first_number):
            return np.unique(first_number, return_inverse=True)[1].astype(np.int64)


def _sewn_masses(
    inv_mass: NDArray[np.floating], number: NDArray[np.int64], count: int
) -> NDArray[np.floating]:
    free = inv_mass > 0
    masses, pinned = np.zeros(count), np.zeros(count, bool)
    np.add.at(masses, number[free], 1 / inv_mass[free])
    pinned[number[~free]] = True
    return np.where(pinned, 0.0, 1 / np.where(pinned | (masses == 0), 1.0, masses))


def _sewn_springs(
    cloths: Sequence[Cloth], starts: NDArray[np.int64], number: NDArray[np.int64]
) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """Pairs in new numbers, and which of all springs they are."""
    pairs = number[
        np.concatenate(
            [cloth.spring_pairs + start for cloth, start in zip(cloths, starts, strict=False)]
        )
    ]
    ordered = np.sort(pairs, axis=1)
    _, first = np.unique(ordered, axis=0, return_index=True)
    kept = np.sort(first)
    kept = kept[pairs[kept, 0] != pairs[kept, 1]]
    return pairs[kept].astype(np.int32), kept


def _sewn_bending(
    cloths: Sequence[Cloth], starts: NDArray[np.int64], number: NDArray[np.int64]
) -> Bending:
    stiff = [cloth.bending for cloth in cloths if len(cloth.bending.stiffness)]
    times = sorted({bending.damping for bending in stiff})
    if len(times) > 1:
        raise OptionError(
            f"sewn cloths have damping of {times[0]:g} and {times[-1]:g} s; give all the same"
        )
    particles = [number[c.bending.particles + s] for c, s in zip(cloths, starts, strict=False)]
    return Bending(
        np.concatenate(particles).astype(np.int32),
        np.concatenate([cloth.bending.weights for cloth in cloths]),
        np.concatenate([cloth.bending.stiffness for cloth in cloths]),
        np.concatenate([cloth.bending.rest for cloth in cloths]),
        times[0] if times else 0.0,
    )


def _sewn_triangles(
    cloths: Sequence[Cloth], starts: NDArray[np.int64], number: NDArray[np.int64]
) -> NDArray[np.int32]:
    faces = np.concatenate(
        [cloth.triangles + start for cloth, start in zip(cloths, starts, strict=False)]
    )
    sewn: NDArray[np.int32] = number[faces].astype(np.int32)
    return sewn
