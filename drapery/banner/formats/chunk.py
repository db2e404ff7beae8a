"""One chunk of a Java world: its block entities, and the packed sections with their blocks.

Since 1.18 the root holds `sections` and `block_entities`; before, `Level` holds `Sections` and
`TileEntities`. A section is 16 x 16 x 16 blocks, x fastest, then z, then y. Its indices take
`max(4, bits of the palette)` bits each. Up to 1.15 an index may span two longs, since 1.16 it may
not; the length of the array distinguishes the two wherever they differ. Before 1.13 blocks are
numeric ids, and a banner's block entity has its base dye.
"""

from collections.abc import Iterator

import numpy as np

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
    raise_error,
    spot,
)
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.palettes import bits_for, longs_needed, unpack
from drapery.banner.formats.tree import DataTree, is_banner_id
from drapery.errors import DesignError, counted

SECTION_BLOCKS = 4096
LEAST_BITS = 4


def recognises(tree: dict[str, DataTree]) -> bool:
    """Whether an NBT tree is a chunk: of blocks, or of the entities that have their own files."""
    return "sections" in tree or isinstance(tree.get("Level"), dict) or "Entities" in tree


def find(
    tree: dict[str, DataTree], where: str = "", on_error: OnError = raise_error
) -> Iterator[FoundBanner]:
    """Every banner of a chunk: blocks, contents of containers, entities.

    tree: of the whole chunk. Raises DesignError for parts that a chunk cannot have.
    """
    level = compound(tree, where, "Level") or tree
    sections = _sections(level, where)
    for entity in compounds(level, where, "block_entities", "TileEntities"):
        place = spot(entity, where)
        at = at_block(where, place)
        block = None
        if is_banner_id(entity.get("id")):
            block = _block(sections.get(place[1] >> 4), place, at)
        yield from banners_of_block(entity, block, at, on_error)
    yield from banners_of_entities(compounds(level, where, "entities", "Entities"), where, on_error)


def _sections(level: dict[str, DataTree], where: str) -> dict[int, dict[str, DataTree]]:
    """The sections by their height: section Y begins at block 16 Y."""
    sections = compounds(level, where, "sections", "Sections")
    return {y: section for section in sections if isinstance(y := section.get("Y"), int)}


def _block(section: dict[str, DataTree] | None, place: Spot, where: str) -> str | None:
    """The id of the block at a place, or None if the section has no ids."""
    states = (section or {}).get("block_states", section)
    if not isinstance(states, dict):
        return None
    names = palette_ids(states, where, "palette", "Palette")
    if len(names) < 2:
        return names[0] if names else None
    x, y, z = (axis & 15 for axis in place)
    index = _index(states, len(names), y << 8 | z << 4 | x, where)
    return names[index] if index < len(names) else None


def _index(states: dict[str, DataTree], count: int, number: int, where: str) -> int:
    """The palette index of one of the section's blocks."""
    packed = longs(states.get("data", states.get("BlockStates")), where)
    bits = bits_for(count, LEAST_BITS)
    spanning = len(packed) == longs_needed(SECTION_BLOCKS, bits, spanning=True)
    if not spanning and len(packed) != longs_needed(SECTION_BLOCKS, bits, spanning=False):
        raise DesignError(
            f"{where}: {counted(len(packed), 'long')} cannot hold a section of"
            f" {counted(count, 'block state')}; let the game save the chunk again"
        )
    return int(unpack(packed, bits, np.array([number]), spanning)[0])
