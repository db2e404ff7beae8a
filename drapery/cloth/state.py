"""The moving part of B cloths that share one topology."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import DTypeLike

from drapery.arrays import Vectors
from drapery.cloth.checks import check_count
from drapery.cloth.cloth import Cloth
from drapery.errors import OptionError, shown

MAX_CLOTHS = 100_000_000


@dataclass(frozen=True)
class WorstStrain:
    """The moment at which a structural spring was longest over its limit.

    over: by how much, as a part of the limit.
    time: the end of the step [s].
    cloth: the number of the cloth.
    particles: the ends of the spring.
    place: of its middle then [m].
    """

    over: float
    time: float
    cloth: int
    particles: tuple[int, int]
    place: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class State:
    """Positions and velocities of B cloths at one time.

    positions: [m], shape [B, N, 3].
    velocities: [m/s], shape [B, N, 3].
    time: [s].
    worst: the structural spring that was longest over its limit in all steps that led here, and
        when; None where all springs were held.
    """

    positions: Vectors
    velocities: Vectors
    time: float = 0.0
    worst: WorstStrain | None = None

    @property
    def strain(self) -> float:
        """How far a spring was over its limit, as a part of that limit; 0 where all were held."""
        return 0.0 if self.worst is None else self.worst.over


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
