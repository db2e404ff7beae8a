"""Litematica's schematics (`.litematic`): named boxes, each a palette and packed block states.

Indices take `max(2, bits of the palette)` bits each and may begin in one long and end in the
next; x is fastest, then z, then y. A size may be negative: the box then extends the other way.
"""

from collections.abc import Iterator

import numpy as np

from drapery.banner.formats.block_box import BlockBox, state_tree
from drapery.banner.formats.blocks import (
    OnError,
    Spot,
    at_block,
    banners_of_block,
    banners_of_entities,
    compound,
    compounds,
    longs,
    palette_ids,
    plain_banners,
    raise_error,
    spot,
)
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.palettes import (
    bits_for,
    longs_needed,
    names_in_box,
    pack,
    packed_pieces,
)
from drapery.banner.formats.tree import DataTree
from drapery.banner.formats.write_nbt import DATA_VERSION, block_entity, encode
from drapery.banner.names import shown
from drapery.errors import DesignError, counted

NAME = "litematic"
LEAST_BITS = 2
VERSION = 7
"""The layout since Java 1.20.5."""
REGION = "banners"
"""The name of what is written, and of its box."""


def recognises(tree: dict[str, DataTree]) -> bool:
    """Whether an NBT file's tree is a Litematica schematic."""
    return isinstance(tree.get("Regions"), dict)


def find(
    tree: dict[str, DataTree], where: str = "", on_error: OnError = raise_error
) -> Iterator[FoundBanner]:
    """Every banner of a schematic: blocks, contents of containers, entities.

    tree: of the whole file. Positions count from the schematic's origin.
    Raises DesignError for parts that a schematic cannot have.
    """
    regions = compound(tree, where, "Regions")
    for name in regions:
        label = f"{where} region {shown(name)}"
        yield from _find_in_region(compound(regions, label, name), label, on_error)


def _find_in_region(
    region: dict[str, DataTree], where: str, on_error: OnError
) -> Iterator[FoundBanner]:
    size = spot(region.get("Size"), f"{where} Size")
    corner = _corner(spot(region.get("Position"), f"{where} Position"), size)
    entities = {
        spot(entity.get("Pos", entity), where): entity
        for entity in compounds(region, where, "TileEntities")
    }
    names = _names(region, size, entities, where)
    for place, entity in entities.items():
        at = at_block(where, _sum(corner, place))
        yield from banners_of_block(entity, names.pop(place, None), at, on_error)
    yield from plain_banners({_sum(corner, place): name for place, name in names.items()}, where)
    yield from banners_of_entities(compounds(region, where, "Entities"), where, on_error)


def _names(
    region: dict[str, DataTree], size: Spot, places: dict[Spot, dict[str, DataTree]], where: str
) -> dict[Spot, str]:
    """The ids of the blocks at these places and of all banners."""
    states = palette_ids(region, where, "BlockStatePalette")
    box = abs(size[0]), abs(size[1]), abs(size[2])
    count, bits = box[0] * box[1] * box[2], bits_for(len(states), LEAST_BITS)
    packed = longs(region.get("BlockStates"), where)
    if len(packed) < longs_needed(count, bits, spanning=True):
        raise DesignError(
            f"{where}: BlockStates holds fewer than {counted(count, 'block')}; save the file again"
        )
    pieces = packed_pieces(packed, bits, count)
    return names_in_box(pieces, dict(enumerate(states)), box, places, where)


def _corner(position: Spot, size: Spot) -> Spot:
    """The box's lowest corner, from which the positions of block entities count."""
    x, y, z = (at + min(0, side + 1) for at, side in zip(position, size, strict=True))
    return x, y, z


def _sum(a: Spot, b: Spot) -> Spot:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def write(build: BlockBox) -> bytes:
    """A compressed schematic of one box, without a time, so that equal builds are equal files."""
    from nbtlib import Long

    filled = int(np.count_nonzero(build.blocks))
    metadata = {
        "Name": REGION,
        "Author": "",
        "Description": "",
        "EnclosingSize": _axes(build.size),
        "RegionCount": 1,
        "TotalBlocks": filled,
        "TotalVolume": build.blocks.size,
        "TimeCreated": Long(0),
        "TimeModified": Long(0),
    }
    return encode(
        {
            "Version": VERSION,
            "SubVersion": 1,
            "MinecraftDataVersion": DATA_VERSION,
            "Metadata": metadata,
            "Regions": {REGION: _box(build)},
        }
    )


def _box(build: BlockBox) -> dict[str, DataTree]:
    from nbtlib import LongArray

    packed = pack(build.blocks.ravel(), bits_for(len(build.states), LEAST_BITS))
    entities = [block_entity(each) | _axes(place) for place, each in build.banners.items()]
    return {
        "Position": _axes((0, 0, 0)),
        "Size": _axes(build.size),
        "BlockStatePalette": [state_tree(state) for state in build.states],
        "BlockStates": LongArray(packed),
        "TileEntities": entities,
        "Entities": [],
        "PendingBlockTicks": [],
        "PendingFluidTicks": [],
    }


def _axes(place: Spot) -> dict[str, DataTree]:
    return dict(zip("xyz", place, strict=True))
