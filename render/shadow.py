"""Contact shadows: the ground is darker below models that stand on it or hang close above it.

The models are drawn from below four times, each time up to half the height. Parts close to the
ground are in all four pictures and give the darkest shadow. The blurred average of the pictures is
the texture of a dark quad on the ground.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError
from drapery.mesh import Array, Mesh
from drapery.render.camera import Camera
from drapery.render.light import UNLIT
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene

RESOLUTION = 16
"""Texels per metre, as on a block."""
MAX_TEXELS = 1024
"""The longest side of a shadow [texels]; wider scenes have larger texels."""
LIFT = 0.002
"""A shadow lies this high above its floor [m]."""
BLURS = 2


def contact_shadow(
    models: Sequence[Model],
    floor: float,
    reach: float = 1.0,
    strength: float = 0.5,
    within: tuple[float, float, float, float] | None = None,
) -> Model:
    """A dark quad on the ground under models; draw it after other models that lie on the ground.

    models: what casts the shadow.
    floor: height of the ground [m].
    reach: models cast a shadow up to this height above the ground [m].
    strength: darkness of the shadow under a model that fills all of the reach, 0..1.
    within: the extent of the ground, lowest x and z, then highest [m]; None is endless ground.

    Raises OptionError if no model has finite positions.
    """
    parts = [model.mesh.positions.reshape(-1, 3) for model in models]
    if not any(map(len, parts)) or not all(np.isfinite(part).all() for part in parts):
        raise OptionError("a contact shadow needs models with finite positions; give at least one")
    points = np.concatenate(parts)
    low, high = points[:, [0, 2]].min(axis=0), points[:, [0, 2]].max(axis=0)
    scale = min(RESOLUTION, (MAX_TEXELS - 8) / max(float((high - low).max()), 1e-6))
    size = np.ceil((high - low) * scale).astype(int) + 8
    middle = (low + high) / 2
    heights = np.ldexp(reach, -np.arange(4))
    shares = [_covered(models, floor, height, middle, size, scale) for height in heights]
    alpha = np.mean(shares, axis=0)
    for _ in range(BLURS):
        alpha = _blurred(alpha)
    if within is not None:
        alpha *= _inside(middle, size, scale, within)
    texels = np.zeros((*alpha.shape, 4), np.uint8)
    texels[..., 3] = np.rint(alpha * strength * 255)
    return Model(
        _floor(middle, size / scale, floor + LIFT),
        (Material((TextureLayer(texels),), "blend", False),),
        name="shadow",
    )


def shadow_corners(points: Array, floor: float) -> Array:
    """The corners of what `contact_shadow` darkens at most under points [m], shape [4, 3]."""
    edge = BLURS / RESOLUTION
    low, high = points.min(axis=0) - edge, points.max(axis=0) + edge
    return np.array([(x, floor, z) for x in (low[0], high[0]) for z in (low[2], high[2])])


def _covered(
    models: Sequence[Model],
    floor: float,
    height: float,
    middle: Array,
    size: NDArray[np.intp],
    scale: float,
) -> Array:
    """1 where a model is above the texel up to this height, otherwise 0, shape [H, W]."""
    x, z = (float(at) for at in middle)
    below = Camera(
        (x, floor - 1, z),
        (x, floor, z),
        up=(0, 0, 1),
        height=float(size[1] / scale),
        near=1.0,
        far=1 + height,
    )
    picture = draw_scene(Scene(tuple(models), below, (int(size[0]), int(size[1])), UNLIT))
    # Seen from below with +z at the top, +x is to the right; rows of the texture run along +z.
    return (picture.pixels[::-1, :, 3] > 0).astype(np.float64)


def _inside(
    middle: Array, size: NDArray[np.intp], scale: float, within: tuple[float, float, float, float]
) -> NDArray[np.bool_]:
    """Which texels have their middle on the ground, shape [H, W]."""
    across, along = (
        middle[axis] + (np.arange(size[axis]) + 0.5 - size[axis] / 2) / scale for axis in (0, 1)
    )
    left, near, right, far = within
    inside: NDArray[np.bool_] = ((along > near) & (along < far))[:, None] & (
        (across > left) & (across < right)
    )
    return inside


def _blurred(alpha: Array) -> Array:
    """A weighted mean of each texel and its neighbours, 1 2 1 along both sides."""
    for axis in (0, 1):
        padded = np.pad(alpha, [(1, 1) if axis == side else (0, 0) for side in (0, 1)])
        count = alpha.shape[axis]
        left, here, right = (
            padded.take(range(start, start + count), axis=axis) for start in range(3)
        )
        alpha = (left + 2 * here + right) / 4
    return alpha


def _floor(middle: Array, extent: Array, height: float) -> Mesh:
    (x0, z0), (x1, z1) = middle - extent / 2, middle + extent / 2
    positions = np.array(
        [(x0, height, z0), (x1, height, z0), (x0, height, z1), (x1, height, z1)], np.float32
    )
    normals = np.tile(np.array([0, 1, 0], np.float32), (4, 1))
    uvs = np.array([(0, 0), (1, 0), (0, 1), (1, 1)], np.float64)
    return Mesh(positions, normals, np.array([(0, 2, 1), (1, 2, 3)], np.int32), uvs)
