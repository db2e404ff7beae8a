"""The block below a standing body and the wall behind a banner on it."""

from collections.abc import Iterable

import numpy as np

from drapery.banner.dyes import DYES
from drapery.banner.packs import Packs
from drapery.errors import OptionError
from drapery.mesh import Array, Mesh
from drapery.render.scene import Material
from drapery.settings import Placement
from drapery.style.block_world import FACES, Cell, blocks
from drapery.style.body import Part
from drapery.style.piece import MaterialAt

PIECES: dict[Placement, int] = {"standing": 8, "wall": 4}
"""Squares along a side of a face near the body: its light is measured at their corners."""

_BELOW: tuple[Cell, ...] = ((0, -1, 0),)
_BEHIND: tuple[Cell, ...] = tuple((x, y, -1) for x in range(-3, 4) for y in range(-3, 3))


def ground_of(
    block: str, packs: Packs, placement: Placement, cells: Iterable[Cell] = ()
) -> tuple[Part, ...]:
    """One block below the space of a standing body, or a wall seven wide and six high behind it.

    block: the name of a texture under `block/`, of a dye for its wool, or `grass`.
    cells: other places of blocks; none for those above.
    Raises OptionError for a block without texture, and PackError.
    """
    top = FACES.get(block, (block,))[0]
    if block not in DYES and not packs.has_texture(f"block/{top}"):
        raise OptionError(
            f"ground {block} has no texture block/{top} in the packs or in our own art; use none,"
            " grass, stone or another block"
        )
    is_wall = placement == "wall"
    places = tuple(cells) or (_BEHIND if is_wall else _BELOW)
    models = blocks(dict.fromkeys(places, block), packs)
    pieces = PIECES[placement]
    facing = np.array([0.0, 0.0, 1.0] if is_wall else [0.0, 1.0, 0.0])
    return tuple(
        Part(_refined(model.mesh, facing, pieces), _always(model.materials[0])) for model in models
    )


def _always(material: Material) -> MaterialAt:
    return lambda time: material


def _refined(mesh: Mesh, facing: Array, pieces: int) -> Mesh:
    """The mesh with its quads that face a direction cut into pieces x pieces.

    mesh: quads of four vertices each: upper left, upper right, lower left, lower right.
    """
    corners, uvs = mesh.positions.reshape(-1, 4, 3), mesh.uvs.reshape(-1, 4, 2)
    normals = mesh.normals.reshape(-1, 4, 3)
    is_near = (normals[:, 0] == facing).all(axis=1)
    if not is_near.any():
        return mesh
    other, near = ~is_near, is_near
    count = int(near.sum())
    u, v = (part.reshape(-1) for part in np.meshgrid(*[np.linspace(0, 1, pieces + 1)] * 2))
    shares = np.stack([(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v], axis=-1)
    a = (np.arange(pieces)[:, None] * (pieces + 1) + np.arange(pieces)).reshape(-1)
    b, c, d = a + 1, a + pieces + 1, a + pieces + 2
    cell = np.stack([a, c, b, b, c, d], axis=-1).reshape(-1, 3)
    first = 4 * int(other.sum()) + len(u) * np.arange(count)
    quads = np.array([[0, 2, 1], [1, 2, 3]]) + 4 * np.arange(int(other.sum()))[:, None, None]
    triangles = [quads.reshape(-1, 3), (cell + first[:, None, None]).reshape(-1, 3)]
    return Mesh(
        np.concatenate([corners[other].reshape(-1, 3), _mixed(shares, corners[near])]),
        np.concatenate([normals[other].reshape(-1, 3), np.tile(facing, (count * len(u), 1))]),
        np.concatenate(triangles).astype(np.int32),
        np.concatenate([uvs[other].reshape(-1, 2), _mixed(shares, uvs[near])]),
    )


def _mixed(shares: Array, corners: Array) -> Array:
    """Weighted sums of corners [K, 4, C] for every one of the shares [S, 4], shape [K * S, C]."""
    mixed: Array = np.einsum("sf,kfc->ksc", shares, corners)
    return mixed.reshape(-1, corners.shape[-1])
