"""An item in its slot of the inventory: the pose, the light and the camera."""

from dataclasses import dataclass

import numpy as np

from drapery.elementary import cos, sin
from drapery.mesh import Array, Mesh
from drapery.render.camera import Camera
from drapery.render.light import Light

Vector = tuple[float, float, float]

FULL_LIGHT = 252 / 255
"""The game's lightmap at full light, as its 8 bits hold it."""

SLOT_LIGHT = Light(
    ((-0.275, 0.212, 1.187), (-0.266, 1.202, 0.119)), 0.4, 0.6, (FULL_LIGHT, FULL_LIGHT, FULL_LIGHT)
)
"""One light from the front and one from above: the inventory's light of flat items."""


@dataclass(frozen=True)
class SlotPose:
    """The pose of an item's model in its slot.

    rotation: about x, y and z [degrees], z first. translation: [1/16 slot]. scale: slots per block.
    """

    rotation: Vector
    translation: Vector
    scale: float


BANNER_POSE = SlotPose((30, 20, 0), (0, -3.25, 0), 0.5325)
SHIELD_POSE = SlotPose((15, -25, -5), (2, 3, 0), 0.65)


def in_slot(mesh: Mesh, pose: SlotPose) -> Mesh:
    """A mesh in the space of its block, moved into the slot, which is -0.5..0.5 in x and y."""
    matrix = _matrix(pose.rotation)
    centred = (mesh.positions - 0.5) * pose.scale
    positions = np.einsum("ij,...j->...i", matrix, centred) + np.array(pose.translation) / 16
    normals = np.einsum("ij,...j->...i", matrix, mesh.normals)
    return Mesh(positions, normals, mesh.triangles, mesh.uvs)


def slot_camera(size: tuple[int, int]) -> Camera:
    """Straight at the slot, which fills the picture's shorter side."""
    width, height = size
    return Camera((0, 0, 3), (0, 0, 0), height=max(1.0, height / width))


def _matrix(rotation: Vector) -> Array:
    """Rotations about z, y and x, in that order, shape [3, 3]."""
    (a, b, c), (i, j, k) = cos(np.radians(rotation)), sin(np.radians(rotation))
    about_x = np.array([[1, 0, 0], [0, a, -i], [0, i, a]])
    about_y = np.array([[b, 0, j], [0, 1, 0], [-j, 0, b]])
    about_z = np.array([[c, -k, 0], [k, c, 0], [0, 0, 1]])
    matrix: Array = np.einsum("ij,jk,kl->il", about_x, about_y, about_z)
    return matrix
