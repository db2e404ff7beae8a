"""Ground and walls of blocks: only the visible faces, one model for each texture."""

from collections.abc import Mapping

import numpy as np

from drapery.banner.dyes import DYES
from drapery.banner.packs import Packs
from drapery.banner.sprites import WHITE, Tint
from drapery.mesh import Array, Mesh
from drapery.render.scene import Material, Model, TextureLayer

Cell = tuple[int, int, int]
"""A block by its lowest corner [m]: x, y, z."""

Face = tuple[str, Tint]
"""A texture and the colour that multiplies it."""

Cells = Mapping[Cell, str]

FACES: dict[str, tuple[str, str, str]] = {
    "grass": ("grass_block_top", "grass_block_side", "dirt"),
    "oak_log": ("oak_log_top", "oak_log", "oak_log_top"),
}
"""Textures of top, side and bottom of blocks whose sides differ."""

SIDES = (
    # Of a unit cube seen from outside: normal, upper left corner, step right, step down.
    ((0, 1, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1)),
    ((0, -1, 0), (0, 0, 1), (1, 0, 0), (0, 0, -1)),
    ((0, 0, 1), (0, 1, 1), (1, 0, 0), (0, -1, 0)),
    ((0, 0, -1), (1, 1, 0), (-1, 0, 0), (0, -1, 0)),
    ((1, 0, 0), (1, 1, 1), (0, 0, -1), (0, -1, 0)),
    ((-1, 0, 0), (0, 1, 0), (0, 0, 1), (0, -1, 0)),
)


def blocks(cells: Cells, packs: Packs) -> tuple[Model, ...]:
    """The visible faces of blocks named like `stone` or `grass`; the name of a dye is its wool.

    Raises PackError for a texture that cannot be read.
    """
    by_texture: dict[Face, list[tuple[Array, Array]]] = {}
    for cell, kind in sorted(cells.items()):
        for normal, start, right, down in SIDES:
            if tuple(np.add(cell, normal)) not in cells:
                quad = _corners(np.add(cell, start), np.array(right), np.array(down))
                sides = by_texture.setdefault(_texture(kind, normal[1]), [])
                sides.append((quad, np.tile(np.array(normal, float), (4, 1))))
    return tuple(
        Model(
            _quads(sides),
            (Material((TextureLayer(packs.texture(f"block/{texture}"), tint),)),),
            name=f"block/{texture}",
        )
        for (texture, tint), sides in sorted(by_texture.items())
    )


def plateau(width: int, depth: int, kind: str = "grass", thick: int = 1) -> dict[Cell, str]:
    """A level piece of ground around the origin, its top at y = 0, with dirt below grass."""
    low = "dirt" if kind == "grass" else kind
    return {
        (x, -1 - y, z): low if y else kind
        for x in range(-(width // 2), width - width // 2)
        for y in range(thick)
        for z in range(-(depth // 2), depth - depth // 2)
    }


def _texture(kind: str, up: int) -> Face:
    if kind in DYES:
        return "white_wool", DYES[kind].rgb
    top, side, bottom = FACES.get(kind, (kind, kind, kind))
    return {1: top, 0: side, -1: bottom}[up], WHITE


def _corners(start: Array, right: Array, down: Array) -> Array:
    corners: Array = start + np.stack([0 * right, right, down, right + down]).astype(float)
    return corners


def _quads(sides: list[tuple[Array, Array]]) -> Mesh:
    count = len(sides)
    pair = np.array([[0, 2, 1], [1, 2, 3]], np.int32)
    return Mesh(
        np.concatenate([quad for quad, _ in sides]),
        np.concatenate([normals for _, normals in sides]),
        (pair + 4 * np.arange(count, dtype=np.int32)[:, None, None]).reshape(-1, 3),
        np.tile(np.array([[0.0, 0], [1, 0], [0, 1], [1, 1]]), (count, 1)),
    )
