"""The details of materials as tables, and their tiles in halved copies down to one texel."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Texels
from drapery.errors import OptionError, counted
from drapery.render.scene import SurfaceDetail

MAX_SIDE = 1024
"""The longest side of a tile [texels]."""
EDGE_WIDE, EDGE_LONG = 32, 256
"""Texels of a strip from the edge inwards and along it."""


@dataclass(frozen=True, eq=False)
class DetailTables:
    """The details of L materials.

    rows: the first texel in `tiles` or -1 for no detail, the power of two that is the tile's side,
        the tile's texels along a whole u and v, the first texel of the strips or -1 for none, and
        how many of their columns change what shows; shape [L, 6], int32.
    edges: left, top, right and bottom of two parts of the texture [1/256 texels of the tile]; shape
        [L, 2, 4], int64.
    finishes: gloss, across, along, fuzz and sharpness, see `SurfaceDetail`; shape [L, 5].
    tiles: the texels of all copies of tiles and strips, 16 bits for each of the four numbers,
        int64.
    """

    rows: NDArray[np.int32]
    finishes: NDArray[np.float64]
    tiles: NDArray[np.int64]
    edges: NDArray[np.int64]


def make_detail_tables(details: Sequence[SurfaceDetail | None]) -> DetailTables:
    """The tables of the details of materials in their order. Raises OptionError."""
    rows = np.full((len(details), 6), -1, np.int32)
    edges = np.zeros((len(details), 2, 4), np.int64)
    finishes = np.zeros((len(details), 5))
    tiles: list[NDArray[np.int64]] = []
    starts: dict[int, int] = {}
    count = 0
    for number, detail in enumerate(details):
        if detail is None:
            continue
        side = _side(detail.tile)
        if id(detail.tile) not in starts:
            starts[id(detail.tile)] = count
            tiles.append(_copies(detail.tile))
            count += len(tiles[-1])
        across, down = (round(side * times) for times in detail.repeats)
        rows[number, :4] = starts[id(detail.tile)], side.bit_length() - 1, across, down
        if detail.strips is not None:
            if id(detail.strips) not in starts:
                starts[id(detail.strips)] = count
                tiles += [_copies(strip) for strip in _checked_strips(detail)]
                count += sum(map(len, tiles[-2:]))
            rows[number, 4:] = starts[id(detail.strips)], _width(detail.strips)
            scale = 256 * np.array([across, down, across, down])
            edges[number] = np.rint(np.array(detail.edges) * scale)
        shares = detail.gloss, detail.across, detail.along, detail.fuzz, detail.sharpness
        finishes[number] = shares
    return DetailTables(rows, finishes, np.concatenate([np.zeros(0, np.int64), *tiles]), edges)


def _checked_strips(detail: SurfaceDetail) -> Texels:
    strips, shape = detail.strips, (2, EDGE_LONG, EDGE_WIDE, 4)
    if strips is None or strips.shape != shape or strips.dtype != np.uint8:
        found = None if strips is None else f"shape {strips.shape} and type {strips.dtype}"
        raise OptionError(f"the strips of a detail have {found}; use {shape} of uint8")
    if len(detail.edges) not in (1, 2):
        given = counted(len(detail.edges), "edge")
        raise OptionError(f"a detail with strips has {given}; use one or two")
    return strips


def _width(strips: Texels) -> int:
    """Columns of strips up to the last one that is not level and without a tone and a share."""
    changes = (strips != np.array([128, 128, 128, 255])).any(axis=(0, 1, 3))
    return int(np.flatnonzero(changes).max(initial=-1)) + 1


def _side(tile: Texels) -> int:
    side = int(tile.shape[0])
    is_square = tile.ndim == 3 and tile.shape == (side, side, 4) and tile.dtype == np.uint8
    if not is_square or side & (side - 1) or not 1 <= side <= MAX_SIDE:
        raise OptionError(
            f"the tile of a detail has shape {tile.shape} and type {tile.dtype}; use"
            f" [side, side, 4] of uint8 with a power of two up to {MAX_SIDE} as its side"
        )
    return side


def _copies(tile: Texels) -> NDArray[np.int64]:
    """A tile, its copies of half the sides each down to one column, and the last one again."""
    level = tile.astype(np.int64)
    levels = [level]
    while level.shape[1] > 1:
        four = level[::2, ::2] + level[1::2, ::2] + level[::2, 1::2] + level[1::2, 1::2]
        level = (four + 2) >> 2
        levels.append(level)
    packed = [
        each[..., 0] | each[..., 1] << 16 | each[..., 2] << 32 | each[..., 3] << 48
        for each in [*levels, level]
    ]
    return np.concatenate([each.reshape(-1) for each in packed])
