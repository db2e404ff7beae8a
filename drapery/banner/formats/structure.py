"""Java's structure files (`.nbt`): a palette of block states, and blocks that point into it."""

from collections.abc import Iterator, Sequence

from drapery.banner.design import Banner
from drapery.banner.formats.blocks import (
    OnError,
    Spot,
    at_block,
    banners_of_block,
    banners_of_entities,
    compounds,
    plain_banners,
    raise_error,
    spot,
    state_name,
)
from drapery.banner.formats.found import Found
from drapery.banner.formats.tree import Tree, is_banner_id
from drapery.banner.formats.write_nbt import DATA_VERSION, block_entity, encode, placeable

NAME = "structure"


def recognises(tree: dict[str, Tree]) -> bool:
    """Whether an NBT file's tree is a structure."""
    return "blocks" in tree and ("palette" in tree or "palettes" in tree)


def find(
    tree: dict[str, Tree], where: str = "", on_error: OnError = raise_error
) -> Iterator[Found]:
    """Every banner of a structure: blocks, contents of containers, entities.

    tree: of the whole file. Raises DesignError where the file is no structure.
    """
    names = _palette(tree, where)
    banners = {state for state, name in enumerate(names) if is_banner_id(name)}
    bare_blocks: dict[Spot, str] = {}
    for block in compounds(tree, where, "blocks"):
        state, entity = block.get("state"), block.get("nbt")
        if entity is None and state not in banners:
            continue
        place = spot(block.get("pos"), where)
        name = names[state] if isinstance(state, int) and 0 <= state < len(names) else None
        if isinstance(entity, dict):
            yield from banners_of_block(entity, name, at_block(where, place), on_error)
        elif name:
            bare_blocks[place] = name
    yield from plain_banners(bare_blocks, where)
    yield from banners_of_entities(compounds(tree, where, "entities"), where, on_error)


def _palette(tree: dict[str, Tree], where: str) -> list[str | None]:
    """The names of the states; of several palettes (ships), which differ in wood, the first."""
    if isinstance(several := tree.get("palettes"), list):
        tree = {"palette": several[0] if several else []}
    return [state_name(state) for state in compounds(tree, where, "palette")]


def write(banners: Sequence[Banner]) -> bytes:
    """A structure, compressed, of standing banners in a row to the east, facing south.

    Raises DesignError for shields, which are no blocks.
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
