"""A beetle with a round body and thin legs, for cloth to fall on."""

import numpy as np

from drapery.arrays import Triangles
from drapery.mesh import Array, Mesh, vertex_normals
from drapery.render.scene import Material, Model, TextureLayer
from drapery.style.boxes import join

RED, SPOT, BLACK, WHITE = (196, 48, 38), (40, 32, 36), (52, 46, 54), (236, 232, 220)
RINGS, SEGMENTS = 10, 16


def beetle() -> tuple[Model, ...]:
    """A beetle on level ground over the origin that looks along +z [m]."""
    shell = _ball((0.0, 0.56, -0.1), (0.56, 0.4, 0.72))
    dark = [
        _ball((0.0, 0.5, 0.62), (0.36, 0.27, 0.26)),
        _ball((0.0, 0.46, 0.92), (0.22, 0.19, 0.2)),
        *(_limb(side, z) for side in (-1, 1) for z in (-0.45, 0.05, 0.5)),
        *(_horn(side) for side in (-1, 1)),
    ]
    eyes = [_ball((side * 0.15, 0.53, 1.05), (0.07, 0.07, 0.06)) for side in (-1, 1)]
    parts = [(shell, _spotted()), (join(dark), _plain(BLACK)), (join(eyes), _plain(WHITE))]
    return tuple(Model(mesh, (material,)) for mesh, material in parts)


def _ball(centre: tuple[float, float, float], radii: tuple[float, float, float]) -> Mesh:
    """An ellipsoid with its poles at the top and the bottom."""
    tilt = np.linspace(0, np.pi, RINGS + 1)[1:-1, None]
    turn = np.linspace(0, 2 * np.pi, SEGMENTS, endpoint=False)
    round_ = np.stack(
        [np.sin(tilt) * np.sin(turn), np.cos(tilt) + 0 * turn, np.sin(tilt) * np.cos(turn)], -1
    )
    unit = np.concatenate([[[0.0, 1, 0]], round_.reshape(-1, 3), [[0.0, -1, 0]]])
    uvs = np.stack([unit[:, 0] / 2 + 0.5, 0.5 - unit[:, 2] / 2], axis=1)
    triangles = _lathe(RINGS - 1, SEGMENTS)
    positions = unit * np.array(radii) + np.array(centre)
    return Mesh(positions, vertex_normals(positions, triangles), triangles, uvs)


def _rod(start: Array, end: Array, radius: float, sides: int = 6) -> Mesh:
    """A closed prism. start, end, radius: [m]."""
    along = (end - start) / np.sqrt(((end - start) ** 2).sum())
    other = np.cross(along, [0.3, 0.2, 0.93])
    other = other / np.sqrt((other**2).sum())
    turn = np.linspace(0, 2 * np.pi, sides, endpoint=False)[:, None]
    ring = radius * (np.cos(turn) * other + np.sin(turn) * np.cross(along, other))
    positions = np.concatenate([[start], start + ring, end + ring, [end]])
    triangles = _lathe(2, sides)[:, ::-1]
    uvs = np.full((len(positions), 2), 0.5)
    return Mesh(positions, vertex_normals(positions, triangles), triangles, uvs)


def _lathe(rings: int, sides: int) -> Triangles:
    """Triangles between a pole, rings of points, and the other pole, seen from outside."""
    index = 1 + np.arange(rings * sides).reshape(rings, sides)
    after = np.roll(index, -1, axis=1)
    last = 1 + rings * sides
    caps = [np.stack([0 * index[0], index[0], after[0]], -1)]
    caps.append(np.stack([0 * index[0] + last, after[-1], index[-1]], -1))
    a, b, c, d = index[:-1], index[1:], after[1:], after[:-1]
    walls = [np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)]
    return np.concatenate([*caps, *walls]).astype(np.int32)


def _limb(side: int, z: float) -> Mesh:
    """A leg: outwards and up to the knee, then down to the ground. side: -1 or 1."""
    hip, knee = np.array([0.3 * side, 0.4, z]), np.array([0.74 * side, 0.5, 1.25 * z])
    foot = np.array([0.92 * side, 0.03, 1.45 * z])
    return join([_rod(hip, knee, 0.055), _rod(knee, foot, 0.05)])


def _horn(side: int) -> Mesh:
    """An antenna. side: -1 or 1."""
    root, bend = np.array([0.08 * side, 0.58, 1.02]), np.array([0.22 * side, 0.86, 1.16])
    return join(
        [_rod(root, bend, 0.035), _rod(bend, bend + np.array([0.1 * side, 0.02, 0.2]), 0.035)]
    )


def _plain(colour: tuple[int, int, int]) -> Material:
    return Material((TextureLayer(np.array([[[*colour, 255]]], np.uint8)),))


def _spotted() -> Material:
    """The back seen from above, 24 x 24 texels: two red wings with a seam and spots."""
    y, x = np.indices((24, 24))
    seam = (x == 11) | (x == 12)
    spots = np.zeros_like(seam)
    for row, column in ((7, 5), (7, 18), (13, 8), (13, 15), (18, 5), (18, 18)):
        spots |= (x - column) ** 2 + (y - row) ** 2 <= 4
    texels = np.full((24, 24, 4), 255, np.uint8)
    texels[..., :3] = RED
    texels[seam | spots, :3] = SPOT
    return Material((TextureLayer(texels),))
