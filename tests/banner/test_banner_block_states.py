"""A block's state in each of its forms: every reader finds the same designs."""

import re
from collections.abc import Callable
from typing import Any

import pytest
import world_maker as make
from hypothesis import given, strategies as st
from world_maker import LIME, PLAIN, RED

from drapery.banner import Banner, parse_banners, write_banner
from drapery.banner.formats.binary import BINARY_FORMS
from drapery.banner.formats.datapack import in_folder
from drapery.banner.formats.files import find_in_bytes
from drapery.banner.formats.loot import find as find_in_json
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import state_id
from drapery.errors import DesignError

pytestmark = pytest.mark.quick

FORMS: dict[str, Callable[[str, dict[str, str]], Any]] = {
    "to 26.2": lambda name, properties: {"Name": name, "Properties": properties},
    "id alone": lambda name, properties: name,
    "id in a compound": lambda name, properties: {"": name},
    "since 26.3": lambda name, properties: {"id": name, "properties": properties},
}
"""The four forms of a state; the second and third are of states without properties."""

STANDING = {
    (1, 2, 3): (make.block_id(RED), make.entity(RED)),
    (4, 0, 5): (make.block_id(LIME, wall=True), make.entity(LIME)),
    (3, 3, 3): ("minecraft:chest", make.chest(RED)),
    (2, 3, 4): (make.block_id(PLAIN), None),
}
PROPERTIES = {"rotation": "4"}


def respelt(palette: list[dict[str, Any]], forms: list[str]) -> list[Any]:
    """The palette in these forms, as NBT holds it: a text beside compounds is in one."""
    states = [
        FORMS[forms[number % len(forms)]](state["Name"], PROPERTIES)
        for number, state in enumerate(palette)
    ]
    if all(isinstance(state, str) for state in states):
        return states
    return [{"": state} if isinstance(state, str) else state for state in states]


def structure(forms: list[str]) -> dict[str, Any]:
    tree = make.structure(STANDING)
    return tree | {"palette": respelt(tree["palette"], forms)}


def ship(forms: list[str]) -> dict[str, Any]:
    tree = structure(forms)
    return {**tree, "palettes": [tree.pop("palette")]}


def litematic(forms: list[str]) -> dict[str, Any]:
    tree = make.litematic((6, 4, 7), (0, 0, 0), STANDING)
    region = tree["Regions"]["hut"]
    region["BlockStatePalette"] = respelt(region["BlockStatePalette"], forms)
    return tree


def chunk(forms: list[str]) -> dict[str, Any]:
    blocks = {place: block for place, block in STANDING.items() if block[1]}
    blocks[2, 3, 4] = (make.block_id(PLAIN), make.entity(PLAIN))
    tree = make.chunk("1.18", blocks)
    for section in tree["sections"]:
        states = section["block_states"]
        states["palette"] = respelt(states["palette"], forms)
    return tree


def falling(forms: list[str]) -> dict[str, Any]:
    """A file of entities, in which each banner falls as a block or is shown as one."""
    names = [make.block_id(RED), make.block_id(LIME, wall=True), make.block_id(PLAIN)]
    (red, lime, plain) = (
        FORMS[forms[n % len(forms)]](name, PROPERTIES) for n, name in enumerate(names)
    )
    layers = {"id": "minecraft:falling_block", "TileEntityData": make.entity(RED)}
    return {
        "Entities": [
            layers | {"BlockState": red},
            {"id": "minecraft:falling_block", "TileEntityData": make.entity(LIME)}
            | {"BlockState": lime},
            {"id": "minecraft:block_display", "block_state": plain},
            {"id": "minecraft:chest_minecart", "Items": [make.item(RED)]},
        ]
    }


READERS = {
    "structure": structure,
    "structure of a ship": ship,
    "litematic": litematic,
    "chunk": chunk,
    "entities": falling,
}


def designs(tree: dict[str, Any]) -> list[Banner]:
    return sorted((one.banner for one in find_in_bytes(make.nbt_file(tree), "f")), key=repr)


@pytest.mark.parametrize("reader", READERS)
@given(forms=st.lists(st.sampled_from(sorted(FORMS)), min_size=1, max_size=6))
def test_a_palette_in_any_forms_gives_the_same_designs(reader: str, forms: list[str]) -> None:
    assert designs(READERS[reader](forms)) == sorted([RED, LIME, RED, PLAIN], key=repr)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("key", ["BlockState", "block_state"])
def test_a_command_that_summons_a_block(form: str, key: str) -> None:
    state = write_snbt(FORMS[form](make.block_id(RED), PROPERTIES))
    entity = write_snbt(make.entity(RED))
    text = f"/summon falling_block ~ ~ ~ {{{key}:{state},TileEntityData:{entity}}}"
    for command in (text, f"execute as @a at @s run {text}", f"return run {text}"):
        assert [one.banner for one in parse_banners(command)] == [RED]


@pytest.mark.parametrize("form", FORMS)
def test_a_rule_of_a_processor(form: str) -> None:
    state = FORMS[form](make.block_id(RED, wall=True), {"facing": "north"})
    data = {"type": "append_static", "data": make.entity(RED)}
    rule = {"output_state": state, "block_entity_modifier": data}
    found = find_in_json({"processors": [{"rules": [rule]}]})
    assert [one.banner for one in found] == [RED]


def test_a_region_and_a_file_by_its_form() -> None:
    data = make.region({(0, 0): chunk(["since 26.3", "id alone"])})
    found = BINARY_FORMS["region"].read(data)
    assert {one.banner for one in found} == {RED, LIME, PLAIN}


@pytest.mark.parametrize("form", FORMS)
def test_a_structure_in_snbt(form: str, tmp_path: Any) -> None:
    text = re.sub(r"Byte\((\d)\)", r"\1b", write_snbt(structure([form])))
    assert sorted([one.banner for one in parse_banners(text)], key=repr) == designs(
        structure([form])
    )
    file = tmp_path / "data" / "a" / "structure" / "x.snbt"
    file.parent.mkdir(parents=True)
    file.write_text(text)
    (tmp_path / "pack.mcmeta").write_text("{}")
    assert len(list(in_folder(tmp_path, pytest.fail))) == 4


def test_a_structure_as_the_game_writes_it_in_snbt() -> None:
    block = '{pos:[0,1,2],state:"minecraft:red_banner{rotation:8}",nbt:{id:"minecraft:banner"}}'
    text = f'{{size:[1,2,3],data:[{block}],palette:["minecraft:red_banner{{rotation:8}}"]}}'
    (found,) = parse_banners(text)
    assert (found.banner, found.where) == (Banner("red"), "structure block 0,1,2")


@pytest.mark.parametrize("state", [5, [], {}, {"rotation": "8"}, None, {"": {"": 5}}])
def test_what_is_no_state(state: Any) -> None:
    assert state_id(state) is None


def test_a_palette_with_another_entry_is_refused_with_its_place() -> None:
    tree = structure(["to 26.2"])
    tree["palette"][1] = {"block": "minecraft:stone"}
    with pytest.raises(DesignError, match=r"f: palette\[1\] is .* not a block's state"):
        designs(tree)


def test_a_state_alone_is_no_item() -> None:
    tree = {"stored": [{"id": "minecraft:red_banner", "properties": PROPERTIES}], "items": []}
    with pytest.raises(DesignError, match="no banner"):
        parse_banners(write_snbt(tree))


def test_a_written_command_states_the_rotation() -> None:
    assert "red_banner[rotation=0]" in write_banner(Banner("red"), "setblock")
    assert "red_banner[rotation=0]" in write_banner(RED, "block-entity")
