"""Blueprints of the mods Structurize and MineColonies (`.blueprint`).

A palette of block states, and block entities with their places. The blocks are an array of ints
that hold two palette indices each, the first one high, x fastest, then z, then y.
"""

from collections.abc import Iterable, Iterator

import numpy as np

from drapery.banner.formats.blocks import (
    OnError,
    Spot,
    at_block,
    banners_of_block,
    banners_of_entities,
    compounds,
    palette_ids,
    plain_banners,
    raise_error,
    spot,
)
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.nbt import Numbers
from drapery.banner.formats.palettes import PIECE, Pieces, names_in_box
from drapery.banner.formats.tree import DataTree
from drapery.banner.names import shown
from drapery.errors import DesignError

NAME = "blueprint"
_SIZES = ("size_x", "size_y", "size_z")


def recognises(tree: dict[str, DataTree]) -> bool:
    """Whether an NBT file's tree is a blueprint."""
    return {*_SIZES, "palette", "blocks"} <= tree.keys()


def find(
    tree: dict[str, DataTree], where: str = "", on_error: OnError = raise_error
) -> Iterator[FoundBanner]:
    """Every banner of a blueprint: blocks, contents of containers, entities.

    tree: of the whole file. Raises DesignError for parts that a blueprint cannot have.
    """
    entities = {spot(entity, where): entity for entity in compounds(tree, where, "tile_entities")}
    names = _names(tree, entities, where)
    for place, entity in entities.items():
        name = names.pop(place, None)
        yield from banners_of_block(entity, name, at_block(where, place), on_error)
    yield from plain_banners(names, where)
    yield from banners_of_entities(compounds(tree, where, "entities"), where, on_error)


def _names(tree: dict[str, DataTree], places: Iterable[Spot], where: str) -> dict[Spot, str]:
    """The ids of the blocks at these places and of all banners."""
    palette = {n: name for n, name in enumerate(palette_ids(tree, where, "palette")) if name}
    size = spot([tree[side] for side in _SIZES], where)
    return names_in_box(_indices(tree["blocks"], where), palette, size, places, where)


def _indices(blocks: DataTree, where: str) -> Pieces:
    """The palette indices, two in each int."""
    if isinstance(blocks, Numbers) and blocks.dtype.endswith("i4"):
        ints = blocks.array()
    elif isinstance(blocks, list) and all(isinstance(number, int) for number in blocks):
        ints = np.array(blocks, np.int64)
    else:
        raise DesignError(
            f"{where}: blocks is {shown(blocks)}, not an array of ints; save the file again"
        )
    for first in range(0, len(ints), PIECE):
        piece = ints[first : first + PIECE].astype(np.int64)
        pairs = np.stack((piece >> 16 & 0xFFFF, piece & 0xFFFF), axis=1)
        yield 2 * first, pairs.reshape(-1)
