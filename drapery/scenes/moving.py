"""The motion of cloth in the ready-made scenes: its state at each frame of a clip."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np

from drapery.cloth import Cloth, Force, Gravity, PinPath, Solver, State, rest_state, simulate
from drapery.cloth.collisions import Collisions
from drapery.mesh import Array
from drapery.scenes.catalogue import Clip

STEP = 1.0 / 120.0
"""The longest time step [s], short enough for cloth that touches walking legs."""


def motion(
    cloth: Cloth,
    clip: Clip,
    *,
    solver: Solver | None = None,
    forces: Sequence[Force] = (Gravity(),),
    collisions: Collisions | None = None,
    pins: PinPath | None = None,
    start: State | None = None,
    settle: float = 0.0,
    step: float = STEP,
) -> Iterator[State]:
    """The state at each frame of the clip; see `simulate`.

    start: the rest shape unless given. settle: time before the first frame [s], rounded to whole
    frames. step: the longest time step [s].
    """
    steps = steps_per_frame(clip, step)
    states = simulate(
        cloth,
        solver,
        forces,
        1 / (clip.fps * steps),
        start=start or rest_state(cloth, dtype=np.float64),
        every=steps,
        pins=pins,
        collisions=collisions,
    )
    first = round(settle * clip.fps)
    return islice(states, first, first + clip.count)


def steps_per_frame(clip: Clip, step: float = STEP) -> int:
    """How many time steps a frame of the clip takes; step: the longest one [s]."""
    return max(1, math.ceil(1 / (clip.fps * step) - 1e-9))


def placed(cloth: Cloth, position: Array, rotation: Array | None = None) -> Cloth:
    """The cloth with another rest shape: rotation · x + position for each particle x [m]."""
    turn = np.eye(3) if rotation is None else rotation
    # einsum adds in a fixed order; BLAS may not.
    turned = np.einsum("ij,nj->ni", turn, cloth.rest_positions)
    return replace(cloth, rest_positions=turned + np.asarray(position, float))
