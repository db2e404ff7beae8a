"""Simple things to draw, shared by the tests of rendering."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from drapery.mesh import Mesh
from drapery.render.camera import Camera
from drapery.render.scene import Material, TextureLayer

FACING = Camera((0, 0, 10), (0, 0, 0), height=2.0, near=1, far=20)
"""Sees x and y from -1 to 1 in a square picture."""


def plain(*colour: int) -> TextureLayer:
    """One texel of a colour."""
    return TextureLayer(np.array([[colour]], np.uint8))


def painted(*colour: int, alpha: str = "opaque", lit: bool = False) -> Material:
    return Material((plain(*colour),), alpha, lit)


def noise(seed: int, *shape: int) -> np.ndarray:
    """Random texels, alpha among them."""
    return np.random.default_rng(seed).integers(0, 256, (*shape, 4), dtype=np.uint8)


def mesh(positions: ArrayLike, triangles: ArrayLike, uvs: ArrayLike | None = None) -> Mesh:
    """A mesh whose normals look along +z."""
    points = np.array(positions, np.float32)
    normals = np.broadcast_to(np.array([0, 0, 1], np.float32), points.shape).copy()
    flat = np.zeros((points.shape[-2], 2)) if uvs is None else np.array(uvs, float)
    return Mesh(points, normals, np.array(triangles, np.int32), flat)


def quad(
    left: float = -1, bottom: float = -1, right: float = 1, top: float = 1, z: float = 0
) -> Mesh:
    """A rectangle that shows its texture once, upright."""
    corners = [(left, top, z), (right, top, z), (left, bottom, z), (right, bottom, z)]
    return mesh(corners, [(0, 2, 1), (1, 2, 3)], [(0, 0), (1, 0), (0, 1), (1, 1)])


def soup(points: np.ndarray, uvs: Sequence[Sequence[float]] | np.ndarray | None = None) -> Mesh:
    """Triangles of their own corners, from points [T, 3, 3]."""
    count = len(points)
    return mesh(points.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3), uvs)
