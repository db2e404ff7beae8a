"""Boxes of the game's models: six rectangles with one unfolded texture.

Model units are texels; y points down and z to the back, as in the game's models.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from drapery.mesh import Array, Mesh
from drapery.style.uv_mapping import BoxMapping, box_mapping


@dataclass(frozen=True)
class ModelBox:
    """A box of a model; all lengths in texels.

    corner: its lowest x, y and z. size: along x, y and z. offset: upper left corner of its unfolded
    sides on the texture. grown: how far each side is moved outwards; the texture stays the same.
    """

    corner: tuple[float, float, float]
    size: tuple[float, float, float]
    offset: tuple[float, float]
    grown: float = 0.0

    def bounds(
        self, scale: float, origin: tuple[float, float, float]
    ) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Its low and high corner after `upright` [m]."""
        first = np.array(self.corner, np.float64) - self.grown
        last = first + np.array(self.size, np.float64) + 2 * self.grown
        corners = np.array([first, last]) * np.array([scale, -scale, -scale]) + np.array(origin)
        x0, y0, z0 = map(float, corners.min(axis=0))
        x1, y1, z1 = map(float, corners.max(axis=0))
        return (x0, y0, z0), (x1, y1, z1)


def box_mesh(box: ModelBox, sheet: tuple[float, float] = (64, 64)) -> Mesh:
    """The six faces of a box, each with its own four corners and normal, in model units.

    The normals and the order of the corners are already those after `upright`, which reverses y
    and z. sheet: width and height of the texture [texels].
    """
    uv_mapping = box_mapping(box.offset, box.size, sheet)
    faces = [_face(*side) for side in box_sides(uv_mapping)]
    unit = np.concatenate([corners for corners, _, _ in faces])
    corner = np.array(box.corner, np.float64) - box.grown
    return Mesh(
        corner + unit * (np.array(box.size, np.float64) + 2 * box.grown),
        np.concatenate([normals for _, normals, _ in faces]),
        _TRIANGLES.copy(),
        np.concatenate([uvs for _, _, uvs in faces]),
    )


def upright(mesh: Mesh, scale: float, origin: tuple[float, float, float]) -> Mesh:
    """A mesh of boxes in metres, y up. scale: [m/texel]. origin: of the model in the world [m]."""
    positions = mesh.positions * np.array([scale, -scale, -scale]) + np.array(origin)
    return Mesh(positions, mesh.normals, mesh.triangles, mesh.uvs)


def join(meshes: Sequence[Mesh]) -> Mesh:
    """Several meshes as one."""
    firsts = np.cumsum([0, *(len(m.uvs) for m in meshes[:-1])])
    return Mesh(
        np.concatenate([m.positions for m in meshes]),
        np.concatenate([m.normals for m in meshes]),
        np.concatenate([m.triangles + np.int32(f) for m, f in zip(meshes, firsts, strict=True)]),
        np.concatenate([m.uvs for m in meshes]),
    )


BOTTOM = 5
"""The number of the bottom among the sides of a box. Its corners go round the other way."""
_FACE = np.array([[0, 2, 1], [1, 2, 3]], np.int32)
"""The triangles of a side from its corners, see `_face`."""
_TRIANGLES = np.concatenate(
    [(_FACE[:, ::-1] if side == BOTTOM else _FACE) + np.int32(4 * side) for side in range(6)]
)
"""Those of all sides of a box."""

Side = tuple[
    tuple[float, float, float],
    tuple[int, int, int],
    tuple[int, int, int],
    tuple[float, float, float],
    tuple[float, float, float, float],
]
"""A side of a box, see `box_sides`."""


def box_sides(uv_mapping: BoxMapping) -> list[Side]:
    """(upper left corner, step right, step down, world normal, texture) of each face.

    In fractions of the box: x to the right, y down, z to the back, as in the model. The bottom is
    last; its texture is drawn as it is seen from above, through the box, as in the game.
    """
    return [
        ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), uv_mapping.front_rect),
        ((1, 0, 1), (-1, 0, 0), (0, 1, 0), (0, 0, -1), uv_mapping.back_rect),
        ((0, 0, 1), (0, 0, -1), (0, 1, 0), (-1, 0, 0), uv_mapping.left),
        ((1, 0, 0), (0, 0, 1), (0, 1, 0), (1, 0, 0), uv_mapping.right),
        ((0, 0, 1), (1, 0, 0), (0, 0, -1), (0, 1, 0), uv_mapping.top),
        ((0, 1, 1), (1, 0, 0), (0, 0, -1), (0, -1, 0), uv_mapping.bottom),
    ]


def _face(
    start: tuple[float, float, float],
    right: tuple[int, int, int],
    down: tuple[int, int, int],
    normal: tuple[float, float, float],
    rect: tuple[float, float, float, float],
) -> tuple[Array, Array, Array]:
    r, d = np.array(right), np.array(down)
    corners = np.array(start) + np.stack([0 * r, r, d, r + d])
    left, top, right_, bottom = rect
    uvs = np.array([[left, top], [right_, top], [left, bottom], [right_, bottom]])
    return corners, np.tile(np.array(normal, np.float64), (4, 1)), uvs
