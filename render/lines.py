"""Lines and dots as thin meshes that face the camera: any backend draws them, with depth."""

import math

import numpy as np
from numpy.typing import ArrayLike

from drapery.arrays import Pairs, Texels, Vectors
from drapery.mesh import Array, Mesh
from drapery.render.camera import Camera
from drapery.render.scene import Alpha, Material, Model, TextureLayer
from drapery.render.vectors import dots, unit

NEARER = 0.004
"""Lines are moved nearer by this fraction of their distance, so a surface does not hide them."""


def line_model(
    points: Vectors,
    segments: Pairs,
    colours: ArrayLike,
    camera: Camera,
    height: int,
    width: float = 1.5,
) -> Model:
    """Straight lines of one width in pixels at any distance, in plain colours.

    points: [m], shape [N, 3].
    segments: indices into points, shape [S, 2].
    colours: straight-alpha sRGB, shape [4] or [S, 4].
    camera: of the picture.
    height: of the picture [pixels].
    width: of the lines [pixels].
    """
    ends: Array = points[segments].astype(np.float64)
    along = ends[:, 1] - ends[:, 0]
    across = unit(np.cross(along[:, None], _towards(ends, camera)))
    half = _pixel_size(ends, camera, height)[..., None] * width / 2
    middle, beside = _nearer(ends, camera), across * half
    corners = np.stack([middle - beside, middle + beside], axis=2)
    return _quads(corners.reshape(-1, 4, 3), colours)


def dot_model(
    points: Vectors, colours: ArrayLike, camera: Camera, height: int, width: float = 5.0
) -> Model:
    """Squares of one size in pixels at any distance, which face the camera.

    points: [m], shape [N, 3].
    colours: straight-alpha sRGB, shape [4] or [N, 4].
    camera: of the picture.
    height: of the picture [pixels].
    width: of the dots [pixels].
    """
    places: Array = points.astype(np.float64)
    towards = _towards(places, camera)
    right = unit(np.cross(np.asarray(camera.up), towards))
    up = np.cross(towards, right)
    half = _pixel_size(places, camera, height)[..., None] * width / 2
    sides = [(-1, -1), (1, -1), (-1, 1), (1, 1)]
    places = _nearer(places, camera)
    return _quads(np.stack([places + half * (x * right + y * up) for x, y in sides], 1), colours)


def _quads(corners: Array, colours: ArrayLike) -> Model:
    """Unlit quads [Q, 4, 3] of one colour each; they share a texture with one texel per colour."""
    each = np.broadcast_to(np.asarray(colours, np.uint8), (len(corners), 4))
    palette, place = np.unique(each, axis=0, return_inverse=True)
    texels: Texels = palette[None] if len(palette) else np.zeros((1, 1, 4), np.uint8)
    u = (place.reshape(-1) + 0.5) / texels.shape[1]
    first = 4 * np.arange(len(corners), dtype=np.int32)[:, None]
    triangles = (first + np.array([[0, 1, 2, 2, 1, 3]], np.int32)).reshape(-1, 3)
    positions = corners.reshape(-1, 3).astype(np.float32)
    uvs = np.stack([u, np.full_like(u, 0.5)], axis=-1).repeat(4, axis=0)
    alpha: Alpha = "opaque" if (texels[..., 3] == 255).all() else "blend"
    material = Material((TextureLayer(np.ascontiguousarray(texels)),), alpha, lit=False)
    return Model(Mesh(positions, np.zeros_like(positions), triangles, uvs), (material,))


def _towards(points: Array, camera: Camera) -> Array:
    """Unit vectors from points [..., 3] to the eye."""
    eye = np.asarray(camera.position, np.float64)
    if camera.height is not None:
        return np.broadcast_to(unit(eye - np.asarray(camera.target)), points.shape)
    return unit(eye - points)


def _nearer(points: Array, camera: Camera) -> Array:
    return points + _towards(points, camera) * (_depth(points, camera) * NEARER)[..., None]


def _depth(points: Array, camera: Camera) -> Array:
    """Distance [m] of points from the camera's plane, at least the near plane's."""
    eye = np.asarray(camera.position, np.float64)
    sight = unit(np.asarray(camera.target) - eye)
    away: Array = np.maximum(dots(points - eye, sight), camera.near)
    return away


def _pixel_size(points: Array, camera: Camera, height: int) -> Array:
    """Metres that a pixel spans at points [..., 3], shape [...]."""
    if camera.height is not None:
        return np.full(points.shape[:-1], camera.height / height)
    spanned: Array = _depth(points, camera) * 2 * math.tan(math.radians(camera.fov) / 2) / height
    return spanned
