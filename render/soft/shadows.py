"""Cast shadows and ambient occlusion of a light whose first direction casts shadows.

Shadows: the scene is drawn from far away in the direction of the light, and each sample of that map
keeps the depth of the nearest surface (Williams, "Casting curved shadows on curved surfaces",
SIGGRAPH 1978). A sample of the picture lies in shadow as far as the map's samples around its place
are nearer to the light (Reeves, Salesin and Cook, "Rendering antialiased shadows with depth maps",
SIGGRAPH 1987). Coverage of the map is exact, as coverage of the picture is.

Ambient occlusion: how much of the sky each vertex sees, by small maps from many directions.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Triangles
from drapery.elementary import cos, sin
from drapery.mesh import Array
from drapery.render.camera import Camera, Vector
from drapery.render.drawlist import DrawList, Float32
from drapery.render.light import Light
from drapery.render.soft.cast import TAPS, TAPS_MIDDLE
from drapery.render.soft.occlusion import occlude
from drapery.render.vectors import cross, unit

SOFTNESS = 0.02
"""Width of the edge of a shadow [m]."""
FINE = 0.01
"""The widest sample of a map [m], unless the map would have more than MAX_MAP samples."""
SIDE_STEP = 0.25
"""The width of a map is a multiple of this [m], so that it changes rarely while a cloth moves."""
LEAST_SPREAD = 0.75
SAFETY = 1.3
MAX_MAP = 2048
MIN_MAP = 256

OCCLUDERS = 16
"""Directions from which the occlusion is measured."""
OCCLUSION_MAP = 64
"""Side of their maps [samples]."""
COARSE = 0.45
"""Vertices of triangles with a longer side than this are not occluded [m]: the darkness would
spread over the whole triangle."""


@dataclass(frozen=True, eq=False)
class ShadowMap:
    """The depth of the nearest surface as the light sees it.

    depths: shape [S * S], int32; greater is nearer, 0 is nothing. side: S.
    spread: distance of the places around a place that are compared [samples].
    """

    depths: NDArray[np.int32]
    side: int
    spread: float


@dataclass(frozen=True, eq=False)
class ShadowLight:
    """How the light that casts shadows falls on a scene.

    camera: its parallel view of all that is lit. side: samples along a side of its map.
    spread: see `ShadowMap`. lifted: vertices as they look themselves up in the map [m], shape
    [V, 3]. bright, dark: their brightness in the light and in shadow, each [V].
    """

    camera: Camera
    side: int
    spread: float
    lifted: Float32
    bright: Float32
    dark: Float32


NO_SHADOWS = ShadowMap(np.empty(0, np.int32), 0, 0.0)
NO_RECEIVERS = np.empty((0, 4), np.float32)


def shadow_light(light: Light, size: tuple[int, int], drawing: DrawList) -> ShadowLight | None:
    """The light on a draw list for a picture of this size [pixels]; None if nothing is lit."""
    constant, positions, normals = drawing.topology, drawing.positions, drawing.normals
    lit = constant.lit_vertices
    if not lit.any():
        return None
    receiving = positions[lit]
    camera = light_camera(light, receiving)
    width = float(camera.height or 0.0)
    side = map_side(size, width)
    spread, lift = map_spread(side, width)
    openness = openness_of(positions, normals, lit, bounds_of(receiving), constant.casters)
    lifted = positions + np.float32(lift) * normals
    shades = split_light(light, normals, openness, constant.transmission)
    return ShadowLight(camera, side, spread, lifted, *shades)


def map_side(size: tuple[int, int], width: float) -> int:
    """Samples along a side of the map, a power of two.

    size: of the picture [pixels]. width: of the map [m].
    """
    side = MIN_MAP
    while side < MAX_MAP and (side < max(size) or width > FINE * side):
        side *= 2
    return side


def map_spread(side: int, width: float) -> tuple[float, float]:
    """Distance of the places compared [samples], and how far surfaces are lifted [m].

    A surface that is lifted along its normal by the width of what is compared does not shade itself
    at any angle: at an angle t to the light it is nearer by lift / cos t, and its neighbours are
    nearer by at most width tan t.
    """
    sample = width / side
    spread = max(SOFTNESS / sample / TAPS, LEAST_SPREAD)
    return spread, SAFETY * (TAPS_MIDDLE * spread + 1) * sample


def light_camera(light: Light, positions: Float32) -> Camera:
    """A parallel view of all these points, shape [V, 3], from the light's first direction."""
    towards = light.unit_directions()[0]
    up = np.array([0.0, 1.0, 0.0] if abs(towards[1]) < 0.99 else [0.0, 0.0, 1.0])
    right = unit(cross(up, towards))
    top = cross(towards, right)
    spans = []
    for axis in (right, top, towards):
        along = sum(positions[:, k] * np.float32(axis[k]) for k in range(3))
        spans.append((float(np.min(along)), float(np.max(along))))
    widest = max(high - low for low, high in spans[:2]) + 4 * SOFTNESS
    side = SIDE_STEP * np.ceil(widest / SIDE_STEP)
    # The map moves in whole samples, so that edges of shadows do not flicker.
    grain = side / MIN_MAP
    places = [grain * np.round((low + high) / 2 / grain) for low, high in spans[:2]]
    depth = spans[2][1] - spans[2][0] + 1.0
    middle = right * places[0] + top * places[1] + towards * (sum(spans[2]) / 2)
    return Camera(
        _vector(middle + towards * depth), _vector(middle), _vector(top), 40.0, side, 0.1, 2 * depth
    )


