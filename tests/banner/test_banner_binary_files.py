"""Banners in files of placed blocks, of every layout and age, each with its place."""

import re
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
import world_maker as make
from cost import limited_cost
from hypothesis import given, strategies as st
from world_maker import LIME, PLAIN, RED, SHIELD

from drapery.banner.design import Banner
from drapery.banner.formats import FoundBanner
from drapery.banner.formats.binary import BINARY_FORMS
from drapery.banner.formats.files import banners_in, find_in_bytes, is_binary
from drapery.banner.formats.lz4 import unlz4
from drapery.banner.formats.palettes import bits_for, packed_pieces, unpack, varint_pieces
from drapery.banner.formats.tree import OMINOUS
from drapery.banner.plain import read_design
from drapery.errors import DesignError

STANDING = {
    (1, 2, 3): (make.block_id(RED), make.entity(RED)),
    (4, 0, 5): (make.block_id(LIME, wall=True), make.entity(LIME)),
    (0, 0, 0): ("minecraft:chest", make.chest(RED, SHIELD)),
}


def found(data: bytes) -> dict[str, Banner]:
    return {one.where.removeprefix("f "): one.banner for one in find_in_bytes(data, "f")}


def in_blocks(prefix: str = "") -> dict[str, Banner]:
    return {
        f"{prefix}block 1,2,3": RED,
        f"{prefix}block 4,0,5": LIME,
        f"{prefix}block 0,0,0.Items[0]": RED,
        f"{prefix}block 0,0,0.Items[1]": SHIELD,
    }


def test_a_structure_gives_blocks_containers_and_entities():
    frame = {
        "pos": make.List[make.nbtlib.Double]([1.5, 2.5, -0.5]),
        "nbt": {"id": "minecraft:item_frame", "Item": make.item(LIME)},
    }
    bare = {(7, 7, 7): (make.block_id(PLAIN), None), (8, 7, 7): ("minecraft:stone", None)}
    data = make.nbt_file(make.structure(STANDING | bare, [frame]))
    expected = in_blocks() | {"block 7,7,7": PLAIN, "item_frame at 1,2,-1.Item": LIME}
    assert found(data) == expected


def test_a_structure_of_several_palettes_reads_by_the_first():
    tree = make.structure({(1, 2, 3): (make.block_id(RED), make.entity(RED))})
    tree["palettes"] = [tree.pop("palette"), [{"Name": "minecraft:stone"}]]
    assert found(make.nbt_file(tree)) == {"block 1,2,3": RED}


def test_an_old_structure_keeps_the_base_in_the_block_entity():
    tree = make.structure({(1, 2, 3): ("minecraft:standing_banner", make.entity(RED, "1.12"))})
    assert found(make.nbt_file(tree)) == {"block 1,2,3": RED}


@pytest.mark.parametrize("version", [1, 2, 3])
@pytest.mark.parametrize("padding", [1, 200])
def test_a_schematic_of_every_version(version: int, padding: int):
    data = make.nbt_file(make.schem(version, (6, 4, 7), STANDING, padding), "Schematic")
    assert found(data) == in_blocks()


def test_a_schematics_banner_without_a_block_entity_is_plain():
    blocks = {(5, 3, 6): (make.block_id(PLAIN), None)}
    assert found(make.nbt_file(make.schem(2, (6, 4, 7), blocks))) == {"block 5,3,6": PLAIN}


def test_the_older_schematic_with_numeric_ids():
    tree = make.mcedit((2, 1, 1), RED, (1, 0, 0))
    assert found(make.nbt_file(tree, "Schematic")) == {"block 1,0,0": RED}


@pytest.mark.parametrize("padding", [1, 3, 14, 100])
def test_a_litematica_box(padding: int):
    data = make.nbt_file(make.litematic((6, 4, 7), (0, 0, 0), STANDING, padding))
    assert found(data) == in_blocks("region 'hut' ")


