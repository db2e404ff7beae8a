"""Cloth of a banner, what it meets, and how deep it is in that."""

from typing import Any

import numpy as np

from drapery.cloth import Box, Collider, Collisions, Plane, grid
from drapery.cloth.colliders.check import sample_distances
from drapery.mesh import Array

UNIT = 1 / 24
"""A texel of a banner [m]."""
POLE = Collider(Box(np.array([0, -23, -1.5]) * UNIT, np.array([2, 42, 2]) * UNIT))
BAR = Collider(Box(np.array([0, -1, -1.5]) * UNIT, np.array([20, 2, 2]) * UNIT))
FLOOR = Collider(Plane(np.array([0, -1.0, 0]), np.array([0, 1.0, 0])))
GROUND = Collider(Plane(np.zeros(3), np.array([0, 1.0, 0])))
MET = Collisions((POLE, BAR, FLOOR), thickness=UNIT)


def flag(shape: tuple[int, int]) -> Any:
    """The cloth of a banner of as many columns and rows."""
    return grid(*shape, 20 * UNIT, 40 * UNIT)


def depth(positions: Array, shape: Collider, cloth: Any) -> float:
    """How deep the particles, and points along all edges of the faces, are in a shape [m]."""
    corners = positions.astype(float)[cloth.triangles]
    parts = np.linspace(0, 1, 33)[:, None, None, None]
    edges = corners + parts * (np.roll(corners, 1, axis=1) - corners)
    return -float(sample_distances(shape.packed, edges.reshape(-1, 3)).min())


def crosses(positions: Array, triangles: Any) -> bool:
    """Whether any edge of the triangles passes through another triangle, tested pair by pair."""
    corners = positions.astype(float)[triangles]
    for shift in range(3):
        a, b = corners[:, shift], corners[:, (shift + 1) % 3]
        for number in range(len(corners)):
            p, q, r = corners[number]
            normal = np.cross(q - p, r - p)
            above, below = ((end - p) @ normal for end in (a, b))
            through = above * below < 0
            part = above / np.where(through, above - below, 1.0)
            at = a + part[:, None] * (b - a)
            sides = [np.cross(v - u, at - u) @ normal for u, v in ((p, q), (q, r), (r, p))]
            inside = through & np.logical_and.reduce([side > 0 for side in sides])
            shared = np.isin(triangles, triangles[number]).any(axis=1)
            if (inside & ~shared).any():
                return True
    return False
