"""What is drawn, before it moves: stiff parts, panels of cloth, and their materials."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from drapery.arrays import Vectors
from drapery.mesh import Mesh
from drapery.render.camera import Camera
from drapery.render.light import GAME_LIGHT, Light
from drapery.style.piece import MaterialAt, Piece


@dataclass(frozen=True, eq=False)
class Part:
    """A stiff piece of a body.

    mesh: positions [m].
    material_at: its material at a time [s].
    name: in 3-D files, such as `banner/pole`.
    """

    mesh: Mesh
    material_at: MaterialAt
    name: str = ""


@dataclass(frozen=True)
class Solid:
    """An upright box that cloth cannot enter: low and high corner [m], infinite where it has no
    end, such as that of the ground."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]


def half_space(axis: int, end: float) -> Solid:
    """Everything below a coordinate [m]: the ground for axis 1, a wall for axis 2."""
    x, y, z = (end if axis == each else math.inf for each in range(3))
    return Solid((-math.inf, -math.inf, -math.inf), (x, y, z))


@dataclass(frozen=True, eq=False)
class Panel:
    """A rectangle of cloth. In its own frame its top edge runs along x through the origin.

    piece: how it is drawn, a whole grid; its name is that in 3-D files, such as `banner/cloth`.
    origin: place of the middle of its top edge [m], shape [3].
    pins: which particles are pinned.
    board: its stiff shape in the game, in its place, at a phase 0..1 of its sway.
    sway: the period of that sway [s]; None where it does not move in the game.
    fullness: how much wider its cloth is than its top edge, on which it is gathered.
    """

    piece: Piece
    origin: Vectors
    pins: Literal["top", "corners"]
    board: Callable[[float], Mesh]
    sway: float | None
    fullness: float = 0.0


@dataclass(frozen=True, eq=False)
class Body:
    """One thing that is drawn: stiff parts and panels of cloth.

    parts: the stiff parts.
    panels: the cloth.
    period: of its animated textures [s]; 0 if they are still.
    light: the light on it.
    camera: its own; None if a named view frames it.
    ground: the block below it or the wall behind it.
    solids: what its cloth cannot enter.
    """

    parts: tuple[Part, ...] = ()
    panels: tuple[Panel, ...] = ()
    period: float = 0.0
    light: Light = GAME_LIGHT
    camera: Camera | None = None
    ground: tuple[Part, ...] = ()
    solids: tuple[Solid, ...] = ()
