"""Sponge's schematics (`.schem`, versions 1 to 3), and the older `.schematic` with numeric ids.

A palette gives each block state a number; the blocks are a byte array of these numbers as
varints, x fastest, then z, then y.
https://github.com/SpongePowered/Schematic-Specification
"""

from collections.abc import Iterable, Iterator
from typing import Literal

from drapery.banner.formats.block_box import BlockBox
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
from drapery.banner.formats.write_nbt import DATA_VERSION, block_entity, encode

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


def write(build: BlockBox, version: Literal[2, 3] = 2) -> bytes:
    """A compressed schematic, whose lowest corner is pasted where the player stands.

    version: 2 is read by all programs that read schematics, 3 by newer ones.
    """
    from nbtlib import IntArray, Short

    width, height, length = map(Short, build.size)
    origin = [0, 0, 0]
    head = {
        "Version": version,
        "DataVersion": DATA_VERSION,
        "Metadata": dict(zip(("WEOffsetX", "WEOffsetY", "WEOffsetZ"), origin, strict=True)),
        "Width": width,
        "Height": height,
        "Length": length,
        "Offset": IntArray(origin),
    }
    if version == 3:
        return encode({"Schematic": head | {"Blocks": _blocks_of_3(build)}})
    return encode(head | _blocks_of_2(build), name="Schematic")


def _blocks_of_2(build: BlockBox) -> dict[str, DataTree]:
    """The keys of version 2, where the game's own keys of an entity lie beside its place."""
    return {
        "PaletteMax": len(build.states),
        "Palette": _palette(build),
        "BlockData": _data(build),
        "BlockEntities": [head | inner for head, inner in _entities(build)],
        "Entities": [],
    }


def _blocks_of_3(build: BlockBox) -> dict[str, DataTree]:
    """The compound of version 3, where the game's own keys of an entity lie under `Data`."""
    return {
        "Palette": _palette(build),
        "Data": _data(build),
        "BlockEntities": [head | {"Data": inner} for head, inner in _entities(build)],
    }


def _palette(build: BlockBox) -> dict[str, DataTree]:
    return {state: number for number, state in enumerate(build.states)}


def _data(build: BlockBox) -> DataTree:
    """Every block as one byte: the states are fewer than 128, as there are 16 dyes."""
    from nbtlib import ByteArray

    return ByteArray(build.blocks.ravel())


def _entities(build: BlockBox) -> Iterator[tuple[dict[str, DataTree], dict[str, DataTree]]]:
    """The id and place of each banner, and the game's own keys of its block entity."""
    from nbtlib import IntArray

    for place, banner in build.banners.items():
        inner = block_entity(banner)
        yield {"Id": inner.pop("id"), "Pos": IntArray(place)}, inner
