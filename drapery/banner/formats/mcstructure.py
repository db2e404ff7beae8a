"""Bedrock's binary NBT: structures (`.mcstructure`), and any other file of its byte order.

A structure numbers its blocks, z fastest, then y, then x, and lists block entities by that number.
A banner's block entity has its base dye; `Type:1` is the ominous banner.
"""

from collections.abc import Iterator, Sequence

from drapery.banner.design import Banner
from drapery.banner.formats.bedrock import block_entity
from drapery.banner.formats.blocks import (
    OnError,
    Spot,
    at_block,
    banners_of_block,
    banners_of_entities,
    compound,
    compounds,
    raise_error,
    spot,
)
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.tree import DataTree
from drapery.banner.formats.write_nbt import encode
from drapery.errors import DesignError

NAME = "mcstructure"
BLOCK_VERSION = 18_163_713
"""1.21.40.1: the version of the block states, a byte for each number."""


def recognises(tree: dict[str, DataTree]) -> bool:
    """Whether an NBT file's tree is a Bedrock structure."""
    return "structure_world_origin" in tree or (
        "format_version" in tree and isinstance(tree.get("structure"), dict)
    )


def find(
    tree: dict[str, DataTree], where: str = "", on_error: OnError = raise_error
) -> Iterator[FoundBanner]:
    """Every banner of a structure: blocks, contents of containers, entities.

    tree: of the whole file. Positions count from the structure's corner.
    Raises DesignError for parts that a structure cannot have.
    """
    size = spot(tree.get("size"), f"{where} size")
    structure = compound(tree, where, "structure")
    palettes = compound(structure, where, "palette")
    for name in palettes:
        data = compound(compound(palettes, where, name), where, "block_position_data")
        for number in data:
            entity = compound(compound(data, where, number), where, "block_entity_data")
            at = at_block(where, _place(number, size, where))
            yield from banners_of_block(entity, None, at, on_error)
    yield from banners_of_entities(compounds(structure, where, "entities"), where, on_error)


def _place(number: str, size: Spot, where: str) -> Spot:
    """The place of a block by its number."""
    _, height, length = size
    if not (number.isascii() and number.isdigit() and len(number) < 12 and height * length > 0):
        raise DesignError(
            f"{where}: {number[:12]!r} is not the number of a block; export the file again"
        )
    return int(number) // (height * length), int(number) // length % height, int(number) % length


def write(banners: Sequence[Banner]) -> bytes:
    """A structure of standing banners in a row to the east, facing south.

    Raises DesignError for shields and the patterns of data packs, which Bedrock lacks.
    """
    block = {"name": "minecraft:standing_banner", "states": {"ground_sign_direction": 0}}
    data = {
        str(x): {"block_entity_data": block_entity(banner) | {"x": x, "y": 0, "z": 0}}
        for x, banner in enumerate(banners)
    }
    palette = {"block_palette": [block | {"version": BLOCK_VERSION}], "block_position_data": data}
    return encode(
        {
            "format_version": 1,
            "size": [len(banners), 1, 1],
            "structure": {
                "block_indices": [[0] * len(banners), [-1] * len(banners)],
                "entities": [],
                "palette": {"default": palette},
            },
            "structure_world_origin": [0, 0, 0],
        },
        "little",
    )
