"""Java's structure files (`.nbt`): a palette of block states, and blocks that point into it.

In SNBT the game writes the blocks as `data`, each with its state as a text.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from drapery.banner.design import Banner
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
from drapery.banner.formats.rows import Rows
from drapery.banner.formats.tree import DataTree, is_banner_id, state_id
from drapery.banner.formats.write_nbt import DATA_VERSION, block_entity, encode, placeable

NAME = "structure"


def recognises(tree: dict[str, DataTree]) -> bool:
    """Whether an NBT file's tree is a structure."""
    has_palette = "palette" in tree or "palettes" in tree
    return has_palette and ("blocks" in tree or ("data" in tree and "size" in tree))


def find(
    tree: dict[str, DataTree], where: str = "", on_error: OnError = raise_error
) -> Iterator[FoundBanner]:
    """Every banner of a structure: blocks, contents of containers, entities.

    tree: of the whole file. Raises DesignError for parts that a structure
    cannot have.
    """
    names = _palette(tree, where)
    bare_blocks: dict[Spot, str] = {}
    key = "blocks" if "blocks" in tree else "data"
    compounds(tree, where, key)
    for block in tree[key]:
        if isinstance(block, Rows):
            bare_blocks |= _banners_of_rows(block, names, where)
            continue
        state, entity = block.get("state"), block.get("nbt")
        name = names.get(state) if isinstance(state, int) else state_id(state)
        if isinstance(entity, dict):
            at = at_block(where, spot(block.get("pos"), where))
            yield from banners_of_block(entity, name, at, on_error)
        elif name and is_banner_id(name):
            bare_blocks[spot(block.get("pos"), where)] = name
    yield from plain_banners(bare_blocks, where)
    yield from banners_of_entities(compounds(tree, where, "entities"), where, on_error)


def _banners_of_rows(rows: Rows, names: dict[int, str], where: str) -> dict[Spot, str]:
    """The banners of blocks that have nothing but a state and a position."""
    banners = [state for state, name in names.items() if is_banner_id(name)]
    states, places = rows.column("state"), rows.column("pos")
    if states.dtype.kind != "i" or not len(places):
        return {}
    hits = np.flatnonzero(np.isin(states[:, 0], banners))
    return {spot(places[hit].tolist(), where): names[int(states[hit, 0])] for hit in hits}


def _palette(tree: dict[str, DataTree], where: str) -> dict[int, str]:
    """The ids of the states. Files of ships have several palettes, of which the first counts."""
    if isinstance(several := tree.get("palettes"), list):
        tree = {"palette": several[0] if several else []}
    return dict(enumerate(palette_ids(tree, where, "palette")))


def write(banners: Sequence[Banner]) -> bytes:
    """A structure, compressed, of standing banners in a row to the east, facing south.

    Raises DesignError for shields, which are not blocks.
    """
    bases = list(dict.fromkeys(placeable(banner).base for banner in banners))
    palette = [
        {"Name": f"minecraft:{base}_banner", "Properties": {"rotation": "0"}} for base in bases
    ]
    blocks = [
        {"state": bases.index(banner.base), "pos": [x, 0, 0], "nbt": block_entity(banner)}
        for x, banner in enumerate(banners)
    ]
    size = [len(banners), 1, 1]
    root = {"size": size, "palette": palette, "blocks": blocks, "entities": []}
    return encode(root | {"DataVersion": DATA_VERSION})
