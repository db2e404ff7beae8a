"""Files of placed blocks, made by nbtlib and the formats' own definitions for the tests."""

import gzip
import io
import struct
import zlib
from pathlib import Path

import lz4.block
import nbtlib
from nbtlib import Byte, ByteArray, Compound, Int, IntArray, List, LongArray, Short, String

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.patterns import PATTERNS

RED = Banner("red", (Layer("creeper", "yellow"), Layer("border", "black")))
LIME = Banner("lime", (Layer("globe", "white"),))
PLAIN = Banner("blue")
SHIELD = Banner("cyan", (Layer("skull", "white"),), kind="shield")


def tag(tree):
    """A plain tree as nbtlib's tags: ints as TAG_Int, lists by their first entry."""
    if isinstance(tree, nbtlib.Base):
        return tree
    if isinstance(tree, dict):
        return Compound({key: tag(value) for key, value in tree.items()})
    if isinstance(tree, list):
        return List([tag(value) for value in tree])
    return String(tree) if isinstance(tree, str) else Int(tree)


def raw_nbt(tree: dict, order: str = "big", name: str = "") -> bytes:
    out = io.BytesIO()
    # A file is the one entry of a compound, without the tag that would close the compound.
    nbtlib.Compound({name: tag(tree)}).write(out, order)
    return out.getvalue()[:-1]


def parse_nbt(data: bytes, order: str = "big") -> Compound:
    """The root of a file, by nbtlib."""
    raw = gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data
    (root,) = Compound.parse(io.BytesIO(raw + b"\0"), order).values()
    return root


def nbt_file(tree: dict, name: str = "") -> bytes:
    return gzip.compress(raw_nbt(tree, name=name), mtime=0)


def new_layers(banner: Banner) -> list:
    return [{"pattern": f"minecraft:{x.pattern}", "color": x.dye} for x in banner.layers]


def old_layers(banner: Banner, inverted: bool = False) -> list:
    return [
        {
            "Pattern": PATTERNS[layer.pattern].code,
            "Color": 15 - DYES[layer.dye].number if inverted else DYES[layer.dye].number,
        }
        for layer in banner.layers
    ]


def entity(banner: Banner, era: str = "1.20.5") -> dict:
    """A banner's block entity without its place, as of 1.20.5, 1.13 or 1.12."""
    if era == "1.12":
        base = 15 - DYES[banner.base].number
        layers = old_layers(banner, inverted=True)
        return {"id": "minecraft:banner", "Base": base, "Patterns": layers}
    if era == "1.13":
        return {"id": "minecraft:banner", "Patterns": old_layers(banner)}
    return {"id": "minecraft:banner", "patterns": new_layers(banner)}


def item(banner: Banner) -> dict:
    components = {"minecraft:banner_patterns": new_layers(banner)}
    name = "shield" if banner.kind == "shield" else f"{banner.base}_banner"
    if banner.kind == "shield":
        components["minecraft:base_color"] = banner.base
    return {"id": f"minecraft:{name}", "count": 1, "components": components}


def chest(*banners: Banner) -> dict:
    items = [{**item(banner), "Slot": Byte(n)} for n, banner in enumerate(banners)]
    return {"id": "minecraft:chest", "Items": items}


def block_id(banner: Banner, wall: bool = False) -> str:
    return f"minecraft:{banner.base}_wall_banner" if wall else f"minecraft:{banner.base}_banner"


def structure(blocks: dict[tuple, tuple[str, dict | None]], entities: list = ()) -> dict:
    """A structure of (id, block entity or None) by place."""
    names = list(dict.fromkeys(name for name, _ in blocks.values()))
    return {
        "DataVersion": 3953,
        "size": [9, 9, 9],
        "palette": [{"Name": name} for name in names],
        "blocks": [
            {"pos": list(place), "state": names.index(name), **({"nbt": nbt} if nbt else {})}
            for place, (name, nbt) in blocks.items()
        ],
        "entities": list(entities),
    }


def varints(numbers: list[int]) -> bytes:
    out = bytearray()
    for number in numbers:
        while number > 127:
            out.append(number & 127 | 128)
            number >>= 7
        out.append(number)
    return bytes(out)


