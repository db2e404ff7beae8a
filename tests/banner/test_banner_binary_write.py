"""What we write as bytes: nbtlib reads it as the game would, and it comes back to itself."""

import gzip
from pathlib import Path

import nbtlib
import pytest
from conftest import Run
from hypothesis import given, strategies as st
from world_maker import LIME, PLAIN, RED, SHIELD, parse_nbt

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.formats import mcstructure, structure
from drapery.banner.formats.binary import BINARY_FORMS, BLOCK_WRITERS, BOX_WRITERS
from drapery.banner.formats.block_box import MAX_SIDE, row_of
from drapery.banner.formats.files import find_in_bytes
from drapery.banner.formats.tree import OMINOUS
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import DesignError

WRITERS = {name: form for name, form in BINARY_FORMS.items() if form.write}
DYE = st.sampled_from(DYE_NAMES)


def banners(*patterns: str):
    layers = st.builds(Layer, st.sampled_from(patterns), DYE)
    return st.builds(Banner, DYE, st.lists(layers, max_size=16).map(tuple)) | st.just(OMINOUS)


BANNERS = banners(*PATTERN_NAMES, "mod:rose/thorn")
OF_THE_GAME = banners(*PATTERN_NAMES)


@pytest.mark.parametrize("name", WRITERS)
def test_every_banner_comes_back(name: str):
    form = WRITERS[name]

    @given(OF_THE_GAME if name == "mcstructure" else BANNERS)
    def round_trip(banner: Banner):
        data = form.write(banner)
        assert [one.banner for one in form.read(data)] == [banner]
        assert [one.banner for one in find_in_bytes(data, "f")] == [banner]
        assert form.recognises(data[:64], "x" + form.suffixes[0])

    round_trip()


@given(st.lists(OF_THE_GAME, min_size=1, max_size=9))
def test_many_banners_stand_in_a_row(banners: list[Banner]):
    for ending, write in BLOCK_WRITERS.items():
        found = list(find_in_bytes(write(banners), "f"))
        assert [one.banner for one in found] == banners
        place = "f region 'banners' block" if ending == ".litematic" else "f block"
        assert [one.where for one in found] == [f"{place} {x},0,0" for x in range(len(banners))]


def test_the_same_banners_are_the_same_bytes():
    for write in BLOCK_WRITERS.values():
        assert write([RED, LIME]) == write([RED, LIME])


def test_nbtlib_reads_what_we_write():
    root = parse_nbt(structure.write([RED, PLAIN]))
    assert root["size"] == [2, 1, 1]
    assert root["palette"][1] == {
        "Name": "minecraft:blue_banner",
        "Properties": {"rotation": "0"},
    }
    assert root["blocks"][0]["nbt"]["patterns"][0] == {"pattern": "creeper", "color": "yellow"}


def root_name(data: bytes) -> str:
    """The name of the root of a compressed file."""
    raw = gzip.decompress(data)
    return raw[3 : 3 + int.from_bytes(raw[1:3])].decode()


def test_a_schematic_is_of_version_2_with_all_that_programs_ask_of_it():
    data = BOX_WRITERS["schem"](row_of([RED, PLAIN]))
    box = parse_nbt(data)
    assert root_name(data) == "Schematic"
    assert (box["Version"], box["Width"], type(box["Width"])) == (2, 2, nbtlib.Short)
    assert dict(box["Metadata"]) == {"WEOffsetX": 0, "WEOffsetY": 0, "WEOffsetZ": 0}
    assert (list(box["Offset"]), list(box["Entities"])) == ([0, 0, 0], [])
    assert list(box["Palette"]) == [
        "minecraft:air",
        "minecraft:red_banner[rotation=0]",
        "minecraft:blue_banner[rotation=0]",
    ]
    assert box["PaletteMax"] == len(box["Palette"])
    assert (type(box["BlockData"]), list(box["BlockData"])) == (nbtlib.ByteArray, [1, 2])
    first = box["BlockEntities"][0]
    assert (first["Id"], type(first["Pos"])) == ("minecraft:banner", nbtlib.IntArray)
    assert first["patterns"][0] == {"pattern": "creeper", "color": "yellow"}
    assert "id" not in first


def test_a_schematic_of_version_3_has_its_blocks_in_a_compound():
    data = BOX_WRITERS["schem3"](row_of([RED, PLAIN]))
    box = parse_nbt(data)["Schematic"]
    assert (root_name(data), box["Version"]) == ("", 3)
    assert list(box["Blocks"]["Data"]) == [1, 2]
    assert box["Blocks"]["BlockEntities"][0]["Data"]["patterns"][0]["pattern"] == "creeper"


