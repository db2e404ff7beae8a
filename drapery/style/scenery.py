"""Surroundings of scenes: a plain sky, pieces of ground, poles, water, and round shadows."""

from dataclasses import replace
from itertools import product

import numpy as np

from drapery.banner.packs import Packs
from drapery.mesh import Array, Mesh
from drapery.render.scene import Material, Model, TextureLayer
from drapery.style.block_world import Cell, blocks
from drapery.style.boxes import ModelBox, box_mesh, upright
from drapery.style.layers import wood_material

SKY = (168, 204, 242, 255)
"""The background of outdoor scenes by day, sRGB and opaque."""

SHADOW = 84
"""Opacity of a shadow in its middle, 0..255."""


def path_ground(half: int, period: int, packs: Packs) -> tuple[Model, ...]:
    """A path between grass along z that repeats after `period` blocks.

    half: its length to either side of the origin [blocks].
    """
    cells: dict[Cell, str] = {}
    for x, z in product(range(-3, 3), range(-half, half)):
        cells[x, -1, z] = _paving(x, z % period)
        cells[x, -2, z] = "dirt"
    return blocks(cells, packs)


def _paving(x: int, z: int) -> str:
    """The block at a place of the path, which is two blocks wide and of mixed stone."""
    if x not in (-1, 0):
        return "grass"
    kinds = ("cobblestone", "stone", "stone_bricks", "cobblestone", "stone")
    return kinds[(3 * z + 2 * x + z * z // 3) % len(kinds)]


def moved(models: tuple[Model, ...], by: Array) -> tuple[Model, ...]:
    """The models moved. by: [m], shape [3]."""
    return tuple(
        replace(model, mesh=replace(model.mesh, positions=model.mesh.positions + by))
        for model in models
    )


def post(foot: Array, height: float, packs: Packs, half: float = 0.06) -> Model:
    """A vertical pole. foot: [m], shape [3]. height, half: its height and half width [m]."""
    pole = box_mesh(ModelBox((-1, -42, -1), (2, 42, 2), (44, 0)))
    standing = upright(pole, 1.0, (0, 0, 0))
    scale = np.array([half, height / 42, half])
    mesh = replace(standing, positions=standing.positions * scale + foot)
    return Model(mesh, (wood_material(packs),), name="pole")


def pole(start: Array, end: Array, packs: Packs, half: float = 0.06) -> Model:
    """A square pole between two places. start, end: [m], shape [3]. half: its half width [m]."""
    along, rotation = pole_frame(start, end)
    upright_post = post(np.zeros(3), along, packs, half)
    mesh = upright_post.mesh
    positions = np.einsum("ij,vj->vi", rotation, mesh.positions) + start
    normals = np.einsum("ij,vj->vi", rotation, mesh.normals)
    return replace(upright_post, mesh=replace(mesh, positions=positions, normals=normals))


def pole_frame(start: Array, end: Array) -> tuple[float, Array]:
    """The length of a pole [m], and the rotation of an upright one, shape [3, 3]."""
    away = end - start
    length = float(np.sqrt((away * away).sum()))
    up = away / length
    level = np.array([up[1], -up[0], 0.0]) if abs(up[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
    right = level - (level * up).sum() * up
    right /= np.sqrt((right * right).sum())
    return length, np.stack([right, up, np.cross(right, up)], axis=1)


def sea(half: int, level: float) -> Model:
    """Water, `half` blocks to every side of the origin, at a height [m]."""
    x, z = (corner.reshape(-1) for corner in np.meshgrid(*[np.arange(-half, half)] * 2))
    corners = np.stack([x, np.full_like(x, 0), z], axis=-1)[:, None] + SQUARE
    count = len(corners)
    pairs = FLAT + 4 * np.arange(count, dtype=np.int32)[:, None, None]
    mesh = Mesh(
        corners.reshape(-1, 3) + np.array([0.0, level, 0.0]),
        np.tile(np.array([0.0, 1.0, 0.0]), (4 * count, 1)),
        pairs.reshape(-1, 3),
        np.tile(CORNERS, (count, 1)),
    )
    return Model(mesh, (_water(),), name="water")


def _water() -> Material:
    """Short waves in four blues; the texture repeats after each block."""
    x, y = np.meshgrid(np.arange(16), np.arange(16))
    tone = (7 * y + 3 * ((x + 5 * y) // 4) + (x + 2 * y) // 7) % 11
    blues = np.array([[52, 96, 176], [58, 104, 184], [64, 112, 192], [84, 132, 208]], np.uint8)
    texels = np.full((16, 16, 4), 255, np.uint8)
    texels[..., :3] = blues[np.choose(tone, [0, 1, 2, 1, 2, 1, 0, 1, 2, 1, 3])]
    return Material((TextureLayer(texels),))


FLAT = np.array([[0, 2, 1], [1, 2, 3]], np.int32)
CORNERS = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1]])
SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 1], [1, 0, 1]])


def shadow(centre: tuple[float, float], radius: float, height: float = 0.0) -> Model:
    """A round shadow of whole texels on level ground. centre: (x, z), radius and height: [m]."""
    across = np.arange(16) - 7.5
    distance = np.hypot(*np.meshgrid(across, across)) / 8
    texels = np.zeros((16, 16, 4), np.uint8)
    # In four steps: pixel art has no soft edges.
    texels[..., 3] = SHADOW * np.clip(np.ceil((1 - distance) * 6), 0, 4) / 4
    x, z = centre
    corners = np.array([[-1, 0, -1], [1, 0, -1], [-1, 0, 1], [1, 0, 1]]) * radius
    mesh = Mesh(
        corners + np.array([x, height + 0.004, z]),
        np.tile(np.array([0.0, 1.0, 0.0]), (4, 1)),
        FLAT,
        CORNERS,
    )
    return Model(mesh, (Material((TextureLayer(texels),), "blend", lit=False),), name="shadow")