def schem(
    version: int, size: tuple, blocks: dict[tuple, tuple[str, dict | None]], padding: int = 1
):
    """A Sponge schematic. padding: states before the used ones, so that varints grow."""
    width, height, length = size
    names = [f"minecraft:filler_{n}" for n in range(padding)]
    names += dict.fromkeys(name for name, _ in blocks.values())
    numbers = [
        names.index(blocks[x, y, z][0]) if (x, y, z) in blocks else (x + y + z) % padding
        for y in range(height)
        for z in range(length)
        for x in range(width)
    ]
    palette = {f"{name}[rotation=4]": n for n, name in enumerate(names)}
    data = ByteArray(list(memoryview(varints(numbers)).cast("b")))
    entities = []
    for place, (_, nbt) in blocks.items():
        if nbt:
            nbt = dict(nbt)
            head = {"Id": nbt.pop("id"), "Pos": IntArray(place)}
            entities.append(head | ({"Data": nbt} if version == 3 else nbt))
    root = {
        "Version": version,
        "Width": Short(width),
        "Height": Short(height),
        "Length": Short(length),
    }
    if version == 3:
        inner = {"Palette": palette, "Data": data, "BlockEntities": entities}
        return {"Schematic": root | {"Blocks": inner}}
    key = "TileEntities" if version == 1 else "BlockEntities"
    return root | {"Palette": palette, "BlockData": data, key: entities}


def mcedit(size: tuple, banner: Banner, place: tuple) -> dict:
    """A schematic of MCEdit, full of standing banners of which one has a block entity."""
    count = size[0] * size[1] * size[2]
    return {
        **dict(zip(("Width", "Height", "Length"), map(Short, size), strict=True)),
        "Materials": "Alpha",
        "Blocks": ByteArray([-80] * count),
        "Data": ByteArray([0] * count),
        "TileEntities": [entity(banner, "1.12") | dict(zip("xyz", place, strict=True))],
    }