def test_a_litematica_box_of_negative_size_lies_the_other_way():
    blocks = {
        (0, 0, 0): (make.block_id(RED), make.entity(RED)),
        (5, 3, 6): (make.block_id(PLAIN), None),
    }
    data = make.nbt_file(make.litematic((-6, 4, -7), (10, 20, 30), blocks))
    where = "region 'hut' block"
    assert found(data) == {f"{where} 5,20,24": RED, f"{where} 10,23,30": PLAIN}


PLACES = {
    "1.12": ((3, 70, -40), "1.12"),
    "1.13": ((3, 70, -40), "1.13"),
    "1.16": ((15, 255, 15), "1.13"),
    "1.18": ((-1, -60, 31), "1.20.5"),
}


@pytest.mark.parametrize("padding", [1, 5, 20, 40, 300])
@pytest.mark.parametrize("era", PLACES)
def test_a_chunk_of_every_version_gives_the_base_dye(era: str, padding: int):
    place, entity_era = PLACES[era]
    name = None if era == "1.12" else make.block_id(RED)
    tree = make.chunk(era, {place: (name, make.entity(RED, entity_era))}, padding)
    assert found(make.nbt_file(tree)) == {f"block {place[0]},{place[1]},{place[2]}": RED}


def test_a_section_of_one_state_has_no_indices():
    tree = make.chunk("1.18", {(0, 0, 0): (make.block_id(RED), make.entity(RED))})
    tree["sections"][0]["block_states"] = {"palette": [{"Name": make.block_id(RED)}]}
    assert found(make.nbt_file(tree)) == {"block 0,0,0": RED}


def test_banners_on_entities_are_found():
    captain = {
        "id": "minecraft:pillager",
        "Pos": make.List[make.nbtlib.Double]([1.2, 64.0, -3.7]),
        "equipment": {"head": make.item(OMINOUS)},
    }
    data = make.nbt_file({"DataVersion": 4440, "Entities": [captain], "Position": [0, 0]})
    assert found(data) == {"pillager at 1,64,-4.equipment.head": OMINOUS}


def test_a_bedrock_structure_and_its_ominous_banner():
    item = {"Name": "minecraft:banner", "Damage": 1, "Count": 1}
    entities = {
        (1, 2, 3): make.bedrock_entity(RED),
        (0, 0, 1): make.bedrock_entity(PLAIN, ominous=True),
        (2, 0, 0): {
            "id": "Chest",
            "Items": [item],
        },
    }
    data = make.raw_nbt(make.mcstructure((4, 3, 5), entities), "little")
    assert is_binary(data, len(data))
    assert found(data) == {
        "block 1,2,3": RED,
        "block 0,0,1": OMINOUS,
        "block 2,0,0.Items[0]": Banner("red"),
    }


def test_a_blueprint_gives_blocks_and_containers():
    bare = {(7, 2, 1): (make.block_id(PLAIN), None)}
    tree = make.blueprint((9, 5, 7), STANDING | bare)
    assert found(make.nbt_file(tree)) == in_blocks() | {"block 7,2,1": PLAIN}
    with pytest.raises(DesignError, match="f: blocks is a list of 1, not an array of ints"):
        found(make.nbt_file(tree | {"blocks": [{"x": 1}]}))
    with pytest.raises(DesignError, match="palette is not a list of block states"):
        found(make.nbt_file(tree | {"palette": {}}))


def test_a_players_file_is_searched_as_a_whole():
    data = make.nbt_file({"Inventory": [make.item(RED)], "EnderItems": [make.item(SHIELD)]})
    assert found(data) == {"f.Inventory[0]": RED, "f.EnderItems[0]": SHIELD}


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
def test_a_region_names_chunk_and_block(tmp_path: Path, kind: int):
    chunks = {
        (3, -1): make.chunk("1.18", {(48, 71, -9): (make.block_id(RED), make.entity(RED))}),
        (31, -32): make.chunk("1.13", {(500, 5, -510): ("minecraft:chest", make.chest(SHIELD))}),
        (0, -5): {"sections": [], "note": "nothing"},
    }
    path = make.save(tmp_path / "r.0.-1.mca", make.region(chunks, kind))
    assert {one.where: one.banner for one in banners_in(path)} == {
        "r.0.-1.mca chunk 3,-1 block 48,71,-9": RED,
        "r.0.-1.mca chunk 31,-32 block 500,5,-510.Items[0]": SHIELD,
    }


