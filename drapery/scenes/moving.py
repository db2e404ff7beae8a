"""The motion of cloth in the ready-made scenes: its state at each frame of a clip."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from drapery.cloth import (
    Cloth,
    Collisions,
    Force,
    Gravity,
    MovingCloth,
    PinPath,
    Solver,
    State,
    Wind,
    rest_state,
)
from drapery.cloth.strain import warn_of_strain
from drapery.mesh import Array
from drapery.scenes.catalogue import Clip

LOOP = 4.0
"""The wind of the scenes repeats after this time [s], in which a walk makes a whole number of
strides and passes a whole number of blocks: a picture of it has no seam."""
ASIDE = (0.35, 0.0, 0.94)
"""Where it blows to: to the front and a little to the right."""
GRAVITY = (Gravity(),)
"""The forces of `motion` unless others are given."""
STEP = 1.0 / 120.0
"""The longest time step [s], short enough for cloth that touches walking legs."""


def motion(
    cloth: Cloth,
    clip: Clip,
    *,
    solver: Solver | None = None,
    forces: Sequence[Force] | Callable[[float], Sequence[Force]] = GRAVITY,
    collisions: Collisions | None = None,
    pins: PinPath | None = None,
    start: State | None = None,
    settle: float = 0.0,
    step: float = STEP,
) -> Iterator[State]:
    """The state at each frame of the clip; see `simulate`. Raises OptionError.

    forces: or a function that gives them at the time of each frame [s]. start: the rest shape
    unless given. settle: time before the first frame [s], rounded to whole frames.
    step: the longest time step [s].
    """
    steps = max(1, math.ceil(1 / (clip.fps * step) - 1e-9))
    start = start or rest_state(cloth, dtype=np.float64)
    dt, first = 1 / (clip.fps * steps), -round(settle * clip.fps)
    moving = MovingCloth.begin(cloth, solver, dt, start=start, collisions=collisions)
    for frame in range(first, clip.count):
        if frame > first:
            acting = forces((frame - 1) / clip.fps) if callable(forces) else forces
            moving = moving.unmet(acting, steps, pins)
        if frame == clip.count - 1:
            warn_of_strain(moving.state.worst)
        if frame >= 0:
            yield moving.state


def looped_wind(
    speed: float,
    seed: int,
    along: tuple[float, float, float] = ASIDE,
    *,
    gusts: float = 0.5,
    gust_size: float = Wind.gust_size,
) -> Wind:
    """A wind that repeats after LOOP.

    speed: its mean [m/s].
    seed, gusts, gust_size: as in `Wind`.
    along: where it blows to, a unit vector.
    Raises OptionError.
    """
    x, y, z = along
    velocity = (speed * x, speed * y, speed * z)
    return Wind(velocity, gusts=gusts, gust_size=gust_size, seed=seed, period=LOOP)


def placed(cloth: Cloth, position: Array, rotation: Array | None = None) -> Cloth:
    """The cloth with another rest shape: rotation · x + position for each particle x [m]."""
    turn = np.eye(3) if rotation is None else rotation
    # einsum adds in a fixed order; BLAS may not.
    turned = np.einsum("ij,nj->ni", turn, cloth.rest_positions)
    return replace(cloth, rest_positions=turned + np.asarray(position, float))
