"""Named views, and cameras that frame their subject."""

import math
from dataclasses import dataclass, replace

import numpy as np

from drapery.arrays import Vectors
from drapery.errors import OptionError
from drapery.mesh import Array
from drapery.render.camera import Camera, Vector
from drapery.render.vectors import cross, dots


@dataclass(frozen=True)
class View:
    """A direction of view.

    azimuth: degrees around the subject; 0 looks at its front (from +z), 90 from +x.
    elevation: degrees above the horizon.
    fov: vertical field of view [degrees]; None for a parallel projection.
    """

    azimuth: float
    elevation: float
    fov: float | None


VIEWS: dict[str, View] = {
    "front": View(0, 0, None),
    "back": View(180, 0, None),
    # Three equal angles between the axes: elevation atan(1 / sqrt 2).
    "iso": View(45, 35.26438968, None),
    # The game's item pose turns a banner by (30, 20, 0) degrees before a parallel camera.
    "gui": View(-20, 30, None),
    "hero": View(28, 8, 30),
}
"""The named views; `hero` has perspective, the others a parallel projection."""


def find_view(view: str | View) -> View:
    """The view of this name; a View is returned as it is.

    Raises OptionError.
    """
    if isinstance(view, View):
        return view
    if view not in VIEWS:
        raise OptionError(f"view {view!r} is not known; use one of: {', '.join(VIEWS)}")
    return VIEWS[view]


def frame_view(view: str | View, points: Vectors, aspect: float, margin: float = 0.05) -> Camera:
    """A camera in the direction of a view that shows all points.

    view: a View, or its name in VIEWS.
    points: [m], shape [..., 3]; for an animation those of all frames.
    aspect: width / height of the picture.
    margin: the free fraction at each side.

    Raises OptionError for a name that is not known and for points that are not finite.
    """
    return frame_points(find_view(view), points, aspect, margin)


def turntable(view: View, points: Vectors, aspect: float, frames: int) -> list[Camera]:
    """One camera for each frame, once around points, which all stay visible.

    The cameras turn about the upright axis through the middle of the points.

    view: the direction of the first camera.
    points: [m], shape [..., 3].
    aspect: width / height of the picture.
    frames: number of cameras.

    Raises OptionError for points that are not finite.
    """
    points = points.reshape(-1, 3).astype(np.float64)
    axis = (points.min(axis=0) + points.max(axis=0)) / 2
    radius = np.hypot(points[:, 0] - axis[0], points[:, 2] - axis[2])
    # The volume that the points sweep looks the same from all sides, so one framing is enough.
    swept = [axis + _ring(angle, radius, points[:, 1] - axis[1]) for angle in range(0, 360, 15)]
    first = frame_points(view, np.concatenate(swept), aspect)
    return [_turned(first, axis, 360.0 * frame / frames) for frame in range(frames)]


def _ring(degrees: float, radius: Array, height: Array) -> Array:
    angle = math.radians(degrees)
    return np.stack([radius * math.sin(angle), height, radius * math.cos(angle)], axis=-1)


def _turned(camera: Camera, axis: Array, degrees: float) -> Camera:
    """The camera rotated about an upright axis, counter-clockwise seen from above."""
    sin, cos = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))

    def turn(vector: Array) -> Vector:
        x, y, z = vector
        return float(cos * x + sin * z), float(y), float(cos * z - sin * x)

    return replace(
        camera,
        position=_vector(np.add(axis, turn(np.subtract(camera.position, axis)))),
        target=_vector(np.add(axis, turn(np.subtract(camera.target, axis)))),
        up=turn(np.asarray(camera.up)),
    )


def frame_points(view: View, points: Vectors, aspect: float, margin: float = 0.05) -> Camera:
    """A camera in the direction of a view that shows all points as large as the margin allows.

    view: the direction.
    points: [m], shape [..., 3].
    aspect: width / height of the picture.
    margin: the free fraction at each side.

    Raises OptionError for points that are not finite.
    """
    points = points.reshape(-1, 3).astype(np.float64)
    if not (len(points) and np.isfinite(points).all()):
        raise OptionError("the subject's points are not finite; there is nothing to frame")
    back, right, up = _axes(view)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    x, y, z = (dots(points - middle, axis) for axis in (right, up, back))
    room = 1 - 2 * margin
    # At least as deep as half a pixel of a large picture, so a flat subject has a near plane.
    radius = float(np.abs(z).max()) + 1e-3
    if view.fov is None:
        centre = middle + right * (x.min() + x.max()) / 2 + up * (y.min() + y.max()) / 2
        height = max(float(np.ptp(y)), float(np.ptp(x)) / aspect, 1e-6) / room
        return _camera(centre, back, up, 4 * radius + 1, radius, height=height)
    tan = math.tan(math.radians(view.fov) / 2) * room
    (x_mid, x_away), (y_mid, y_away) = _fit(x, z, tan * aspect), _fit(y, z, tan)
    centre = middle + right * x_mid + up * y_mid
    return _camera(centre, back, up, max(x_away, y_away, radius * 1.05), radius, fov=view.fov)


def _fit(across: Array, depth: Array, tan: float) -> tuple[float, float]:
    """The aim along one axis, and the least distance at which all points are visible.

    A point is visible if |across - aim| <= tan (distance - depth): the two outermost lines of
    sight, across = aim +- tan (distance - depth), meet at the nearest position of the camera.
    """
    high = float((across + tan * depth).max())
    low = float((across - tan * depth).min())
    return (high + low) / 2, (high - low) / (2 * tan)


def _axes(view: View) -> tuple[Array, Array, Array]:
    """Unit vectors from the subject to the camera, and to the right and the top of the picture."""
    azimuth, elevation = math.radians(view.azimuth), math.radians(view.elevation)
    sin, cos, level = math.sin(azimuth), math.cos(azimuth), math.cos(elevation)
    back = np.array([sin * level, math.sin(elevation), cos * level])
    right = np.array([cos, 0.0, -sin])
    return back, right, cross(back, right)


def _camera(
    centre: Array,
    back: Array,
    up: Array,
    distance: float,
    radius: float,
    *,
    fov: float = 40.0,
    height: float | None = None,
) -> Camera:
    near = max((distance - radius) * 0.5, 1e-3)
    far = distance + 2 * radius + 1
    return Camera(
        _vector(centre + back * distance), _vector(centre), _vector(up), fov, height, near, far
    )


def _vector(values: Array) -> Vector:
    return float(values[0]), float(values[1]), float(values[2])
