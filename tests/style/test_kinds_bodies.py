"""Bodies have the shape and the texels that they have in the game, and turn as in the game."""

from dataclasses import replace
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from pack_maker import png

from drapery import Banner, animate, draw
from drapery.banner.packs import open_packs
from drapery.banner.sprites import SHIELD_REGIONS, composite, shield_layers
from drapery.render.camera import Camera
from drapery.render.light import UNLIT
from drapery.render.scene import Scene
from drapery.render.soft import draw_scene
from drapery.scenes import still
from drapery.settings import Kind, Settings
from drapery.style.block import turn
from drapery.style.extrusion import THINNEST
from drapery.style.figure import CAPE_SIZE
from drapery.style.kinds import KINDS
from drapery.style.kinds.back import SHOULDERS
from drapery.style.slot import BANNER_POSE, in_slot

BANNER = Banner.parse("white creeper:lime stripe_left:red border:black")
SHIELD = replace(BANNER, kind="shield")
TOWARDS = {"south": (0, 0, 1), "west": (-1, 0, 0), "north": (0, 0, -1), "east": (1, 0, 0)}


def scene_of(design: Banner | None, **options: object) -> Scene:
    return still(design, open_packs(), Settings(**options))  # type: ignore[arg-type]


def straight_on(
    scene: Scene, centre: tuple[float, ...], height: float, size, away=5.0
) -> np.ndarray:
    """An unlit picture along -z, or from behind where `away` is negative; no perspective."""
    x, y, z = centre
    camera = Camera((x, y, z + away), (x, y, z), height=height)
    return draw_scene(replace(scene, camera=camera, size=size, light=UNLIT)).pixels


def coloured_sheet() -> np.ndarray:
    """A sheet of 64 x 32 on which every texel has its own colour."""
    row, column = np.indices((32, 64))
    return np.stack([4 * column, 8 * row, 0 * row + 90, 0 * row + 255], axis=-1).astype(np.uint8)


@pytest.fixture
def texture(tmp_path: Path) -> Path:
    (tmp_path / "cape.png").write_bytes(png(coloured_sheet()))
    return tmp_path / "cape.png"


def test_every_kind_has_a_body() -> None:
    assert set(get_args(Kind)) == {"auto", *KINDS}


@pytest.mark.parametrize("pose", ["cloth", "vanilla"])
def test_half_a_turn_is_the_mesh_turned_and_seen_from_behind(pose: str) -> None:
    before, after = (scene_of(BANNER, pose=pose, rotation=r) for r in (0, 8))
    for old, new in zip(before.models, after.models, strict=True):
        assert np.array_equal(turn(old.mesh, 180).positions, new.mesh.positions)
        across = old.mesh.positions * [-1, 1, -1] + [1, 0, 1]
        assert np.allclose(across, new.mesh.positions, atol=1e-12)
    # Half a turn about y swaps the game's two lights, so even the shades are the same.
    behind = draw(BANNER, pose=pose, view="back", size=(80, 100)).pixels
    turned = draw(BANNER, pose=pose, view="front", size=(80, 100), rotation=8).pixels
    assert (np.abs(behind.astype(int) - turned).max(axis=2) > 2).mean() < 0.002


def test_sixteen_facings_turn_from_south_over_west_and_back() -> None:
    for rotation in range(16):
        flag = scene_of(BANNER, rotation=rotation, pose="vanilla").models[1].mesh
        angle = np.radians(rotation * 22.5)
        ahead = flag.normals[0] * [1, 0, 1]
        assert np.allclose(ahead / np.linalg.norm(ahead), [-np.sin(angle), 0, np.cos(angle)])


@pytest.mark.parametrize("facing", TOWARDS)
def test_a_banner_on_a_wall_looks_away_from_it(facing: str) -> None:
    scene = scene_of(BANNER, placement="wall", facing=facing, pose="vanilla")
    assert np.allclose(scene.models[1].mesh.normals[0] * [1, 0, 1], TOWARDS[facing], atol=0.01)
    # It is at the wall behind it: the side of its block opposite to its front.
    wood = scene.models[0].mesh.positions.mean(axis=0) - [0.5, 0, 0.5]
    assert wood @ TOWARDS[facing] < -0.4


def test_an_item_lies_in_its_slot_as_the_gui_view_sees_a_block() -> None:
    block = scene_of(BANNER, pose="vanilla", time=0, view="gui")
    item = scene_of(BANNER, placement="item")
    elevation, azimuth = np.radians(30), np.radians(-20)
    right = np.array([np.cos(azimuth), 0, -np.sin(azimuth)])
    back = np.array([np.sin(azimuth), np.tan(elevation), np.cos(azimuth)]) * np.cos(elevation)
    up = np.cross(back, right)
    for free, laid in zip(block.models, item.models, strict=True):
        assert np.array_equal(in_slot(free.mesh, BANNER_POSE).positions, laid.mesh.positions)
        seen = (free.mesh.positions - 0.5) @ np.stack([right, up], axis=1) * 0.5325
        assert np.allclose(seen - [0, 3.25 / 16], laid.mesh.positions[:, :2])
        assert np.abs(laid.mesh.positions[:, :2]).max() < 0.5
    shield = scene_of(SHIELD, placement="item")
    corners = np.concatenate([model.mesh.positions for model in shield.models])
    assert np.abs(corners[:, :2]).max() < 0.5 and shield.camera == item.camera


