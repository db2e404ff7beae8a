"""Models that show a simulation: edges, springs, pins, normals, a map of stretch.

Each function makes a model to add to a scene, or to put in the place of one.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from drapery.arrays import Bytes, Floats, Pairs, Texels, Triangles, Vectors
from drapery.mesh import Array, Mesh
from drapery.render.camera import Camera
from drapery.render.lines import dot_model, line_model
from drapery.render.scene import Material, Model, TextureLayer
from drapery.render.vectors import dots

KIND_COLOURS = np.array(
    [(38, 70, 83, 255), (231, 111, 81, 255), (42, 157, 143, 255), (233, 196, 106, 255)], np.uint8
)
"""Colours of springs by their kind: structural, shear, flexion, other."""

INK = (30, 30, 34, 255)
PIN_RED = (214, 40, 40, 255)
NORMAL_BLUE = (58, 134, 255, 255)

RAMP = np.array(
    [(49, 54, 149), (116, 173, 209), (255, 255, 217), (253, 174, 97), (165, 0, 38)], np.float64
)
"""Colours of compressed, unstretched and stretched cloth, in this order."""


def edges_model(
    mesh: Mesh, camera: Camera, height: int, colour: ArrayLike = INK, width: float = 1.0
) -> Model:
    """The edges of a mesh, each once.

    mesh: positions [m], shape [V, 3].
    camera: of the picture.
    height: of the picture [pixels].
    colour: straight-alpha sRGB.
    width: of the lines [pixels].
    """
    points, triangles = _points(mesh)
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    lines = line_model(points, np.unique(edges, axis=0), colour, camera, height, width)
    return replace(lines, name="edges")


def springs_model(
    positions: Vectors,
    pairs: Pairs,
    kinds: Bytes,
    camera: Camera,
    height: int,
    width: float = 1.5,
) -> Model:
    """Springs as lines, in KIND_COLOURS by their kind.

    positions: [m], shape [N, 3].
    pairs: particle indices, shape [S, 2].
    kinds: of springs, see `drapery.cloth.Cloth`, shape [S].
    camera: of the picture.
    height: of the picture [pixels].
    width: of the lines [pixels].
    """
    # Flexion springs overlap structural ones, which are drawn last so that they are visible.
    order = np.argsort(-kinds.astype(np.int64), kind="stable")
    colours = KIND_COLOURS[np.minimum(kinds[order], len(KIND_COLOURS) - 1)]
    lines = line_model(positions, pairs[order], colours, camera, height, width)
    return replace(lines, name="springs")


def pins_model(positions: Vectors, inv_mass: Floats, camera: Camera, height: int) -> Model:
    """A dot on each pinned particle.

    positions: [m], shape [N, 3].
    inv_mass: inverse masses [1/kg], shape [N]; 0 is pinned.
    camera: of the picture.
    height: of the picture [pixels].
    """
    dots = dot_model(positions[inv_mass == 0], PIN_RED, camera, height, 7.0)
    return replace(dots, name="pins")


def normals_model(
    mesh: Mesh, length: float, camera: Camera, height: int, colour: ArrayLike = NORMAL_BLUE
) -> Model:
    """The normal at each vertex as a line.

    mesh: positions [m], shape [V, 3].
    length: of the lines [m].
    camera: of the picture.
    height: of the picture [pixels].
    colour: straight-alpha sRGB.
    """
    feet = mesh.positions.reshape(-1, 3)
    points = np.concatenate([feet, feet + length * mesh.normals.reshape(-1, 3)])
    numbers = np.arange(len(feet))
    segments = np.stack([numbers, numbers + len(feet)], axis=1)
    lines = line_model(points, segments, colour, camera, height, 1.0)
    return replace(lines, name="normals")


def stretch_model(mesh: Mesh, stretch: Floats, limit: float = 0.1) -> Model:
    """The mesh coloured by a number at each vertex, in the colours of RAMP.

    mesh: positions [m], shape [V, 3].
    stretch: the numbers, shape [V].
    limit: -limit and less is the first colour, 0 the middle, limit the last.
    """
    u = np.clip(stretch / (2 * limit) + 0.5, 0, 1)
    uvs = np.stack([u, np.full_like(u, 0.5)], axis=-1)
    shape = Mesh(mesh.positions, mesh.normals, mesh.triangles, uvs)
    return Model(shape, (Material((TextureLayer(_ramp()),)),), name="stretch")


def spring_stretch(positions: Vectors, pairs: Pairs, lengths: Floats) -> Floats:
    """The stretch of each spring, shape [S]: its length over its rest length, less 1.

    positions: [m], shape [N, 3].
    pairs: the two particles of each spring, shape [S, 2].
    lengths: rest lengths [m], shape [S].
    """
    between = positions[pairs[:, 1]] - positions[pairs[:, 0]]
    stretch: Array = np.sqrt(dots(between, between)) / lengths - 1
    return stretch


def at_particles(values: Floats, pairs: Pairs, count: int) -> Floats:
    """The value furthest from 0 among the springs at each particle, shape [count].

    values: one a spring, shape [S].
    pairs: the two particles of each spring, shape [S, 2].
    count: of the particles; one without a spring has 0.
    """
    high, low = np.zeros(count), np.zeros(count)
    for end in range(2):
        np.maximum.at(high, pairs[:, end], values)
        np.minimum.at(low, pairs[:, end], values)
    return np.where(high >= -low, high, low)


def _points(mesh: Mesh) -> tuple[Array, Triangles]:
    """Vertices [N, 3] and triangles of all meshes of a batch."""
    points = mesh.positions.reshape(-1, 3)
    count = mesh.positions.shape[-2]
    offsets = np.arange(0, max(len(points), 1), max(count, 1), dtype=np.int32)[:, None, None]
    return points, (mesh.triangles + offsets).reshape(-1, 3)


def _ramp() -> Texels:
    """The ramp as a texture, shape [1, 256, 4]."""
    at = np.linspace(0, len(RAMP) - 1, 256)
    channels = [np.interp(at, np.arange(len(RAMP)), RAMP[:, k]) for k in range(3)]
    texels: Texels = np.rint(np.stack([*channels, np.full(256, 255.0)], axis=-1)).astype(np.uint8)
    return texels[None]