LIME_CHUNK = make.chunk("1.18", {(64, 71, 9): (make.block_id(LIME), make.entity(LIME))})


def test_a_broken_chunk_does_not_hide_the_others(tmp_path: Path):
    broken = struct.pack(">IB", 99, 2) + b"x\x9c" + bytes(97)
    path = make.save(tmp_path / "r.0.0.mca", make.region({(3, 0): broken, (4, 0): LIME_CHUNK}))
    errors: list[DesignError] = []
    assert [one.banner for one in banners_in(path, errors.append)] == [LIME]
    assert len(errors) == 1 and "r.0.0.mca chunk 3,0: " in str(errors[0])
    with pytest.raises(DesignError, match=r"chunk 3,0: broken compressed data"):
        list(banners_in(path))


@pytest.mark.parametrize(("kind", "name"), [(9, "unknown"), (127, "one of a mod's own")])
def test_an_unknown_compression_is_named(tmp_path: Path, kind: int, name: str):
    chunk = struct.pack(">IB", 50, kind) + bytes(49)
    path = make.save(tmp_path / "r.0.0.mca", make.region({(3, 0): chunk}))
    with pytest.raises(DesignError, match=rf"chunk 3,0: .*method {kind} \({name}\)"):
        list(banners_in(path))


def test_a_stream_of_lz4_blocks_is_unwrapped_and_what_is_broken_named():
    text = bytes(range(256)) * 999
    packed = make.PACKERS[4](text)
    assert unlz4(packed, "f", len(text)) == text
    raw = struct.pack("<8sBiii", b"LZ4Block", 0x16, 3, 3, 0) + b"abc"
    end = struct.pack("<8sBiii", b"LZ4Block", 0x16, 0, 0, 0)
    assert unlz4(raw + packed, "f", len(text) + 3) == b"abc" + text
    for data, fault in (
        (packed[:-1], "cut off"),
        (packed[:30], "broken LZ4 data"),
        (b"x" + packed, "no LZ4 block at byte 0"),
        (raw[:-1] + end + end, "no LZ4 block at byte 24"),
        (raw[:-1], "of 3 bytes has 2"),
        (struct.pack("<8sBiii", b"LZ4Block", 0x26, 9, -1, 0), "no LZ4 block"),
        (struct.pack("<8sBiii", b"LZ4Block", 0x26, 9, 2**31 - 1, 0), "over"),
    ):
        with pytest.raises(DesignError, match=fault):
            unlz4(data, "f", len(text))


def test_a_chunk_too_large_for_a_region_has_its_own_file(tmp_path: Path):
    data = make.region({(3, 0): struct.pack(">IB", 1, 0x82)})
    path = make.save(tmp_path / "r.0.0.mca", data)
    with pytest.raises(DesignError, match=r"c\.3\.0\.mcc is missing"):
        list(banners_in(path))
    make.save(tmp_path / "c.3.0.mcc", make.PACKERS[2](make.raw_nbt(make.RED_CHUNK)))
    assert [one.banner for one in banners_in(path)] == [RED]


def test_a_world_gives_the_banners_of_all_its_dimensions_and_players(tmp_path: Path):
    make.make_world(tmp_path)
    block = "chunk 3,0 block 48,71,9"
    assert [(one.where, one.banner) for one in banners_in(tmp_path)] == [
        ("level.dat.Data.Player.Item", LIME),
        (f"DIM-1/region/r.0.0.mca {block}", RED),
        (f"dimensions/a/b/entities/r.0.0.mca {block}", RED),
        ("playerdata/x.dat.Inventory[0]", SHIELD),
        (f"region/r.0.0.mca {block}", RED),
    ]


