"""A small cloth of dots in the plane, in pixels: no dot may be far from its neighbours.

The way of Slow Rush Studios' capes: Verlet steps, then a few passes over all pairs that have come
too far apart. Nothing keeps dots apart, so such a cloth can crumple to a line; the tweaks are what
keeps it from that, and from snapping about. x to the right, y down, as in a picture.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array

STEP = 1 / 60
"""[s]"""
GRAVITY = 260.0
"""[pixels/s²]: a dot falls as a figure of twenty pixels' height would."""
PLAIN_DAMPING, AIR_DAMPING = 0.995, 0.93
"""What is left of a dot's velocity after a step, without and with air resistance."""
TURN_DAMPING = 0.25
"""The part of the cape's turning about its top that is taken away in a step."""
PUSH = 5.0
"""Acceleration against the wearer's motion [1/s], so much for its speed."""


@dataclass(frozen=True)
class CapeTweaks:
    """What is done beyond the plain method.

    air: air resistance. turning: damped angular momentum. push: a push opposite to the wearer's
    motion. hooks: attachment points that move with the wearer's animation.
    """

    air: bool = True
    turning: bool = True
    push: bool = True
    hooks: bool = True


@dataclass(frozen=True)
class DotCloth:
    """The constant part. pairs: neighbours, shape [C, 2]; reach: how far they may be apart
    [pixels], shape [C]; pinned: dots that only the wearer moves, shape [P]."""

    shape: tuple[int, int]
    pairs: NDArray[np.int32]
    reach: Array
    pinned: NDArray[np.int32]


def dot_grid(columns: int, rows: int, across: float, down: float) -> DotCloth:
    """A cape of dots, its top row pinned; across, down: distances of neighbours [pixels]."""
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    sides = np.stack([index[:, :-1].ravel(), index[:, 1:].ravel()], axis=1)
    uprights = np.stack([index[:-1].ravel(), index[1:].ravel()], axis=1)
    reach = np.repeat([across, down], [len(sides), len(uprights)])
    return DotCloth((rows, columns), np.concatenate([sides, uprights]), reach, index[0])


def step(
    dots: DotCloth,
    now: Array,
    before: Array,
    hooks: Array,
    velocity: Array,
    tweaks: CapeTweaks,
    passes: int,
) -> Array:
    """Places [N, 2] one step later, from those now and a step before.

    hooks: where the pinned dots are then, [P, 2]; velocity: the wearer's [pixels/s], [2].
    """
    motion = (now - before) * (AIR_DAMPING if tweaks.air else PLAIN_DAMPING)
    if tweaks.turning:
        motion = motion - TURN_DAMPING * _turning(now - now[dots.pinned].mean(axis=0), motion)
    pull = np.array([0.0, GRAVITY]) - (PUSH * velocity if tweaks.push else 0.0)
    later = now + motion + pull * STEP**2
    later[dots.pinned] = hooks
    for _ in range(passes):
        _draw_near(dots, later)
    return later


def _turning(arms: Array, motion: Array) -> Array:
    """The part of a motion [N, 2] that is one turn about the origin of the arms [N, 2]."""
    across = np.stack([-arms[:, 1], arms[:, 0]], axis=1)
    angle = (across * motion).sum() / max(float((arms * arms).sum()), 1e-9)
    turn: Array = angle * across
    return turn


def _draw_near(dots: DotCloth, places: Array) -> None:
    """One pass: each pair that is too far apart, one after another, moves together again."""
    fixed = set(dots.pinned.tolist())
    for (i, j), reach in zip(dots.pairs.tolist(), dots.reach.tolist(), strict=True):
        apart = places[j] - places[i]
        length = float(np.sqrt(apart[0] * apart[0] + apart[1] * apart[1]))
        if length <= reach or (i in fixed and j in fixed):
            continue
        share = apart * ((length - reach) / length)
        half = 1.0 if i in fixed or j in fixed else 0.5
        if i not in fixed:
            places[i] += half * share
        if j not in fixed:
            places[j] -= half * share
