"""The constant part of a cloth: rest shape, masses, springs, faces."""

from dataclasses import dataclass

import numpy as np

from drapery.arrays import Bytes, Floats, Pairs, Triangles, UVs, Vectors
from drapery.cloth.bending import NO_BENDING, Bending
from drapery.cloth.checks import check_number
from drapery.cloth.fabric import MAX_DRAG
from drapery.errors import OptionError

STRUCTURAL = 0
"""The kind of springs between neighbours (Provot 1995, section 3)."""
SHEAR = 1
"""The kind of springs across a cell."""
FLEXION = 2
"""The kind of springs over two cells, which resist bending."""

MAX_SPRING = 1e9
"""The greatest length [m] and stiffness [N/m] of a spring; single precision cannot hold more."""


@dataclass(frozen=True, eq=False)
class Cloth:
    """The constant data of a mass-spring cloth; `State` has the data that change.

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
    drag: rate at which still air slows the cloth [1/s]; see `Fabric`.
    bending: the stencils that resist bending; none by default.

    Raises OptionError for arrays of wrong shape and values out of range.
    """

    rest_positions: Vectors
    inv_mass: Floats
    spring_pairs: Pairs
    spring_length: Floats
    spring_stiffness: Floats
    spring_kind: Bytes
    triangles: Triangles
    uvs: UVs
    grid_shape: tuple[int, int] | None = None
    drag: float = 0.0
    bending: Bending = NO_BENDING

    def __post_init__(self) -> None:
        _check_particles(self)
        _check_springs(self)
        groups = {"triangles": self.triangles, "spring_pairs": self.spring_pairs}
        for name, numbers in {**groups, "bending particles": self.bending.particles}.items():
            if numbers.size and not (numbers.min() >= 0 and numbers.max() < len(self.inv_mass)):
                last = len(self.inv_mass) - 1
                raise OptionError(f"cloth {name} name particles outside 0 to {last}")
        if self.grid_shape is not None and np.prod(self.grid_shape) != len(self.inv_mass):
            raise OptionError(f"cloth grid_shape {self.grid_shape} does not fit its particles")
        check_number("cloth drag", self.drag, 0, MAX_DRAG, "1/s")


def _check_particles(cloth: Cloth) -> None:
    count = len(cloth.inv_mass)
    shapes = {"rest_positions": (count, 3), "inv_mass": (count,), "uvs": (count, 2)}
    for name, shape in shapes.items():
        values = getattr(cloth, name)
        if values.shape != shape:
            raise OptionError(f"cloth {name} have shape {values.shape}; use {shape}")
        if not np.isfinite(values).all():
            raise OptionError(f"cloth {name} hold NaN or infinity; give finite numbers")
    if count == 0 or (cloth.inv_mass < 0).any():
        raise OptionError("cloth inv_mass must be 0 (pinned) or more, for at least one particle")


def _check_springs(cloth: Cloth) -> None:
    count = len(cloth.spring_pairs)
    for name in ("spring_length", "spring_stiffness", "spring_kind"):
        values = getattr(cloth, name)
        if values.shape != (count,):
            raise OptionError(f"cloth {name} have shape {values.shape}; use {(count,)}")
    for name, unit in (("spring_length", "m"), ("spring_stiffness", "N/m")):
        values = getattr(cloth, name)
        wrong = np.flatnonzero(~((values > 0) & (values <= MAX_SPRING)))
        if name == "spring_stiffness":
            wrong = wrong[values[wrong] != 0]
        if wrong.size:
            spring = int(wrong[0])
            a, b = cloth.spring_pairs[spring]
            raise OptionError(
                f"cloth {name} of spring {spring} ({a} to {b}) is {values[spring]:g} {unit}; "
                f"use a number over 0 and up to {MAX_SPRING:g}"
            )