def split_light(
    light: Light, normals: Float32, openness: Float32, through: Float32
) -> tuple[Float32, Float32]:
    """The brightness of vertices in the light of the first direction and in its shadow, each [V].

    openness: how much of the sky each vertex sees, 0..1, shape [V]. through: see `Topology`.
    What hides a translucent surface from the sky lets as much light through. Its far side is taken
    to lie in no shadow.
    """
    openness = openness + through * (1 - openness)
    dark = np.float32(light.ambient) * openness
    key = np.zeros(len(normals), np.float32)
    for number, towards in enumerate(light.unit_directions()):
        facing = sum(normals[:, axis] * np.float32(towards[axis]) for axis in range(3))
        share = np.float32(light.diffuse) * np.maximum(facing, np.float32(0))
        behind = np.float32(light.diffuse) * np.maximum(-facing, np.float32(0))
        dark = dark + through * behind
        if number:
            dark = dark + share * openness
        else:
            key = share
    return np.minimum(dark + key, np.float32(1)), np.minimum(dark, np.float32(1))


def bounds_of(positions: Float32) -> tuple[Float32, Float32]:
    """The least and the greatest coordinates of points, shape [3] each.

    Axis by axis, because numpy needs eight times as long to reduce all three at once.
    """
    low, high = (
        np.array([find(positions[:, axis]) for axis in range(3)], np.float32)
        for find in (np.min, np.max)
    )
    return low, high


def openness_of(
    positions: Float32,
    normals: Float32,
    lit: NDArray[np.bool_],
    bounds: tuple[Float32, Float32],
    casters: Triangles,
) -> Float32:
    """How much of the sky each vertex sees, 0..1, shape [V]; see `occlude`.

    lit: the vertices to be measured, which hold those of the casters, shape [V].
    bounds: of these vertices; see `bounds_of`.
    """
    low, high = bounds
    reach = float(np.sqrt(((high - low) ** 2).sum())) / 2
    cell = max(2 * reach / (OCCLUSION_MAP - 4), 1e-6)
    open_sky = np.ones(len(positions), np.float32)
    occlude(
        positions,
        normals,
        casters,
        ((low + high) / 2).astype(np.float64),
        cell,
        OCCLUSION_MAP,
        _directions(OCCLUDERS),
        COARSE,
        ~lit,
        open_sky,
    )
    return open_sky


@lru_cache(maxsize=2)
def _directions(count: int) -> Array:
    """Directions all around with two axes across each, shape [count, 3, 3].

    A spiral on the sphere (Swinbank and Purser, "Fibonacci grids", 2006).
    """
    number = np.arange(count) + 0.5
    height = 1 - 2 * number / count
    around = np.pi * (1 + np.sqrt(5.0)) * number
    flat = np.sqrt(1 - height * height)
    towards = np.stack([flat * cos(around), height, flat * sin(around)], axis=-1)
    right = unit(np.cross(np.array([0.0, 1.0, 0.0]), towards))
    return np.stack([right, np.cross(towards, right), towards], axis=1)


def _vector(values: Any) -> Vector:
    return float(values[0]), float(values[1]), float(values[2])
