"""Sponge's schematics (`.schem`, versions 1 to 3), and the older `.schematic` with numeric ids.

A palette gives each block state a number; the blocks are a byte array of these numbers as
varints, x fastest, then z, then y.
https://github.com/SpongePowered/Schematic-Specification
"""

from collections.abc import Iterable, Iterator, Sequence

from drapery.banner.design import Banner
from drapery.banner.formats.blocks import (
    OnError,
    Spot,
    at_block,
    banners_of_block,
    banners_of_entities,
    compound,
    compounds,
    plain_banners,
    raise_error,
    spot,
)
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.palettes import names_in_box, varint_pieces
from drapery.banner.formats.tree import DataTree, state_id
from drapery.banner.formats.write_nbt import DATA_VERSION, block_entity, encode, placeable
from drapery.errors import DesignError

NAME = "schem"


def recognises(tree: dict[str, DataTree]) -> bool:
    """Whether an NBT file's tree is a schematic."""
    root = tree.get("Schematic", tree)
    return isinstance(root, dict) and {"Width", "Height", "Length"} <= root.keys()


def find(
    tree: dict[str, DataTree], where: str = "", on_error: OnError = raise_error
) -> Iterator[FoundBanner]:
    """Every banner of a schematic: blocks, contents of containers, entities.

    tree: of the whole file. Raises DesignError for parts that a schematic
    cannot have.
    """
    root = compound(tree, where, "Schematic") or tree
    blocks = root["Blocks"] if isinstance(root.get("Blocks"), dict) else root
    entities = _block_entities(blocks, where)
    names = _names(root, blocks, entities, where)
    for place, entity in entities.items():
        yield from banners_of_block(
            entity, names.pop(place, None), at_block(where, place), on_error
        )
    yield from plain_banners(names, where)
    yield from banners_of_entities(compounds(root, where, "Entities"), where, on_error)


def _block_entities(blocks: dict[str, DataTree], where: str) -> dict[Spot, dict[str, DataTree]]:
    """Block entities by place; version 3 has the game's own keys under `Data`."""
    entities = {}
    for entity in compounds(blocks, where, "BlockEntities", "TileEntities"):
        place = spot(entity.get("Pos", entity), where)
        inner = entity.get("Data")
        if isinstance(inner, dict):
            entity = {"Id": entity.get("Id")} | inner
        entities[place] = entity
    return entities


def _names(
    root: dict[str, DataTree], blocks: dict[str, DataTree], places: Iterable[Spot], where: str
) -> dict[Spot, str]:
    """The ids of the blocks at these places and of all banners; none for numeric ids."""
    palette = {
        number: name
        for state, number in compound(blocks, where, "Palette").items()
        if isinstance(number, int) and (name := state_id(state))
    }
    data = blocks.get("BlockData", blocks.get("Data"))
    if not palette or not isinstance(data, bytes):
        return {}
    return names_in_box(varint_pieces(data, where), palette, _size(root, where), places, where)


def _size(root: dict[str, DataTree], where: str) -> Spot:
    """Width, height and length, which are stored as unsigned shorts [blocks]."""
    width, height, length = spot([root.get(side) for side in ("Width", "Height", "Length")], where)
    return width & 0xFFFF or 1, height & 0xFFFF or 1, length & 0xFFFF or 1


def write(banners: Sequence[Banner]) -> bytes:
    """A schematic of version 3, compressed: standing banners in a row to the east.

    Raises DesignError for shields, which are not blocks, and for over 32767 banners.
    """
    from nbtlib import ByteArray, IntArray, Short

    if len(banners) > 0x7FFF:
        raise DesignError(f"{len(banners)} banners do not fit in a schematic; write fewer at once")
    bases = list(dict.fromkeys(placeable(banner).base for banner in banners))
    palette = {f"minecraft:{base}_banner[rotation=0]": n for n, base in enumerate(bases)}
    entities = [
        {"Id": "minecraft:banner", "Pos": IntArray([x, 0, 0]), "Data": block_entity(banner)}
        for x, banner in enumerate(banners)
    ]
    data = ByteArray([bases.index(banner.base) for banner in banners])
    return encode(
        {
            "Schematic": {
                "Version": 3,
                "DataVersion": DATA_VERSION,
                "Width": Short(len(banners)),
                "Height": Short(1),
                "Length": Short(1),
                "Blocks": {"Palette": palette, "Data": data, "BlockEntities": entities},
            }
        }
    )
