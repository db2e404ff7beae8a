"""What players hold and wear beside cloth: a banner on the head, a shield, armour with trims."""

import json

import numpy as np
import pytest

from drapery import Banner, draw
from drapery.cloth import Box
from drapery.errors import OptionError, PackError
from drapery.garments import dressed_player, make_wearer, tailor
from drapery.packs import MemoryPack, open_packs
from drapery.scenes import Dressed, Schedule
from drapery.settings import Settings
from drapery.style.equipment import armor_on, banner_pole, parse_armor, shield_in_hand
from drapery.style.figure import PARTS, TEXEL
from drapery.style.skins import SLIM_PARTS

NONE = open_packs(())
STAND = {"motion": "stand"}


def plain(*rgba: int, width: int = 64, height: int = 32) -> np.ndarray:
    return np.full((height, width, 4), rgba, np.uint8)


def armor_pack() -> MemoryPack:
    """Armour of one colour for each texture, and a trim with a palette of two tones."""
    trim = plain(0, 0, 0, 0)
    trim[20:26, 20:28] = (200, 200, 200, 255)
    trim[26:32, 20:28] = (100, 100, 100, 255)
    key, gold, dark = (
        np.array([[(*tone, 255) for tone in tones]], np.uint8)
        for tones in (
            ((200, 200, 200), (100, 100, 100)),
            ((250, 220, 80), (180, 130, 20)),
            ((90, 80, 30), (40, 30, 10)),
        )
    )
    layers = "minecraft:entity/equipment/humanoid"
    return MemoryPack(
        textures={
            f"{layers}/diamond": plain(80, 230, 220, 255),
            f"{layers}_leggings/diamond": plain(30, 90, 200, 255),
            "minecraft:models/armor/iron_layer_1": plain(220, 220, 220, 255),
            f"{layers}/gold": plain(240, 200, 60, 255),
            f"{layers}/leather": plain(255, 255, 255, 255),
            f"{layers}/leather_overlay": plain(9, 9, 9, 0),
            "minecraft:trims/entity/humanoid/coast": trim,
            "minecraft:trims/entity/humanoid_leggings/coast": plain(0, 0, 0, 0),
            "minecraft:trims/color_palettes/trim_palette": key,
            "minecraft:trims/color_palettes/gold": gold,
            "minecraft:trims/color_palettes/gold_darker": dark,
        }
    )


ARMED = open_packs(armor_pack())


