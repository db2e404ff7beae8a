"""A small cloth of dots in the plane, in pixels, whose neighbours stay near each other.

The method of Slow Rush Studios' capes: Verlet steps, then a few passes over all pairs that are too
far apart. Nothing keeps dots apart, so such a cloth can crumple to a line; the tweaks prevent that,
and sudden turns. x points to the right and y down, as in a picture.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array

STEP = 1 / 60
"""The time step [s]."""
GRAVITY = 260.0
"""Acceleration downwards [pixels/s²], in proportion to a figure 20 pixels high."""
PLAIN_DAMPING, AIR_DAMPING = 0.995, 0.93
"""The share of a dot's velocity that a step keeps, without and with air resistance."""
TURN_DAMPING = 0.25
"""The share of the cape's rotation about its top that a step removes."""
PUSH = 5.0
"""Acceleration opposite to the wearer's motion, for each unit of its speed [1/s]."""


@dataclass(frozen=True)
class CapeTweaks:
    """Which additions to the plain method are on.

    air: air resistance. turning: damped angular momentum. push: a push opposite to the wearer's
    motion. hooks: attachment points that move with the wearer's animation.
    """

    air: bool = True
    turning: bool = True
    push: bool = True
    hooks: bool = True


@dataclass(frozen=True)
class DotCloth:
    """The constant part of such a cloth.

    shape: rows and columns. pairs: neighbours, shape [C, 2]. max_distance: how far apart they may
    be [pixels], shape [C]. pinned: dots that only the wearer moves, shape [P].
    """

    shape: tuple[int, int]
    pairs: NDArray[np.int32]
    max_distance: Array
    pinned: NDArray[np.int32]


def dot_grid(columns: int, rows: int, across: float, down: float) -> DotCloth:
    """A cape of dots, its top row pinned. across, down: distances of neighbours [pixels]."""
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    sides = np.stack([index[:, :-1].ravel(), index[:, 1:].ravel()], axis=1)
    uprights = np.stack([index[:-1].ravel(), index[1:].ravel()], axis=1)
    max_distance = np.repeat([across, down], [len(sides), len(uprights)])
    return DotCloth((rows, columns), np.concatenate([sides, uprights]), max_distance, index[0])


def step(
    dots: DotCloth,
    now: Array,
    before: Array,
    hooks: Array,
    velocity: Array,
    tweaks: CapeTweaks,
    passes: int,
) -> Array:
    """Places [pixels], shape [N, 2], one step later, from those now and a step before.

    hooks: places of the pinned dots after the step [pixels], shape [P, 2]. velocity: of the wearer
    [pixels/s], shape [2].
    """
    motion = (now - before) * (AIR_DAMPING if tweaks.air else PLAIN_DAMPING)
    if tweaks.turning:
        motion = motion - TURN_DAMPING * _turning(now - now[dots.pinned].mean(axis=0), motion)
    pull = np.array([0.0, GRAVITY]) - (PUSH * velocity if tweaks.push else 0.0)
    later = now + motion + pull * STEP**2
    later[dots.pinned] = hooks
    for _ in range(passes):
        _limit_distances(dots, later)
    return later


def _turning(arms: Array, motion: Array) -> Array:
    """The rotation in a motion [N, 2] about the origin of the arms [N, 2]."""
    across = np.stack([-arms[:, 1], arms[:, 0]], axis=1)
    angle = (across * motion).sum() / max(float((arms * arms).sum()), 1e-9)
    turn: Array = angle * across
    return turn


def _limit_distances(dots: DotCloth, places: Array) -> None:
    """One pass: each pair that is too far apart, one after another, moves to its limit."""
    fixed = set(dots.pinned.tolist())
    for (i, j), limit in zip(dots.pairs.tolist(), dots.max_distance.tolist(), strict=True):
        apart = places[j] - places[i]
        length = float(np.sqrt(apart[0] * apart[0] + apart[1] * apart[1]))
        if length <= limit or (i in fixed and j in fixed):
            continue
        share = apart * ((length - limit) / length)
        half = 1.0 if i in fixed or j in fixed else 0.5
        if i not in fixed:
            places[i] += half * share
        if j not in fixed:
            places[j] -= half * share
