"""A cloth in the plane and its wind, in the order of a tutorial's loops."""

from dataclasses import dataclass, replace

import numpy as np

from drapery.cloth import STRUCTURAL, Cloth, State, grid
from drapery.elementary import sine_of_turns
from drapery.mesh import Array


@dataclass(frozen=True)
class SineWind:
    """An acceleration along x that is a sine of the number of the step; the first is number 1.

    amplitude: [m/s²].
    turn: the phase of a step [radians].
    dt: the time step [s].
    """

    amplitude: float
    turn: float
    dt: float

    def acceleration(self, cloth: Cloth, state: State) -> Array:
        """The acceleration [m/s²], shape [N, 3]."""
        number = round(state.time / self.dt) + 1
        push = np.zeros_like(cloth.rest_positions)
        push[:, 0] = self.amplitude * sine_of_turns(self.turn * number / (2 * np.pi))
        return push


def plane_curtain(shape: tuple[int, int], spacing: float) -> Cloth:
    """A cloth whose top row is pinned; its lowest left particle is at (spacing, spacing, 0).

    Its springs are from the lowest row up, of each particle its right, then its upper.
    shape: particles across and down.
    spacing: distance of neighbours [m].
    """
    columns, rows = shape
    cloth = grid(columns, rows, (columns - 1) * spacing, (rows - 1) * spacing)
    number = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)[::-1]
    places = np.zeros((rows * columns, 3))
    places[number, 0] = np.arange(1, columns + 1) * spacing
    places[number, 1] = np.arange(1, rows + 1)[:, None] * spacing
    pairs = [
        (number[j, i], neighbour)
        for j in range(rows)
        for i in range(columns)
        for neighbour in (*number[j, i + 1 : i + 2], *number[j + 1 : j + 2, i])
    ]
    count = len(pairs)
    return replace(
        cloth,
        rest_positions=places,
        spring_pairs=np.array(pairs, np.int32),
        spring_length=np.full(count, spacing),
        spring_stiffness=np.ones(count),
        spring_kind=np.full(count, STRUCTURAL, np.uint8),
    )
