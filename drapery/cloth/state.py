"""The moving part of B cloths that share one topology."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import DTypeLike

from drapery.arrays import Vectors
from drapery.cloth.checks import check_count
from drapery.cloth.cloth import Cloth
from drapery.errors import OptionError, shown

MAX_CLOTHS = 100_000_000


@dataclass(frozen=True, eq=False)
class State:
    """Positions and velocities of B cloths at one time.

    positions: [m], shape [B, N, 3].
    velocities: [m/s], shape [B, N, 3].
    time: [s].
    strain: how far the longest structural spring was over its limit, as a part of that limit, in
        all steps that led here; 0 where all springs were held. See `drapery.cloth.strain`.
    """

    positions: Vectors
    velocities: Vectors
    time: float = 0.0
    strain: float = 0.0


def rest_state(cloth: Cloth, count: int = 1, dtype: DTypeLike = np.float32) -> State:
    """Cloths in their rest shape with velocity 0: a start for `simulate`.

    cloth: of what they are.
    count: number of cloths.
    dtype: of positions and velocities, float32 or float64; the simulation uses the same type.

    Raises OptionError for another count or type.
    """
    check_count("count", count, 1, MAX_CLOTHS)
    try:
        known = np.dtype(dtype) in (np.float32, np.float64)
    except TypeError:
        known = False
    if not known:
        raise OptionError(f"dtype {shown(dtype)} is not supported; use float32 or float64")
    # The batch is the innermost axis in memory, where the kernels want it; see `lanes`.
    lanes = np.empty((*cloth.rest_positions.shape, count), dtype)
    lanes[:] = cloth.rest_positions[..., None]
    positions = lanes.transpose(2, 0, 1)
    return State(positions, np.zeros_like(positions))