def texels(mesh: object) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest corner of a mesh [texels]."""
    positions = mesh.positions / TEXEL  # type: ignore[attr-defined]
    return positions.min(axis=0), positions.max(axis=0)


def test_a_banner_on_the_head_has_the_size_and_place_of_the_game() -> None:
    player = dressed_player(make_wearer(head="red creeper:lime", **STAND))
    (flag,) = Dressed(player, NONE, Settings()).cloths
    low, high = flag.start.min(axis=0) / TEXEL, flag.start.max(axis=0) / TEXEL
    np.testing.assert_allclose(low, [-6.25, 33, -3.4375], atol=1e-9)
    np.testing.assert_allclose(high, [6.25, 58, -3.4375], atol=1e-9)
    low, high = texels(banner_pole(NONE).mesh)
    np.testing.assert_allclose(low, [-6.25, 30.5, -5], atol=1e-9)
    np.testing.assert_allclose(high, [6.25, 58, -3.75], atol=1e-9)


def test_the_flag_on_a_head_stays_before_its_pole() -> None:
    player = dressed_player(make_wearer(head="red", motion="walk", speed=3.0))
    dressed = Dressed(player, NONE, player.settings(wind=3.0))
    (flag,) = dressed.cloths
    (positions,) = dressed.record(Schedule.at([0.4], dressed.step))
    middle = positions[0].reshape(17, 9, 3)[:, 3:6]
    place, turn = dressed.wearer.poses(0.4)["head"]  # type: ignore[union-attr]
    at_rest = ((middle - place) @ turn) / TEXEL
    assert (at_rest[:, 1, 2] > -3.75 - 1e-6).all()
    assert flag.solid == ("head", "pole", "bar")


@pytest.mark.parametrize(("arms", "shift"), [("classic", 0.0), ("slim", -0.5)])
def test_a_shield_is_outside_the_left_hand_with_its_design_outwards(
    arms: str, shift: float
) -> None:
    parts = SLIM_PARTS if arms == "slim" else PARTS
    plate, handle = shield_in_hand(Banner("white"), NONE, parts)
    low, high = texels(plate.mesh)
    # 22 texels to the front, 12 upright, one thick, outside the arm, which ends at 8 or 7.
    np.testing.assert_allclose(high - low, [1, 12, 22], atol=1e-9)
    assert low[0] == pytest.approx(9 + shift)
    outer = plate.mesh.normals[:4]  # the front of the plate
    np.testing.assert_allclose(outer, np.tile([1.0, 0, 0], (4, 1)), atol=1e-12)
    inner, hand = texels(handle.mesh)[0], parts["left_arm"].centre / TEXEL
    assert inner[0] < hand[0] + 2 and plate.bone == handle.bone == "left_arm"


def test_cloth_begins_behind_a_shield_which_stops_it() -> None:
    player = dressed_player(make_wearer(shield="white", **STAND), wear=("cape", "poncho"))
    dressed = Dressed(player, NONE, player.settings())
    plate = np.array([1, 12, 22]) * TEXEL
    stopped = [
        any(isinstance(c.shape, Box) and np.allclose(c.shape.size, plate) for c in met)
        for met in map(dressed.colliders, dressed.cloths)
    ]
    assert stopped == [True, True]
    poncho = dressed.cloths[1].start / TEXEL
    assert poncho[:, 0].max() < 9 and poncho[:, 0].min() < -10  # the plate is from 9 to 10


def test_armour_stands_off_the_body_by_the_texels_of_the_game() -> None:
    worn = armor_on("diamond", None, ARMED, PARTS)
    boxes = [(each.bone, *texels(each.mesh)) for each in worn]
    assert [bone for bone, _, _ in boxes] == [
        *("head", "head", "body", "right_arm", "left_arm"),
        *("body", "right_leg", "left_leg", "right_leg", "left_leg"),
    ]
    grown = [1, 1.5, 1, 1, 1, 0.5, 0.4, 0.4, 0.9, 0.9]
    for (bone, low, high), distance in zip(boxes, grown, strict=True):
        middle, extent = PARTS[bone].centre / TEXEL, PARTS[bone].extent / TEXEL
        np.testing.assert_allclose((low + high) / 2, middle, atol=1e-9)
        np.testing.assert_allclose(high - low, extent + 2 * distance, atol=1e-9)
    right, left = worn[3].mesh, worn[4].mesh
    np.testing.assert_allclose(left.positions, right.positions * [-1, 1, 1], atol=1e-12)
    assert np.array_equal(left.uvs, right.uvs)
    colours = [tuple(each.material.layers[0].texels[0, 0, :3]) for each in worn]
    assert colours == [(80, 230, 220)] * 5 + [(30, 90, 200)] * 3 + [(80, 230, 220)] * 2


def test_a_trim_has_the_tones_of_its_material() -> None:
    def chest(armor: str) -> np.ndarray:
        worn = armor_on(armor, "coast:gold", ARMED, PARTS)
        return worn[0].material.layers[0].texels

    on_iron, on_gold = chest("chestplate:iron"), chest("chestplate:gold")
    assert tuple(on_iron[22, 22]) == (250, 220, 80, 255)
    assert tuple(on_iron[30, 22]) == (180, 130, 20, 255)
    assert tuple(on_iron[22, 50]) == (220, 220, 220, 255)
    assert tuple(on_gold[22, 22]) == (90, 80, 30, 255)


def test_leather_is_brown_unless_its_overlay_covers_it() -> None:
    (boots, _) = armor_on("boots:leather", None, ARMED, PARTS)
    assert tuple(boots.material.layers[0].texels[0, 0]) == (160, 101, 64, 255)


def test_pieces_of_armour_are_chosen_one_by_one() -> None:
    assert parse_armor("helmet:iron, boots:gold") == {"helmet": "iron", "boots": "gold"}
    assert parse_armor("turtle_scute") == {"helmet": "turtle_scute"}
    assert set(parse_armor("diamond").values()) == {"diamond"}


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"armor": "mud"}, "armor 'mud' is not known; use one of: leather, chainmail"),
        ({"armor": "hat:iron"}, "armor 'hat' is not a piece; use some of: helmet, chestplate"),
        ({"armor": "iron", "trim": "coast"}, "write coast:gold"),
        ({"trim": "coast:gold"}, "trim coast:gold has no armor; add one"),
        ({"head": "purpleish"}, "purpleish"),
        ({"kind": "horse", "shield": "red"}, "shield is for players; leave it out for a horse"),
    ],
)
def test_what_cannot_be_worn_is_refused(fields: dict[str, object], said: str) -> None:
    with pytest.raises(OptionError, match=said):
        make_wearer(**fields)


def test_armour_without_a_texture_names_the_file() -> None:
    player = dressed_player(make_wearer(armor="diamond", **STAND))
    said = (
        r"armor diamond: no pack has textures/entity/equipment/humanoid/diamond.png"
        r" or textures/models/armor/diamond_layer_1.png; give one that has it, by --pack"
    )
    with pytest.raises(OptionError, match=said):
        draw(player, size=(16, 16))


def test_armour_stops_a_cape_and_other_garments_are_worn_under_it() -> None:
    player = dressed_player(make_wearer(armor="diamond", **STAND), wear=("cape", "skirt"))
    dressed = Dressed(player, ARMED, Settings())
    extents = [
        [box.shape.size[0] / TEXEL for box in dressed.wearer.colliders(sewn.solid)]  # type: ignore[union-attr]
        for sewn in dressed.cloths
    ]
    cape, skirt = extents
    assert 10 in np.round(cape, 9) and 10 not in np.round(skirt, 9)
    assert dressed.cloths[0].solid[-1] == "armor"  # type: ignore[index]


@pytest.mark.parametrize(("armor", "moved"), [("diamond", (0.85, -1.1)), ("boots:iron", (0, 0))])
def test_a_cape_hangs_behind_a_chestplate(armor: str, moved: tuple[float, float]) -> None:
    def pins(player: object) -> np.ndarray:
        (cape,) = tailor(player, NONE)  # type: ignore[arg-type]
        return cape.start[cape.cloth.inv_mass == 0] / TEXEL

    plain, armed = (
        pins(dressed_player(make_wearer(**fields, **STAND), wear=("cape",)))
        for fields in ({}, {"armor": armor})
    )
    np.testing.assert_allclose(armed - plain, np.tile([0, *moved], (len(plain), 1)), atol=1e-9)


def palette(*tones: tuple[int, int, int]) -> np.ndarray:
    return np.array([[(*tone, 255) for tone in tones]], np.uint8)


LIGHT, DARK = (200, 200, 200), (100, 100, 100)


def trimmed(
    more: dict[str, np.ndarray], contents: dict[str, bytes], armor: str = "iron"
) -> list[tuple[int, ...]]:
    """The colours of the two tones of a trim on a helmet, with the palettes of 26.3."""
    trim = plain(0, 0, 0, 0)
    trim[0, 0], trim[1, 1] = (*LIGHT, 255), (*DARK, 255)
    textures = {
        f"minecraft:entity/equipment/humanoid/{armor}": plain(9, 9, 9, 255),
        "minecraft:trims/entity/humanoid/coast": trim,
        "minecraft:trims/entity/humanoid/odd": plain(*LIGHT, 255),
        "minecraft:palettes/trim_base": palette(LIGHT, DARK),
        "minecraft:palettes/trim/gold": palette((250, 220, 80), (180, 130, 20)),
        "minecraft:palettes/trim/gold_darker": palette((90, 80, 30), (40, 30, 10)),
        "acme:palettes/blue": palette((0, 0, 250), (0, 0, 90)),
        **more,
    }
    packs = open_packs(MemoryPack(textures=textures, contents=contents))
    worn = armor_on(f"helmet:{armor}", "coast:gold", packs, PARTS)[0].material.layers[0].texels
    return [tuple(int(v) for v in worn[n, n, :3]) for n in (0, 1)]


def overrides(*entries: object, format: int = 97) -> dict[str, bytes]:
    equipment = {"layers": {}, "trim_overrides": entries}
    return {
        "assets/minecraft/equipment/iron.json": json.dumps(equipment).encode(),
        "pack.mcmeta": json.dumps({"pack": {"min_format": format, "max_format": format}}).encode(),
    }


BLUE = {"palette": "acme:blue"}


def test_palettes_are_found_where_26_3_has_them() -> None:
    assert trimmed({}, {}) == [(250, 220, 80), (180, 130, 20)]
    assert trimmed({}, {}, armor="gold") == [(90, 80, 30), (40, 30, 10)]


@pytest.mark.parametrize(
    ("entries", "format", "seen"),
    [
        ([{"when": {}, **BLUE}], 97, (0, 0, 250)),
        ([{"when": {"material": "gold"}, **BLUE}], 97, (0, 0, 250)),
        ([{"when": {"material": "minecraft:gold", "pattern": "coast"}, **BLUE}], 97, (0, 0, 250)),
        ([{"when": {"pattern": "wild"}, **BLUE}], 97, (250, 220, 80)),
        ([{"when": {"pattern": "coast"}}, {"when": {}, **BLUE}], 97, (250, 220, 80)),
        ([{"when": {}, **BLUE}], 88, (250, 220, 80)),
    ],
)
def test_equipment_overrides_the_palette_of_a_trim(
    entries: list[object], format: int, seen: tuple[int, int, int]
) -> None:
    assert trimmed({}, overrides(*entries, format=format))[0] == seen


def test_equipment_overrides_the_texture_of_a_trim() -> None:
    assert trimmed({}, overrides({"when": {}, "texture": "odd"}))[1] == (250, 220, 80)


def test_a_trim_names_its_key_palette() -> None:
    key = {"acme:palettes/key": palette(DARK, LIGHT)}
    meta = json.dumps({"palette": {"base_palette": "acme:key"}}).encode()
    named = {"assets/minecraft/textures/trims/entity/humanoid/coast.png.mcmeta": meta}
    assert trimmed(key, named) == [(180, 130, 20), (250, 220, 80)]


def test_wrong_palettes_and_overrides_name_their_files() -> None:
    short = {"minecraft:palettes/trim/gold": palette(LIGHT)}
    with pytest.raises(PackError, match=r"trim/gold\.png: its palette has 1 colour, the key has 2"):
        trimmed(short, {})
    for wrong in (3, {"when": 3}, {"when": {"pattern": 4}}, {"palette": "A b"}):
        with pytest.raises(PackError, match=r"equipment/iron\.json: trim_overrides 0"):
            trimmed({}, overrides(wrong))


@pytest.mark.parametrize("size", [(48, 24), (100, 64), (64, 64), (1, 1)])
def test_armour_and_trims_of_any_sizes_meet(size: tuple[int, int]) -> None:
    odd = plain(7, 7, 7, 255, width=size[0], height=size[1])
    assert len(trimmed({"minecraft:entity/equipment/humanoid/iron": odd}, {})) == 2