def test_links_out_of_a_world_are_not_followed(tmp_path: Path):
    make.make_world(tmp_path / "other")
    world = tmp_path / "world"
    make.save(world / "level.dat", make.nbt_file({"Data": {}}))
    (world / "region").symlink_to(tmp_path / "other" / "region")
    (world / "DIM1").mkdir()
    (world / "DIM1" / "r.0.0.mca").symlink_to(tmp_path / "other" / "region" / "r.0.0.mca")
    own_file = make.region({(3, 0): struct.pack(">IB", 1, 0x82)})
    make.save(world / "DIM2" / "r.0.0.mca", own_file)
    (world / "DIM2" / "c.3.0.mcc").symlink_to(tmp_path / "other" / "level.dat")
    errors: list[DesignError] = []
    assert list(banners_in(world, errors.append)) == []
    assert len(errors) == 1 and "c.3.0.mcc is missing" in str(errors[0])


def test_files_are_recognised_by_their_bytes(tmp_path: Path):
    schematic = make.nbt_file(make.schem(3, (6, 4, 7), STANDING))
    region = make.region({(3, 0): make.RED_CHUNK})
    assert len(list(banners_in(make.save(tmp_path / "one.txt", schematic)))) == 4
    assert len(list(banners_in(make.save(tmp_path / "two.bin", region)))) == 1
    for text in (b"\n/give @p red_banner", b"{}", b"planetminecraft.com/banner/?b=b1f", b""):
        assert not is_binary(text, len(text))


@pytest.mark.parametrize(
    ("name", "data", "place"),
    [
        ("a.zip", b"PK\x03\x04" + bytes(99), "a.zip: a zip file; unpack it"),
        ("a.nbt", b"", "a.nbt: an empty file"),
        ("a.nbt", b"hello", "a.nbt: neither NBT nor a region"),
        ("r.0.0.mca", b"hello", "r.0.0.mca: cut off: 5 bytes"),
        (
            "r.0.0.mca",
            struct.pack(">I", 0x00FFFF01).ljust(4096, b"\0"),
            "there is no chunk at byte",
        ),
    ],
)
def test_files_that_are_none_are_refused_by_name(
    tmp_path: Path, name: str, data: bytes, place: str
):
    with pytest.raises(DesignError, match=place):
        list(banners_in(make.save(tmp_path / name, data)))


def test_the_error_for_a_bedrock_world_names_the_remedy(tmp_path: Path):
    make.save(tmp_path / "db" / "CURRENT", b"MANIFEST-000001")
    with pytest.raises(DesignError, match=r"world of Bedrock Edition.*structure block"):
        list(banners_in(tmp_path))


def test_a_bomb_in_every_chunk_goes_off_in_none(tmp_path: Path):
    bomb = zlib.compress(make.raw_nbt({"a": "x"}) + bytes(15 * 2**20), 9)
    chunk = struct.pack(">IB", len(bomb) + 1, 2) + bomb
    region = make.region({(n, z): chunk for n in range(32) for z in range(4)})
    path = make.save(tmp_path / "r.0.0.mca", region)
    errors: list[DesignError] = []
    with limited_cost():
        assert list(banners_in(path, errors.append)) == []
    assert len(errors) == 1 and "MiB unpacked" in str(errors[0])


