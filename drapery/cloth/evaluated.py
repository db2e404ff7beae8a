"""What forces do to cloths at one moment, for solvers of one's own."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from drapery.arrays import Vectors
from drapery.cloth.cloth import Cloth
from drapery.cloth.forces import Force, lower_forces
from drapery.cloth.lanes import from_lanes
from drapery.cloth.solvers.base import check_state
from drapery.cloth.solvers.driver import (
    SolverState,
    add_winds,
    batch_of,
    blow,
    body_of,
    cast_all,
    fall,
)
from drapery.cloth.state import State
from drapery.mesh import Array

WORK_ROWS = 18
"""The rows of scratch that a wind needs, see `kernels.blow`."""


def accelerations(forces: Sequence[Force], cloth: Cloth, state: State) -> Vectors:
    """The acceleration of each particle by all forces at the time of a state [m/s²], [B, N, 3].

    These are gravity, drag (with the drag of the cloth's fabric), winds and forces of your own;
    springs and bending are a solver's. Pinned particles have 0. A wind depends on the velocity of
    the cloth; built-in solvers sample it once a step.

    forces: as of `simulate`.
    cloth: the cloth on which they act.
    state: of B cloths; its numbers are float32 or float64, and so is the result.

    Raises OptionError for a force that gives a wrong value.
    """
    check_state(cloth, state)
    loads = lower_forces(forces, cloth, len(state.positions))
    batch = batch_of(cloth, state, SolverState(None, 1.0, 1, _no_kernel), loads, 1, None, 1, None)
    # The kernels damp implicitly, by a step.
    batch.numbers[1] = 0.0
    dtype, lanes = batch.x.dtype, batch.x.shape[1]
    body = cast_all(body_of(cloth), dtype)
    rows = 3 * body.controls.size + 2 * batch.gusts.rates.shape[1]
    wind = np.zeros((rows * batch.gusts.seeds.size, lanes), dtype)
    work = np.zeros((WORK_ROWS, lanes), dtype)
    gained = np.zeros_like(batch.x)
    blow(wind, batch.x, body.controls, batch.gusts, 0, state.time, work)
    add_winds(gained, batch.x, batch.v, body, wind, batch.gusts, dtype.type(1))
    fall(gained, body.inv_mass, batch.numbers, batch.push, dtype.type(1), 0)
    free = (cloth.inv_mass > 0)[:, None]
    moved: Array = from_lanes(gained, len(state.positions)) - loads.drag * free * state.velocities
    return moved.astype(dtype)


def _no_kernel(*_: Any) -> None:
    raise AssertionError("forces alone step no cloth")
