"""The constant part of a cloth: rest shape, masses, springs, faces."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array, Triangles

STRUCTURAL, SHEAR, FLEXION = 0, 1, 2
"""The kinds of spring: between neighbours, across a cell, and over two cells (Provot 1995)."""


@dataclass(frozen=True, eq=False)
class Cloth:
    """A mass-spring cloth; nothing in it changes while it moves.

    rest_positions: [m], shape [N, 3].
    inv_mass: inverse masses [1/kg], shape [N]; 0 is pinned.
    spring_pairs: particle indices, shape [S, 2], int32.
    spring_length: rest lengths [m], shape [S].
    spring_stiffness: [N/m], shape [S].
    spring_kind: STRUCTURAL, SHEAR or FLEXION, shape [S], uint8.
    triangles: particle indices of the faces, shape [T, 3], int32.
    uvs: texture coordinates, shape [N, 2]; (0, 0) is the top left corner.
    grid_shape: (rows, columns) where the particles are a regular grid, rows from the top,
        particle index = row * columns + column; None for any other topology.
    """

    rest_positions: Array
    inv_mass: Array
    spring_pairs: NDArray[np.int32]
    spring_length: Array
    spring_stiffness: Array
    spring_kind: NDArray[np.uint8]
    triangles: Triangles
    uvs: Array
    grid_shape: tuple[int, int] | None = None