def test_a_chunk_of_nothing_but_banners_is_too_much(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("drapery.banner.formats.region.MAX_BANNERS", 20)
    blocks = {(n % 16, n // 16, 0): (make.block_id(RED), make.entity(RED)) for n in range(40)}
    chunk = make.chunk("1.18", blocks)
    path = make.save(tmp_path / "r.0.0.mca", make.region({(0, 0): chunk, (1, 0): make.RED_CHUNK}))
    errors: list[DesignError] = []
    assert len(list(banners_in(path, errors.append))) == 21
    assert [str(error) for error in errors] == [
        "r.0.0.mca chunk 0,0: over 20 banners; split the chunk in two worlds"
    ]


def test_a_chunk_that_a_thousand_places_list_is_read_once(tmp_path: Path):
    blocks = {(n, 1, 0): (make.block_id(RED), make.entity(RED)) for n in range(16)}
    region = bytearray(make.region({(0, 0): make.chunk("1.18", blocks)}))
    assert len(region) == 12288
    region[4:4096] = region[:4] * 1023
    path = make.save(tmp_path / "r.0.0.mca", bytes(region))
    errors: list[DesignError] = []
    with limited_cost():
        assert [one.banner for one in banners_in(path, errors.append)] == [RED] * 16
    assert len(errors) == 1023
    assert str(errors[0]).startswith("r.0.0.mca chunk 1,0: overlaps chunk 0,0 at byte")


@pytest.mark.parametrize("name", ["r.--5.0.mca", "r.-.0.mca", "r.٣.0.mca", "r.²-1.0.mca"])
def test_regions_of_any_name_are_read(tmp_path: Path, name: str):
    make.make_world(tmp_path)
    path = make.save(tmp_path / "region" / name, make.region({(0, 0): make.RED_CHUNK}))
    make.save(tmp_path / "notes.--5.txt", b"x")
    assert [one.banner for one in banners_in(path)] == [RED]
    places = [one.where for one in banners_in(tmp_path)]
    assert any(place.startswith(f"region/{name} chunk") for place in places)


def test_a_schematic_of_nothing_but_banners_is_too_much():
    size = (2000, 1, 1000)
    tree = make.schem(2, (1, 1, 1), {(0, 0, 0): (make.block_id(RED), None)}, padding=0)
    sides = {"Width": make.Short(size[0]), "Length": make.Short(size[2])}
    tree |= sides | {"BlockData": make.ByteArray([0] * size[0] * size[2])}
    with pytest.raises(DesignError, match="over 100000 banners"):
        found(make.nbt_file(tree))


def test_folders_without_a_world_and_missing_paths_are_refused(tmp_path: Path):
    with pytest.raises(DesignError, match="not a world"):
        list(banners_in(tmp_path))
    with pytest.raises(DesignError, match="no such file"):
        list(banners_in(tmp_path / "nowhere"))


def test_one_bad_banner_does_not_hide_the_others():
    bad = make.entity(RED) | {"patterns": make.new_layers(RED) * 9}
    tree = make.structure(STANDING | {(9, 9, 9): (make.block_id(RED), bad)})
    errors: list[DesignError] = []
    assert len(list(find_in_bytes(make.nbt_file(tree), "f", errors.append))) == 4
    assert len(errors) == 1 and str(errors[0]).startswith("f block 9,9,9.patterns: 18 layers")


BROKEN = {
    "blocks": {"palette": [], "blocks": 3},
    "pos": {"palette": [{"Name": "minecraft:red_banner"}], "blocks": [{"state": 0, "pos": "x"}]},
    "an array where a position should be": {
        "palette": [{"Name": "minecraft:red_banner"}],
        "blocks": [{"state": 0, "pos": make.LongArray([7] * 9999)}],
    },
    "Palette": {"Width": 1, "Height": 1, "Length": 1, "Palette": 3},
    "BlockStates": {
        "Regions": {
            "a": {
                "Size": {"x": 99, "y": 99, "z": 99},
                "Position": {"x": 0, "y": 0, "z": 0},
                "BlockStatePalette": [{"Name": "minecraft:red_banner"}] * 3,
                "BlockStates": make.LongArray([1, 2, 3, 4, 5]),
            }
        }
    },
    "Regions": {"Regions": {"a": 3}},
    "block_entities": {"sections": [], "block_entities": [{"id": "minecraft:banner"}]},
    "size": {"structure_world_origin": [0, 0, 0], "structure": {}},
}


@pytest.mark.parametrize("name", BROKEN)
def test_layouts_with_wrong_parts_are_refused(name: str):
    with pytest.raises(DesignError) as caught:
        found(make.nbt_file(BROKEN[name]))
    message = str(caught.value)
    assert message.startswith("f") and "\n" not in message and len(message) < 200


@given(st.integers(2, 15), st.booleans(), st.data())
def test_unpacking_undoes_packing(bits: int, spanning: bool, data):
    numbers = data.draw(st.lists(st.integers(0, 2**bits - 1), min_size=1, max_size=200))
    longs = np.array(make.packed(numbers, bits, spanning), np.int64)
    places = np.arange(len(numbers))
    assert unpack(longs, bits, places, spanning).tolist() == numbers
    if spanning:
        pieces = [values for _, values in packed_pieces(longs, bits, len(numbers))]
        assert np.concatenate(pieces).tolist() == numbers


@given(st.lists(st.integers(0, 2**31 - 1) | st.integers(0, 300), max_size=200))
def test_reading_varints_undoes_writing_them(numbers: list[int]):
    pieces = [values for _, values in varint_pieces(make.varints(numbers), "f")]
    assert np.concatenate([np.array([], int), *pieces]).tolist() == numbers


def test_long_arrays_are_read_in_pieces_that_join(monkeypatch: pytest.MonkeyPatch):
    from drapery.banner.formats import palettes

    monkeypatch.setattr(palettes, "PIECE", 64)
    numbers = [(7 * n * n) % 300 for n in range(1000)]
    for pieces in (
        palettes.varint_pieces(make.varints(numbers), "f"),
        palettes.packed_pieces(np.array(make.packed(numbers, 9, True), np.int64), 9, len(numbers)),
    ):
        runs = list(pieces)
        assert len(runs) > 10 and all(len(values) <= 64 for _, values in runs)
        assert [first for first, _ in runs] == [
            sum(len(values) for _, values in runs[:n]) for n in range(len(runs))
        ]
        assert np.concatenate([values for _, values in runs]).tolist() == numbers


def test_the_bits_of_an_index():
    assert [bits_for(n, 4) for n in (0, 1, 16, 17, 33, 4096)] == [4, 4, 4, 5, 6, 12]


DOCS = Path(__file__).parents[2] / "docs" / "reference" / "forms.md"
PLAYER = {"Inventory": [make.item(RED)]}
RED_BLOCK = {(1, 2, 3): (make.block_id(RED), make.entity(RED))}
SAMPLES = {
    "structure": make.nbt_file(make.structure(RED_BLOCK)),
    "schem": make.nbt_file(make.schem(2, (6, 4, 7), RED_BLOCK), "Schematic"),
    "schem3": make.nbt_file(make.schem(3, (6, 4, 7), RED_BLOCK)),
    "schematic": make.nbt_file(make.mcedit((6, 4, 7), RED, (1, 2, 3)), "Schematic"),
    "litematic": make.nbt_file(make.litematic((6, 4, 7), (0, 0, 0), RED_BLOCK)),
    "blueprint": make.nbt_file(
        make.blueprint((4, 3, 5), {(1, 2, 3): (make.block_id(RED), make.entity(RED))})
    ),
    "mcstructure": make.raw_nbt(
        make.mcstructure((4, 3, 5), {(1, 2, 3): make.bedrock_entity(RED)}), "little"
    ),
    "region": make.region(
        {(3, -1): make.chunk("1.18", {(48, 71, -9): (make.block_id(RED), make.entity(RED))})}
    ),
    "nbt": make.nbt_file(PLAYER),
}


def documented() -> list[tuple[str, str, str]]:
    row = r"^\| `([\w.-]+)` \| .* \| `(.+)` \| ([^`]+) \|$"
    return re.findall(row, DOCS.read_text("utf-8"), re.MULTILINE)


@pytest.mark.parametrize(("form", "name", "where"), documented())
def test_the_docs_say_where_a_banner_is_found(tmp_path: Path, form: str, name: str, where: str):
    path = make.save(tmp_path / name, SAMPLES[form])
    assert list(banners_in(path)) == [FoundBanner(RED, where)]
    assert read_design(path) == RED
    head = SAMPLES[form][:8192]
    # `schem3` only says which version to write.
    recognised = next(f.name for f in BINARY_FORMS.values() if f.recognises(head, name))
    assert recognised == ("schem" if form == "schem3" else form)


def test_the_docs_list_every_form_of_bytes():
    assert [form for form, _, _ in documented()] == list(BINARY_FORMS)
