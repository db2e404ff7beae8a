"""A board with a normal map, shared by the tests of both backends."""

import numpy as np

from drapery.mesh import Mesh
from drapery.render.camera import Camera
from drapery.render.light import GAME_LIGHT, Light
from drapery.render.scene import Material, Model, Scene, TextureLayer

WHITE = np.full((4, 4, 4), 255, np.uint8)
LEVEL = np.broadcast_to(np.array([128, 128, 255, 255], np.uint8), (4, 4, 4))


def slope(right: float, down: float, openness: int = 255) -> np.ndarray:
    """A map of one slope all over: the normal's parts along the sheet."""
    xy = np.rint(np.array([right, down]) * 127 + 128)
    return np.broadcast_to(np.array([*xy, openness, 255], np.uint8), (4, 4, 4))


def board(mirrored: bool = False) -> Mesh:
    """A square metre that faces +z, its texture upright or mirrored."""
    corners = np.array([[0.0, 1, 0.5], [1, 1, 0.5], [0, 0, 0.5], [1, 0, 0.5]])
    uvs = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1]])
    uvs[:, 0] = 1 - uvs[:, 0] if mirrored else uvs[:, 0]
    normals = np.broadcast_to([0.0, 0, 1], (4, 3))
    return Mesh(corners, normals, np.array([[0, 2, 1], [1, 2, 3]], np.int32), uvs)


def scene_of(mesh: Mesh, *layers: TextureLayer, light: Light = GAME_LIGHT) -> Scene:
    camera = Camera((0.5, 0.5, 3), (0.5, 0.5, 0), height=1.0)
    return Scene((Model(mesh, (Material(layers),)),), camera, (8, 8), light)
