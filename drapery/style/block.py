"""The banner block as the game builds it: pole, bar, flag, and the game's own stiff sway.

Model units are 1/16 block with y down and z towards the back; the transform of the block turns
them upright and scales them by 2/3.
"""

from functools import cache
from typing import Literal

import numpy as np

from drapery.elementary import cos, sin, sine_of_turns
from drapery.mesh import Array, Mesh
from drapery.style.board import moved, stiff_board, tilted
from drapery.style.boxes import ModelBox, box_mesh, join, upright
from drapery.style.cloth_spec import Solid, half_space
from drapery.style.uv_mapping import box_mapping

Placement = Literal["standing", "wall"]

SCALE = 2.0 / 3.0 / 16.0
"""Metres per model unit (and per texel of the flag)."""

FLAG_SIZE = (20 * SCALE, 40 * SCALE)
"""Width and height of the flag [m]."""

FLAG_MAPPING = box_mapping((0, 0), (20, 40, 1))
"""Where the sides of a flag lie on its texture, as the game's model has them."""

SWAY_PERIOD = 5.0
"""The game's own sway repeats after this time [s]: 100 ticks of 1/20 s."""


_WOOD: dict[Placement, tuple[ModelBox, ...]] = {
    "standing": (
        ModelBox((-1, -42, -1), (2, 42, 2), (44, 0)),
        ModelBox((-10, -44, -1), (20, 2, 2), (0, 42)),
    ),
    "wall": (ModelBox((-10, -20.5, 9.5), (20, 2, 2), (0, 42)),),
}
_FLAG_PIVOT: dict[Placement, tuple[float, float, float]] = {
    "standing": (0, -44, 0),
    "wall": (0, -20.5, 10.5),
}
_FLAG_MIDDLE = -1.5
"""z of the flag's middle sheet relative to its pivot [model units]."""
_ORIGIN = (0.5, 0.0, 0.5)
"""The model's origin in the block [m]."""


def to_world(points: Array) -> Array:
    """Model units [..., 3] -> metres in the block's own space, whose floor is 0..1 x 0..1."""
    placed: Array = points * np.array([SCALE, -SCALE, -SCALE]) + np.array(_ORIGIN)
    return placed


def turn(mesh: Mesh, degrees: float) -> Mesh:
    """The mesh turned about the upright axis through the block's middle, (0.5, y, 0.5) [m].

    mesh: positions and normals, each [..., V, 3].
    degrees: clockwise as seen from above, so +z (south) turns towards -x (west), as the game's
        rotations and facings do.
    """
    matrix = turn_matrix(degrees)
    centre = turn_centre()
    # einsum adds in a fixed order; BLAS may not.
    positions = np.einsum("ij,...j->...i", matrix, mesh.positions - centre) + centre
    return Mesh(
        positions, np.einsum("ij,...j->...i", matrix, mesh.normals), mesh.triangles, mesh.uvs
    )


def turn_matrix(degrees: float) -> Array:
    """The rotation of `turn`, shape [3, 3]."""
    angle = np.radians(-degrees)
    cosine, sine = cos(angle), sin(angle)
    return np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])


def turn_centre() -> Array:
    """The point about which `turn` turns [m], shape [3]."""
    return np.array(_ORIGIN)


def flag_origin(placement: Placement) -> Array:
    """Middle of the flag's top edge, on its middle sheet [m], shape [3]."""
    x, y, z = _FLAG_PIVOT[placement]
    return to_world(np.array([x, y, z + _FLAG_MIDDLE]))


@cache
def wood(placement: Placement) -> Mesh:
    """Pole and bar, textured by `banner_base`: one object, which renderers recognise."""
    return upright(join([box_mesh(box) for box in _WOOD[placement]]), SCALE, _ORIGIN)


@cache
def solids(placement: Placement) -> tuple[Solid, ...]:
    """What a flag cannot enter: pole, bar, wall and ground.

    A flag on a wall hangs below its own block, over the wall and the ground of the block below.
    """
    wood = [Solid(*box.bounds(SCALE, _ORIGIN)) for box in _WOOD[placement]]
    if placement == "standing":
        return *wood, half_space(1, 0.0)
    return *wood, half_space(2, 0.0), half_space(1, -1.0)


def stiff_flag(placement: Placement, phase: float, thickness: float = 1.0) -> Mesh:
    """The game's own flag, a stiff board, at a phase 0..1 of its sway. thickness: in texels.

    The flag's top edge is at (0, 0, 0); the pivot is 1.5 model units behind it. The x axis of the
    model is the world's, and y and z are both reversed, so the angle keeps its sign.
    """
    flag = stiff_board(FLAG_SIZE, thickness * SCALE, FLAG_MAPPING)
    before_pivot = moved(flag, np.array([0.0, 0.0, -_FLAG_MIDDLE * SCALE]))
    pivot = to_world(np.array(_FLAG_PIVOT[placement], np.float64))
    return moved(tilted(before_pivot, sway_angle(phase)), pivot)


def sway_angle(phase: float) -> float:
    """The flag's rotation about the model's x axis at its top edge [radians]."""
    return float((-0.0125 + 0.01 * sine_of_turns(phase + 0.25)) * np.pi)
