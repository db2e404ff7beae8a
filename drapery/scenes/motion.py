"""How cloth of any scene moves from frame to frame, with whatever it meets."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np

from drapery.cloth import Cloth, Force, Gravity, PinPath, Solver, SolverDesbrun, State, rest_state
from drapery.cloth.colliders import Collider, collide, probes
from drapery.mesh import Array
from drapery.scenes.catalogue import Shot

Forces = Sequence[Force] | Callable[[float], Sequence[Force]]
"""Forces, or those from a time on [s]."""
FALL = (Gravity(),)
STEP = 1.0 / 120.0
"""The longest time step [s]; cloth that meets walking legs wants a short one."""


def motion(
    cloth: Cloth,
    shot: Shot,
    *,
    solver: Solver | None = None,
    forces: Forces = FALL,
    colliders: Sequence[Collider] = (),
    radius: float = 0.0,
    pins: PinPath | None = None,
    start: State | None = None,
    settle: float = 0.0,
    step: float = STEP,
    order: int = 2,
) -> Iterator[State]:
    """The state at each frame of the shot.

    settle: time before the first frame [s], rounded to whole frames. step: the longest time step
    [s]. radius, order: of the cloth against colliders; see `collide` and `probes`.
    """
    steps = max(1, math.ceil(1 / (shot.fps * step) - 1e-9))
    states = _states(
        cloth,
        solver or SolverDesbrun(),
        forces,
        1 / (shot.fps * steps),
        tuple(colliders),
        radius,
        pins,
        start or rest_state(cloth, dtype=np.float64),
        order,
    )
    first = round(settle * shot.fps) * steps
    return islice(states, first, first + shot.count * steps, steps)


def _states(
    cloth: Cloth,
    solver: Solver,
    forces: Forces,
    dt: float,
    colliders: Sequence[Collider],
    radius: float,
    pins: PinPath | None,
    state: State,
    order: int,
) -> Iterator[State]:
    points = probes(cloth, order)
    memory = solver.init(cloth, dt)
    while True:
        yield state
        acting = forces(state.time) if callable(forces) else forces
        after, memory = solver.step(cloth, state, memory, acting, dt, pins=pins)
        if colliders:
            after = collide(cloth, state, after, colliders, points, radius=radius)
        state = after


def placed(cloth: Cloth, position: Array, rotation: Array | None = None) -> Cloth:
    """The cloth with its rest shape turned and put elsewhere: rotation · x + position [m]."""
    turn = np.eye(3) if rotation is None else rotation
    # einsum adds in a fixed order; BLAS may not.
    turned = np.einsum("ij,nj->ni", turn, cloth.rest_positions)
    return replace(cloth, rest_positions=turned + np.asarray(position, float))
