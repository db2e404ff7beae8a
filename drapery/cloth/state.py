"""The moving part of B cloths that share one topology."""

from dataclasses import dataclass

from drapery.mesh import Array


@dataclass(frozen=True, eq=False)
class State:
    """Where B cloths are and how they move.

    positions: [m], shape [B, N, 3].
    velocities: [m/s], shape [B, N, 3].
    time: [s].
    """

    positions: Array
    velocities: Array
    time: float = 0.0
