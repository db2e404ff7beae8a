"""Cameras and their matrices. Right-handed, y up; a camera looks along its own -z."""

import math
from dataclasses import dataclass

import numpy as np

from drapery.arrays import Matrices
from drapery.errors import OptionError
from drapery.render.vectors import cross, dots

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Camera:
    """A camera.

    position: place of the camera [m].
    target: the point that it looks at [m], another than `position`.
    up: the direction that is up in the picture, not parallel to the line of sight.
    fov: vertical field of view [degrees]; used where `height` is None.
    height: vertical extent of an orthographic picture [m]; None for perspective.
    near: distance of the near clipping plane [m].
    far: distance of the far clipping plane [m].
    """

    position: Vector
    target: Vector
    up: Vector = (0.0, 1.0, 0.0)
    fov: float = 40.0
    height: float | None = None
    near: float = 0.05
    far: float = 200.0


def view_matrix(camera: Camera) -> Matrices:
    """World to eye space, shape [4, 4]; not finite for a camera that spans no view."""
    rows = _axes(camera)
    matrix = np.eye(4)
    matrix[:3, :3] = rows
    matrix[:3, 3] = -dots(rows, np.asarray(camera.position, np.float64))
    return matrix


def camera_pose(camera: Camera) -> Matrices:
    """Eye to world space, shape [4, 4]; the inverse of `view_matrix`."""
    matrix = np.eye(4)
    matrix[:3, :3] = _axes(camera).T
    matrix[:3, 3] = camera.position
    return matrix


def _axes(camera: Camera) -> Matrices:
    """Unit vectors to the right, to the top and towards the viewer, shape [3, 3]."""
    back = np.subtract(camera.position, camera.target).astype(np.float64)
    back /= np.sqrt(dots(back, back))
    right = cross(np.asarray(camera.up), back)
    right /= np.sqrt(dots(right, right))
    return np.stack([right, cross(back, right), back])


def projection_matrix(camera: Camera, aspect: float) -> Matrices:
    """Eye space to OpenGL clip space (z in -w..w), shape [4, 4].

    camera: the camera of the picture.
    aspect: width / height of the picture.
    """
    near, far = camera.near, camera.far
    matrix = np.zeros((4, 4))
    if camera.height is None:
        scale = 1.0 / math.tan(math.radians(camera.fov) / 2.0)
        matrix[2, 2], matrix[2, 3], matrix[3, 2] = (
            (far + near) / (near - far),
            2.0 * far * near / (near - far),
            -1.0,
        )
    else:
        scale = 2.0 / camera.height
        matrix[2, 2], matrix[2, 3], matrix[3, 3] = (
            2.0 / (near - far),
            (far + near) / (near - far),
            1.0,
        )
    matrix[0, 0], matrix[1, 1] = scale / aspect, scale
    return matrix


def clip_matrix(camera: Camera, size: tuple[int, int]) -> Matrices:
    """World to clip space, shape [4, 4]. Its products are summed in a fixed order.

    camera: the camera of the picture.
    size: width and height of the picture [pixels].

    Raises OptionError for a camera that spans no view.
    """
    eye, lens = view_matrix(camera), projection_matrix(camera, size[0] / size[1])
    matrix = np.asarray(sum(lens[:, k, None] * eye[k] for k in range(4)))
    if not np.isfinite(matrix).all():
        raise OptionError(
            "the camera's position, target and up must span a view; use a target other than its"
            " position, and an up that is not parallel to the line of sight"
        )
    return matrix
