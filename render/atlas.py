"""Many sprites on one sheet."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Texels
from drapery.errors import OptionError

PADDING = 1
"""Texels around each sprite, copies of its border: they keep neighbours out of inexact sampling."""

FEW_SIZES = 8
"""The most different sizes for which a block for each size is used instead of a packer."""

MAX_SHEET = 1 << 28
"""The most texels of an atlas; 1 GiB."""

Rects = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Atlas:
    """A sheet of sprites.

    texels: sRGB with straight alpha, shape [H, W, 4], uint8.
    rects: x, y, width, height of each sprite in texels, shape [S, 4].
    """

    texels: Texels
    rects: Rects


def make_atlas(sprites: Sequence[Texels]) -> Atlas:
    """Put sprites of any sizes on one sheet. Raises OptionError above MAX_SHEET texels."""
    if not sprites:
        return Atlas(np.zeros((1, 1, 4), np.uint8), np.zeros((0, 4), np.int32))
    sizes = np.array([sprite.shape[1::-1] for sprite in sprites], np.int64)
    rects, (width, height) = place(sizes + 2 * PADDING)
    if width * height > MAX_SHEET:
        raise OptionError(
            f"the scene's {len(sprites)} textures need {width} x {height} texels;"
            f" use smaller ones: all together at most {MAX_SHEET} texels"
        )
    sheet = np.zeros((height, width, 4), np.uint8)
    for sprite, (x, y) in zip(sprites, rects, strict=True):
        padded = _with_border(sprite)
        sheet[y : y + padded.shape[0], x : x + padded.shape[1]] = padded
    return Atlas(sheet, np.concatenate([rects + PADDING, sizes], axis=1).astype(np.int32))


def _with_border(sprite: Texels) -> Texels:
    """A sprite with PADDING copies of its border around it."""
    height, width = sprite.shape[:2]
    rows = np.minimum(np.maximum(np.arange(-PADDING, height + PADDING), 0), height - 1)
    columns = np.minimum(np.maximum(np.arange(-PADDING, width + PADDING), 0), width - 1)
    padded: Texels = sprite[rows[:, None], columns]
    return padded


def place(sizes: NDArray[np.int64]) -> tuple[NDArray[np.int64], tuple[int, int]]:
    """Corners [S, 2] of rectangles of these sizes [S, 2] without overlap, and the sheet's size.

    Sprites usually have few sizes: then there is a grid for each size. Many sizes are placed by
    trimesh's packer, a tree of free rectangles (it takes half a second to import).
    """
    # `np.unique` without an index would import numpy.ma.
    kinds = np.unique(sizes, axis=0, return_index=True)[0]
    return _grids(sizes, kinds) if len(kinds) <= FEW_SIZES else _packed(sizes)


def _grids(
    sizes: NDArray[np.int64], kinds: NDArray[np.int64]
) -> tuple[NDArray[np.int64], tuple[int, int]]:
    side = int(np.ceil(np.sqrt(sizes.prod(axis=1).sum())))
    width = max(side, int(sizes[:, 0].max()))
    corners = np.zeros_like(sizes)
    top = right = 0
    for kind in kinds[::-1]:
        (members,) = np.nonzero((sizes == kind).all(axis=1))
        columns = min(-(-width // int(kind[0])), len(members))
        row, column = np.divmod(np.arange(len(members)), columns)
        corners[members, 0] = column * kind[0]
        corners[members, 1] = top + row * kind[1]
        top += int((row[-1] + 1) * kind[1])
        right = max(right, columns * int(kind[0]))
    return corners, (right, top)


def _packed(sizes: NDArray[np.int64]) -> tuple[NDArray[np.int64], tuple[int, int]]:
    from trimesh.path.packing import rectangles_single

    # Largest first gives the smallest sheet, and the order is fixed: no shuffling.
    order = np.lexsort((-sizes[:, 0], -sizes[:, 1]))
    side = max(float(np.sqrt(sizes.prod(axis=1).sum())), float(sizes.max()))
    packed = np.zeros(1, np.bool_)
    while not packed.all():
        # The results between the bounds and the success flag differ between versions of trimesh.
        bounds, *_, packed = rectangles_single(
            sizes[order].astype(float), (side, side), rotate=False
        )
        side *= 1.05
    corners = np.zeros_like(sizes)
    corners[order] = np.rint(bounds[:, 0]).astype(np.int64)
    width, height = (corners + sizes).max(axis=0)
    return corners, (int(width), int(height))