def test_a_shields_plate_shows_its_own_texels() -> None:
    scene, packs = scene_of(SHIELD), open_packs()
    texels = composite(shield_layers(SHIELD, packs))
    middle = 0.5, 11 / 16, 0.5
    front = straight_on(scene, middle, 22 / 16, (12, 22))
    assert np.array_equal(front, SHIELD_REGIONS["front"].crop(texels))
    behind = straight_on(scene, middle, 22 / 16, (12, 22), away=-5)
    handle = np.zeros((22, 12), bool)
    handle[8:14, 5:7] = True
    back = SHIELD_REGIONS["back"].crop(texels)
    assert np.array_equal(behind[~handle], back[~handle])
    plain = shield_layers(SHIELD, packs)[0][0]
    assert np.array_equal(behind[8:14, 5:7], plain[6:12, 40:42])


def test_a_shields_handle_shows_no_design() -> None:
    plate, handle = scene_of(SHIELD).models
    assert (
        len(plate.materials[0].layers) == 2 + len(SHIELD.layers)
        and len(handle.materials[0].layers) == 1
    )
    plate, handle = scene_of(None, kind="shield").models
    plain = open_packs().base("shield_base_nopattern")
    for model in (plate, handle):
        (layer,) = model.materials[0].layers
        assert np.array_equal(layer.texels, plain)


def test_the_kind_chooses_what_a_design_is_drawn_on() -> None:
    for design, kind, same in ((BANNER, "shield", SHIELD), (SHIELD, "banner", BANNER)):
        asked = draw(design, kind=kind, size=(40, 50)).pixels
        assert np.array_equal(asked, draw(same, size=(40, 50)).pixels)


def test_a_cape_at_rest_shows_its_own_texels(texture: Path) -> None:
    scene = scene_of(None, kind="cape", texture=texture, time=0, wind=0)
    height = CAPE_SIZE[1]
    middle = 0.5, SHOULDERS[1] - height / 2, 0.5
    front = straight_on(scene, middle, height, (10, 16))
    assert np.array_equal(front, coloured_sheet()[1:17, 1:11])
    back = straight_on(scene, middle, height, (10, 16), away=-5)
    assert np.array_equal(back, coloured_sheet()[1:17, 12:22])


def test_a_cape_in_still_air_hangs_in_folds_on_shoulders_of_the_games_width(texture: Path) -> None:
    scene = scene_of(None, kind="cape", texture=texture, time=4, wind=0, thickness=0)
    places = scene.models[0].mesh.positions[: 16 * 31].reshape(31, 16, 3)
    for row in (0, 10, 20):
        chord = np.interp(places[row, :, 0], *places[row, [0, -1]][:, [0, 2]].T)
        assert np.ptp(places[row, :, 2] - chord) > 0.02
    assert np.isclose(np.ptp(places[0, :, 0]), CAPE_SIZE[0], rtol=0.01)


def test_a_cape_is_held_at_the_shoulders_and_waves(texture: Path) -> None:
    first, later = (
        scene_of(None, kind="cape", texture=texture, time=t, wind=9, thickness=0, grid=(5, 9))
        for t in (0, 3)
    )
    moved = later.models[0].mesh.positions - first.models[0].mesh.positions
    # The vertices lie half of the least thickness off the particles, along turning normals.
    assert np.allclose(moved[:5], 0, atol=THINNEST) and np.abs(moved[40:45, 2]).min() > 0.05


def test_small_sheets_of_capes_are_the_same_cape(tmp_path: Path, texture: Path) -> None:
    whole = draw(kind="cape", texture=texture, size=(40, 50)).pixels
    for width, height in ((46, 22), (22, 17)):
        path = tmp_path / f"{width}.png"
        path.write_bytes(png(coloured_sheet()[:height, :width]))
        assert np.array_equal(draw(kind="cape", texture=path, size=(40, 50)).pixels, whole)


def test_elytra_mirror_each_other_and_show_their_outside_to_the_front(tmp_path: Path) -> None:
    sheet = coloured_sheet()
    sheet[2:22, 36:46, 2] = 200
    path = tmp_path / "elytra.png"
    path.write_bytes(png(sheet))
    scene = scene_of(None, kind="elytra", texture=path)
    left, right = (model.mesh for model in scene.models)
    assert np.allclose(left.positions * [-1, 1, 1] + [1, 0, 0], right.positions)
    picture = straight_on(scene, (0.5, 1.0, 0.5), 1.6, (160, 160))
    assert np.array_equal(picture[..., 3], picture[:, ::-1, 3])
    outside = picture[picture[..., 3] > 0][:, 2] == 200
    assert outside.mean() > 0.8
    behind = straight_on(scene, (0.5, 1.0, 0.5), 1.6, (160, 160), away=-5)
    assert (behind[behind[..., 3] > 0][:, 2] == 200).mean() < 0.1


def test_faces_of_all_boxes_look_outwards(texture: Path) -> None:
    scenes = [scene_of(SHIELD), scene_of(None, kind="elytra", texture=texture)]
    scenes.append(scene_of(BANNER, grid=(5, 9)))
    for scene in scenes:
        for model in scene.models:
            a, b, c = (model.mesh.positions[model.mesh.triangles[:, k]] for k in range(3))
            normals = model.mesh.normals[model.mesh.triangles[:, 0]]
            assert (np.sum(np.cross(b - a, c - a) * normals, axis=1) > 0).all()


def test_a_loop_of_a_body_without_cloth_is_a_turntable() -> None:
    around = animate(SHIELD, seconds=0.8, fps=10, size=(40, 48))
    first, *_, last = [frame.pixels for frame in around]
    assert len({frame.pixels.tobytes() for frame in around}) == len(around) == 8
    opposite = around.frames[4].pixels
    assert (opposite[..., 3] > 0).sum() == (first[..., 3] > 0).sum()
    assert (last != first).any()