def packed(numbers: list[int], bits: int, spanning: bool) -> LongArray:
    """Palette indices in longs, by one big integer: spanning, or whole indices a long."""
    per_long = 64 // bits
    if spanning:
        stream = sum(number << bits * n for n, number in enumerate(numbers))
        longs = [stream >> 64 * n & 2**64 - 1 for n in range(-(-len(numbers) * bits // 64))]
    else:
        longs = [
            sum(number << bits * n for n, number in enumerate(numbers[at : at + per_long]))
            for at in range(0, len(numbers), per_long)
        ]
    return LongArray([long - 2**64 if long >> 63 else long for long in longs])


def litematic(size: tuple, position: tuple, blocks: dict, padding: int = 1) -> dict:
    """A Litematica schematic of one box; places count from its least corner."""
    width, height, length = map(abs, size)
    names = [f"minecraft:filler_{n}" for n in range(padding)]
    names += dict.fromkeys(name for name, _ in blocks.values())
    numbers = [
        names.index(blocks[x, y, z][0]) if (x, y, z) in blocks else (x * y + z) % padding
        for y in range(height)
        for z in range(length)
        for x in range(width)
    ]
    bits = max(2, (len(names) - 1).bit_length())
    region = {
        "Size": dict(zip("xyz", size, strict=True)),
        "Position": dict(zip("xyz", position, strict=True)),
        "BlockStatePalette": [{"Name": name} for name in names],
        "BlockStates": packed(numbers, bits, spanning=True),
        "TileEntities": [
            {**nbt, **dict(zip("xyz", place, strict=True))}
            for place, (_, nbt) in blocks.items()
            if nbt
        ],
    }
    return {"MinecraftDataVersion": 3953, "Version": 7, "Regions": {"hut": region}}


def section(blocks: dict[tuple, str], padding: int, spanning: bool) -> tuple[list, LongArray]:
    """A section's palette and indices, of ids by place within it."""
    names = [f"minecraft:filler_{n}" for n in range(padding)]
    names += dict.fromkeys(blocks.values())
    numbers = [
        names.index(blocks[x, y, z]) if (x, y, z) in blocks else (x + z) % padding
        for y in range(16)
        for z in range(16)
        for x in range(16)
    ]
    bits = max(4, (len(names) - 1).bit_length())
    return [{"Name": name} for name in names], packed(numbers, bits, spanning)


def chunk(era: str, blocks: dict[tuple, tuple[str | None, dict]], padding: int = 5) -> dict:
    """A chunk of 1.12, 1.13, 1.16 or 1.18: (id, block entity) by place in the world."""
    heights = sorted({y >> 4 for _, y, _ in blocks})
    sections, ids = [], {place: name for place, (name, _) in blocks.items() if name}
    for height in heights:
        local = {(x & 15, y & 15, z & 15): n for (x, y, z), n in ids.items() if y >> 4 == height}
        palette, longs = section(local, padding, spanning=era == "1.13")
        if era == "1.12":
            part = {"Blocks": ByteArray([-80] * 4096), "Data": ByteArray([0] * 2048)}
        elif era == "1.18":
            part = {"block_states": {"palette": palette, "data": longs}}
        else:
            part = {"Palette": palette, "BlockStates": longs}
        sections.append({"Y": Byte(height), **part})
    entities = [
        {**nbt, **dict(zip("xyz", place, strict=True))} for place, (_, nbt) in blocks.items()
    ]
    if era == "1.18":
        return {"DataVersion": 3953, "sections": sections, "block_entities": entities}
    return {"Level": {"Sections": sections, "TileEntities": entities}}


def lz4_blocks(data: bytes, size: int = 1 << 16) -> bytes:
    """What lz4-java writes; the checksums are left at 0."""
    head = struct.Struct("<8sBiii")
    pieces = []
    for start in range(0, len(data), size):
        piece = data[start : start + size]
        packed = lz4.block.compress(piece, store_size=False)
        pieces += [head.pack(b"LZ4Block", 0x26, len(packed), len(piece), 0), packed]
    return b"".join([*pieces, head.pack(b"LZ4Block", 0x16, 0, 0, 0)])


PACKERS = {1: gzip.compress, 2: zlib.compress, 3: bytes, 4: lz4_blocks}


def region(chunks: dict[tuple[int, int], dict | bytes], kind: int = 2) -> bytes:
    """A region file of chunks by their place in it; bytes are put in as they are."""
    places, body = bytearray(4096), bytearray()
    for (x, z), tree in chunks.items():
        packed_chunk = tree if isinstance(tree, bytes) else PACKERS[kind](raw_nbt(tree))
        if not isinstance(tree, bytes):
            packed_chunk = struct.pack(">IB", len(packed_chunk) + 1, kind) + packed_chunk
        sectors = -(-len(packed_chunk) // 4096)
        number = (x & 31) + (z & 31) * 32
        places[4 * number : 4 * number + 4] = struct.pack(
            ">I", (2 + len(body) // 4096) << 8 | sectors
        )
        body += packed_chunk.ljust(sectors * 4096, b"\0")
    return bytes(places) + bytes(4096) + bytes(body)


def bedrock_entity(banner: Banner, ominous: bool = False) -> dict:
    base = 15 - DYES[banner.base].number
    layers = old_layers(banner, inverted=True)
    return {"id": "Banner", "Base": base, "Patterns": layers, "Type": int(ominous)}


def mcstructure(size: tuple, entities: dict[tuple, dict]) -> dict:
    """A Bedrock structure of block entities by place."""
    _, height, length = size
    data = {
        str((x * height + y) * length + z): {"block_entity_data": nbt}
        for (x, y, z), nbt in entities.items()
    }
    return {
        "format_version": 1,
        "size": list(size),
        "structure": {
            "block_indices": [[0] * 9, [-1] * 9],
            "entities": [],
            "palette": {"default": {"block_palette": [], "block_position_data": data}},
        },
        "structure_world_origin": [0, 0, 0],
    }


def blueprint(size: tuple, blocks: dict[tuple, tuple[str, dict | None]]) -> dict:
    """A blueprint of (id, block entity or None) by place."""
    width, height, length = size
    names = ["minecraft:air", *dict.fromkeys(name for name, _ in blocks.values())]
    indices = [0] * (width * height * length + width * height * length % 2)
    for (x, y, z), (name, _) in blocks.items():
        indices[(y * length + z) * width + x] = names.index(name)
    pairs = zip(indices[::2], indices[1::2], strict=True)
    entities = [
        nbt | {axis: nbtlib.Short(at) for axis, at in zip("xyz", place, strict=True)}
        for place, (_, nbt) in blocks.items()
        if nbt
    ]
    return {
        "version": nbtlib.Byte(1),
        **{f"size_{axis}": nbtlib.Short(n) for axis, n in zip("xyz", size, strict=True)},
        "palette": [{"Name": name} for name in names],
        "blocks": nbtlib.IntArray([high << 16 | low for high, low in pairs]),
        "tile_entities": entities,
        "entities": [],
    }


def save(path: Path, data: bytes) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)
    return path


RED_CHUNK = chunk("1.18", {(48, 71, 9): (block_id(RED), entity(RED))})


def make_world(folder: Path) -> None:
    """Write a world with banners in two dimensions and in what players carry."""
    chunks = region({(3, 0): RED_CHUNK})
    save(folder / "level.dat", nbt_file({"Data": {"Player": {"Item": item(LIME)}}}))
    save(folder / "region" / "r.0.0.mca", chunks)
    save(folder / "region" / "r.-1.0.mca", b"")
    save(folder / "DIM-1" / "region" / "r.0.0.mca", chunks)
    save(folder / "dimensions" / "a" / "b" / "entities" / "r.0.0.mca", chunks)
    save(folder / "poi" / "r.0.0.mca", b"not read")
    save(folder / "playerdata" / "x.dat", nbt_file({"Inventory": [item(SHIELD)]}))
    save(folder / "playerdata" / "x.dat_old", b"not read")
