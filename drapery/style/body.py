"""What is drawn, before it moves: stiff parts, panels of cloth, and their materials."""

from collections.abc import Callable
from dataclasses import dataclass

from drapery.arrays import Vectors
from drapery.mesh import Mesh
from drapery.render.camera import Camera
from drapery.render.light import GAME_LIGHT, Light
from drapery.style.cloth_spec import ClothSpec
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


@dataclass(frozen=True, eq=False)
class Panel:
    """A rectangle of cloth in its place.

    cloth: how it is made.
    piece: how it is drawn, a whole grid; its name is that in 3-D files, such as `banner/cloth`.
    origin: place of the middle of its top edge [m], shape [3].
    board: its stiff shape in the game, in its place, at a phase 0..1 of its sway.
    sway: the period of that sway [s]; None where it does not move in the game.
    """

    cloth: ClothSpec
    piece: Piece
    origin: Vectors
    board: Callable[[float], Mesh]
    sway: float | None = None


@dataclass(frozen=True, eq=False)
class Body:
    """One thing that is drawn: stiff parts and panels of cloth.

    parts: the stiff parts.
    panels: the cloth.
    period: of its animated textures [s]; 0 if they are still.
    light: the light on it.
    camera: its own; None if a named view frames it.
    ground: the block below it or the wall behind it.
    """

    parts: tuple[Part, ...] = ()
    panels: tuple[Panel, ...] = ()
    period: float = 0.0
    light: Light = GAME_LIGHT
    camera: Camera | None = None
    ground: tuple[Part, ...] = ()