def test_a_litematic_has_all_that_programs_ask_of_it():
    colours = [Banner.parse(name) for name in DYE_NAMES]
    root = parse_nbt(BOX_WRITERS["litematic"](row_of([RED, *colours, RED])))
    assert root["Metadata"]["EnclosingSize"] == {"x": 18, "y": 1, "z": 1}
    assert root["Metadata"]["TotalBlocks"] == root["Metadata"]["TotalVolume"] == 18
    assert type(root["Metadata"]["TimeCreated"]) is nbtlib.Long
    (box,) = root["Regions"].values()
    assert {"PendingBlockTicks", "PendingFluidTicks", "Entities", "Position"} <= box.keys()
    palette, bits = box["BlockStatePalette"], 5
    assert palette[0] == {"Name": "minecraft:air"}
    assert palette[1] == {"Name": "minecraft:red_banner", "Properties": {"rotation": "0"}}
    assert len(box["BlockStates"]) == -(-18 * bits // 64)
    stream = sum((int(long) % 2**64) << 64 * n for n, long in enumerate(box["BlockStates"]))
    numbers = [stream >> bits * place & 31 for place in range(18)]
    named = [palette[number]["Name"] for number in numbers]
    assert named == [f"minecraft:{base}_banner" for base in ("red", *DYE_NAMES, "red")]
    assert box["TileEntities"][0]["id"] == "minecraft:banner"
    assert [int(box["TileEntities"][17][axis]) for axis in "xyz"] == [17, 0, 0]


def test_a_row_of_banners_has_a_longest_length():
    with pytest.raises(DesignError, match="32768 banners do not fit"):
        row_of([RED] * (MAX_SIDE + 1))


def test_a_shield_is_an_item_and_no_block():
    data = WRITERS["nbt"].write(SHIELD)
    assert [one.banner for one in find_in_bytes(data, "f")] == [SHIELD]
    for name in ("structure", "schem", "schem3", "litematic", "mcstructure"):
        with pytest.raises(DesignError, match="shield"):
            WRITERS[name].write(SHIELD)


def test_bedrock_has_no_patterns_of_data_packs():
    with pytest.raises(DesignError, match="layer 1: Bedrock has no pattern 'mod:rose'"):
        WRITERS["mcstructure"].write(Banner("red", (Layer("mod:rose", "white"),)))


def test_bedrock_keeps_the_ominous_banner_as_a_type():
    root = parse_nbt(mcstructure.write([OMINOUS]), "little")
    entity = root["structure"]["palette"]["default"]["block_position_data"]["0"]
    assert entity["block_entity_data"]["Type"] == 1


def test_a_form_that_is_forced_must_fit():
    data = structure.write([RED])
    with pytest.raises(DesignError, match="not a Sponge schematic"):
        list(WRITERS["schem"].read(data))


@pytest.mark.parametrize(
    "name", ["a.nbt", "a.schem", "a.litematic", "a.mcstructure", "a.dat", "a.json"]
)
def test_show_writes_a_file_by_its_ending(drapery: Run, tmp_path: Path, name: str):
    assert drapery("show", "white creeper:lime", "-o", tmp_path / name)[0] == 0
    assert drapery("show", tmp_path / name, "--as", "shorthand") == (0, "white creeper:lime\n", "")


def test_show_writes_and_reads_a_form_of_bytes_by_its_name(drapery: Run, tmp_path: Path):
    (tmp_path / "empty").mkdir()
    path = tmp_path / "banner"
    assert drapery("show", "red border:black", "-o", path, "--as", "schem")[0] == 0
    assert drapery("show", path, "--from", "schem", "--as", "shorthand")[1] == "red border:black\n"
    for words, fault in (
        ((path, "--from", "litematic"), "the file is NBT but not a Litematica schematic"),
        ((path, "--from", "give"), "a binary file, which cannot be read as the form 'give'"),
        ((path, "--from", "schemm"), "did you mean 'schem'?"),
        (("white", "--from", "schem"), "this is a text; give a file"),
        (("white", "--as", "blueprint", "-o", path), "can be read but not written"),
        (("white", "-o", path.with_suffix(".schematic")), "use one of: structure, schem,"),
        (("white", "-o", path.with_suffix(".mca")), "'region' can be read but not written"),
        ((tmp_path / "empty", "--from", "nbt"), "no design in the folder"),
    ):
        code, _, said = drapery("show", *words)
        assert (code, said.count("\n")) == (2, 1)
        assert fault in said
