"""How a rectangle of cloth is made: its particles, fabric and pins, and what it meets.

In its own frame its top edge runs along x through the origin.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from drapery.arrays import Vectors
from drapery.cloth import (
    FABRICS,
    Box,
    Cloth,
    Collider,
    Collisions,
    Fabric,
    MovingCloth,
    Solver,
    Wind,
    grid,
)
from drapery.cloth.gathering import fold_count, gathered_state
from drapery.cloth.pins import PinName
from drapery.cloth.solvers.registry import solver
from drapery.settings import Settings
from drapery.style.piece import Piece

ENDLESS = 1e3
"""A solid without an end is a box up to this coordinate [m]."""
THINNEST = 0.1
"""Thinner cloth keeps the distance of this thickness from solids [texels]."""
STRONG_WIND, CELLS = 8.0, 5
"""A fabric with bending is at least so stiff that a wind of this speed [m/s] drives no folds
shorter than this number of cells of the grid; but none is made stiffer than wool."""
MAX_KEPT = 4096
"""The most particles of a cloth at rest that is kept."""


@dataclass(frozen=True)
class Solid:
    """An upright box that cloth cannot enter: low and high corner [m], infinite where it has no
    end, as the ground has none."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]

    def seen_from(self, origin: Vectors) -> "Solid":
        """The same box in a frame with another origin [m], shape [3]."""
        return Solid(_less(self.low, origin), _less(self.high, origin))


def half_space(axis: int, end: float) -> Solid:
    """Everything below a coordinate [m]: the ground for axis 1, a wall for axis 2."""
    x, y, z = (end if axis == each else math.inf for each in range(3))
    return Solid((-math.inf, -math.inf, -math.inf), (x, y, z))


@dataclass(frozen=True)
class ClothSpec:
    """How a rectangle of cloth is made. Equal specs make equal cloths.

    shape: particles across and down.
    size: width and height [m].
    pins: which particles are pinned.
    solver: its name, or a Solver.
    fabric: its name, or a Fabric; None is the default of `grid`.
    solids: what it cannot enter, in its own frame.
    itself: whether it also meets itself.
    thickness: of the cloth [m].
    fullness: how much wider the cloth is than its top edge, on which it is gathered; only if it is
        pinned along the top, on a grid that is fine enough for folds.
    """

    shape: tuple[int, int]
    size: tuple[float, float]
    pins: PinName
    solver: str | Solver
    fabric: str | Fabric | None = None
    solids: tuple[Solid, ...] = ()
    itself: bool = False
    thickness: float = 0.0
    fullness: float = 0.0

    def make_cloth(self) -> Cloth:
        """The cloth at rest, which is flat.

        Raises OptionError.
        """
        width, height = self.size
        fabric = FABRICS[self.fabric] if isinstance(self.fabric, str) else self.fabric or Fabric()
        fabric = shown_fabric(fabric, height / (self.shape[1] - 1))
        if self.pins == "top" and fold_count(self.shape[0]):
            width *= 1 + self.fullness
        return grid(*self.shape, width, height, pins=self.pins, fabric=fabric)

    def make_collisions(self) -> Collisions | None:
        """What the cloth meets; None if that is nothing."""
        if not self.solids and not self.itself:
            return None
        boxes = []
        for solid in self.solids:
            low, high = (np.clip(corner, -ENDLESS, ENDLESS) for corner in (solid.low, solid.high))
            boxes.append(Collider(Box((low + high) / 2, high - low)))
        return Collisions(boxes, self.thickness, apart=self.thickness if self.itself else None)


def shown_fabric(fabric: Fabric, cell: float) -> Fabric:
    """The fabric, stiff enough that a grid shows its folds.

    Pressure that follows the slope of the cloth drives waves of every length, but the bending
    rigidity B stops those shorter than 2π (B / (p U))^(1/3), where p is the pressure of a `Wind` at
    1 m/s and U its speed. Those of a light fabric would be smaller than the cells, and crumple.
    A fabric without bending stays as it is.

    cell: the side of a cell [m].
    """
    wave = CELLS * cell / (2 * math.pi)
    least = min(Wind.pressure * STRONG_WIND * wave**3, FABRICS["wool"].bending)
    return replace(fabric, bending=least) if 0 < fabric.bending < least else fabric


def cloth_at_rest(spec: ClothSpec, step: float) -> MovingCloth:
    """The cloth at time 0, as it hangs before its first time step.

    For equal specs it is made once: pictures that differ in their wind begin with the same cloth.

    spec: how the cloth is made.
    step: the time step [s].

    Raises OptionError for a cloth or solver that cannot be made.
    """
    # A solver that is given as an object may remember something of its cloth.
    kept = isinstance(spec.solver, str) and math.prod(spec.shape) <= MAX_KEPT
    return (_kept_at_rest if kept else _at_rest)(spec, step)


def _at_rest(spec: ClothSpec, step: float) -> MovingCloth:
    cloth = spec.make_cloth()
    start = gathered_state(cloth, spec.size[0])
    method = solver(spec.solver) if isinstance(spec.solver, str) else spec.solver
    return MovingCloth.begin(cloth, method, step, start=start, collisions=spec.make_collisions())


_kept_at_rest = lru_cache(maxsize=16)(_at_rest)


def hanging_cloth(
    settings: Settings,
    piece: Piece,
    origin: Vectors,
    solids: Sequence[Solid],
    fullness: float = 0.0,
) -> ClothSpec:
    """How the settings make a rectangle of cloth that hangs from its top edge.

    settings: the options of the picture.
    piece: how it is drawn, a whole grid.
    origin: place of the middle of its top edge [m], shape [3].
    solids: what it cannot enter.
    fullness: see `ClothSpec`.
    """
    met = solids if settings.contact != "none" else ()
    return ClothSpec(
        settings.grid,
        piece.size,
        settings.pins or "top",
        settings.solver,
        settings.fabric,
        tuple(solid.seen_from(origin) for solid in met),
        settings.contact == "all",
        max(piece.thickness, THINNEST * piece.texel),
        fullness,
    )


def _less(corner: tuple[float, float, float], origin: Vectors) -> tuple[float, float, float]:
    x, y, z = (a - float(b) for a, b in zip(corner, origin, strict=True))
    return x, y, z
