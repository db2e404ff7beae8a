"""Players: skins of every layout, arms, overlays, motions and poses, and what is drawn of them."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from skin_maker import marked

from drapery import animate, draw
from drapery.commands.app import command_line
from drapery.errors import OptionError
from drapery.garments import dressed_player, find_garment, make_wearer, motion_names, tailor
from drapery.garments.motions import (
    MAX_BYTES,
    POSE_FIELDS,
    KeyPose,
    Motion,
    bone_table,
    find_motion,
    player_bones,
)
from drapery.garments.poses import BonePoses
from drapery.packs import open_packs
from drapery.player_settings import MOTIONS
from drapery.scenes import Dressed
from drapery.settings import Settings
from drapery.sheets import players_sheet
from drapery.stage.player_motion import player_poses
from drapery.stage.recording import Schedule
from drapery.style.boxes import ModelBox
from drapery.style.figure import PARTS, TEXEL
from drapery.style.skins import MIRRORED, OVERLAYS, SLIM_PARTS, Skin, read_skin
from drapery.testing import check_garment
from drapery.testing.plugin import Golden

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "guides" / "players.md").read_text(encoding="utf-8")
FACES = 6


def faces_of(box: ModelBox) -> set[tuple[int, int, int, int]]:
    """The rectangles of an unfolded box by the game's layout: left, top, width, height."""
    (x, y), (w, h, d) = map(int, box.offset), map(int, box.size)
    return {
        (x + d, y, w, d), (x + d + w, y, w, d), (x, y + d, d, h),
        (x + d, y + d, w, h), (x + d + w, y + d, d, h), (x + 2 * d + w, y + d, w, h),
    }  # fmt: skip


@pytest.mark.parametrize("arms", ["classic", "slim"])
def test_every_face_lies_on_the_texels_of_the_format(arms) -> None:
    parts = SLIM_PARTS if arms == "slim" else PARTS
    skin = read_skin(marked(), arms)
    mesh = skin.mesh({})
    quads = mesh.uvs.reshape(-1, 4, 2) * 64
    found = [
        (*map(int, quad.min(axis=0)), *map(int, np.ptp(quad, axis=0))) for quad in quads.round(9)
    ]
    wanted = []
    for name, part in parts.items():
        over = ModelBox(part.box.corner, part.box.size, OVERLAYS[name][:2])
        wanted += [*faces_of(part.box), *faces_of(over)]
    assert sorted(found) == sorted(wanted) and len(found) == 2 * FACES * len(PARTS)
    arm = parts["right_arm"].box
    assert arm.size[0] == (3 if arms == "slim" else 4)


def test_an_old_skin_mirrors_its_right_side() -> None:
    old = marked(32)
    skin = read_skin(old)
    assert skin.arms == "classic" and skin.texels.shape == (64, 64, 4)
    # The front of the left leg shows that of the right one, mirrored.
    left, right = skin.texels[52:64, 20:24], old[20:32, 4:8]
    assert np.array_equal(left, right[:, ::-1])
    # Its outer side, at its left, shows the outer side of the right leg.
    assert np.array_equal(skin.texels[52:64, 24:28], old[20:32, 0:4][:, ::-1])
    assert len(MIRRORED) == 2 * FACES
    assert not skin.texels[0:16, 32:64, 3].any()  # opaque, so it has no hat


@pytest.mark.parametrize("unit", [1, 2, 4])
def test_slim_arms_are_read_from_the_skin(unit: int) -> None:
    texels = marked(unit=unit)
    assert read_skin(texels).arms == "classic"
    texels[20 * unit : 32 * unit, 54 * unit : 56 * unit, 3] = 0
    assert read_skin(texels).arms == "slim"
    assert read_skin(texels, "classic").arms == "classic"


def test_the_first_layer_has_no_holes_and_an_empty_second_is_not_drawn() -> None:
    texels = marked()
    texels[..., 3] = 0
    skin = read_skin(texels, "classic")
    assert (skin.texels[8:16, 8:16, 3] == 255).all()
    assert len(skin.mesh({}).uvs) == 4 * FACES * len(PARTS)
    texels[8, 40, 3] = 255  # one texel of the hat
    assert len(read_skin(texels, "classic").mesh({}).uvs) == 4 * (FACES * len(PARTS) + 1)
    assert len(Skin(skin.texels, "classic").mesh({}, ("head",)).uvs) == 4 * FACES


def test_only_a_drawn_second_layer_keeps_cloth_off() -> None:
    texels = np.zeros((64, 64, 4), np.uint8)
    texels[10, 44] = texels[38, 22] = 255  # on the hat and on the jacket
    assert read_skin(texels).growth == {"head": 0.5, "body": 0.25}
    assert read_skin(texels, overlay="none").growth == {}


@pytest.mark.parametrize("shape", [(64, 48), (63, 63), (32, 32), (128, 32)])
def test_a_skin_of_another_size_is_refused(shape: tuple[int, int]) -> None:
    with pytest.raises(OptionError, match="use 64 x 64 or 64 x 32, or a multiple"):
        read_skin(np.zeros((*shape, 4), np.uint8))


def placed_bones(turns: np.ndarray, grounded: bool) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """The pose of each bone of a player, by name."""
    table = bone_table(turns[None], PARTS, grounded)
    return BonePoses(player_bones(PARTS), lambda times: table)(0.0)


def test_a_table_of_poses_has_the_bits_of_each_time_alone() -> None:
    """A cloth that is moved in one call or in many meets the same boxes."""
    times = np.array([0.0, 0.1, 1 / 3, 0.5, 1.7, 8.3])
    fields = {"look": (20.0, -10.0), "head": "red", "speed": 2.0}
    for motion in ("walk", "wave", "walk+wave", "run:0.5,stand:0.5"):
        poses = player_poses(make_wearer(motion=motion, **fields), Path(), PARTS, None)
        table = poses.at(times)
        for row, time in zip(table, times, strict=True):
            assert poses.at(np.array([time]))[0].tobytes() == row.tobytes()


def test_a_still_asks_for_poses_in_blocks_not_step_by_step() -> None:
    cape, asked = find_garment("cape"), []
    dressed = Dressed(cape, open_packs(()), cape.settings())
    assert dressed.wearer is not None
    poses = dressed.wearer.poses

    def counted(times: np.ndarray) -> np.ndarray:
        asked.append(len(times))
        return poses.table(times)

    dressed.__dict__["wearer"] = replace(dressed.wearer, poses=BonePoses(poses.bones, counted))
    dressed.record(Schedule.still(0.5, 1 / 120))
    # Pins over which limbs may sweep, the pins at all substeps, the boxes at all steps.
    assert len(asked) == 3 and min(asked) > 60


@pytest.mark.parametrize("name", [n for n in motion_names() if n != "walk"])
def test_a_motion_repeats_and_keeps_on_the_ground(name: str) -> None:
    motion = find_motion(name)
    first, again = motion.turns(np.array([0.3, 0.3 + motion.period]))
    np.testing.assert_allclose(first, again, atol=1e-9)
    placed = placed_bones(first, motion.grounded)
    lowest = min(
        float(((PARTS[leg].centre - [0, 6 * TEXEL, 0]) @ placed[leg][1].T + placed[leg][0])[1])
        for leg in ("right_leg", "left_leg")
    )
    if motion.grounded:
        assert 0 <= lowest < 2.1 * TEXEL
    assert f"`{name}`" in PAGE


def test_joints_hold_when_everything_turns() -> None:
    pose = KeyPose(root=(40, 20, 10), right_arm=(70, 0, -30), shift=(1, 2, 3))
    placed = placed_bones(pose.turns, False)
    joint = np.array([-6, 22, 0]) * TEXEL  # the right shoulder
    at_arm, at_body = (
        place + turn @ joint for place, turn in (placed["right_arm"], placed["body"])
    )
    np.testing.assert_allclose(at_arm, at_body, atol=1e-12)


def test_motion_between_key_poses_is_smooth() -> None:
    motion = Motion(poses=(KeyPose(head=(0, 0, 0)), KeyPose(head=(10, 0, 0))), period=2)
    angles = motion.turns(np.array([0, 0.25, 0.5, 1, 1.5, 2]))[:, POSE_FIELDS.index("head"), 0]
    np.testing.assert_allclose(angles, [0, 1.4644661, 5, 10, 5, 0], atol=1e-6)


def test_a_pose_of_a_json_file_and_its_faults(tmp_path: Path) -> None:
    path = tmp_path / "pose.json"
    path.write_text(json.dumps({"head": [0, 30, 0]}))
    (pose,) = find_motion("pose.json", tmp_path).poses
    assert pose.head == (0, 30, 0)
    path.write_text(json.dumps({"tail": [0, 30, 0]}))
    with pytest.raises(OptionError, match=r"tail cannot be used; .* root, head"):
        find_motion("pose.json", tmp_path)
    path.write_text(" " * (MAX_BYTES + 1))
    with pytest.raises(OptionError, match="a pose is shorter"):
        find_motion("pose.json", tmp_path)
    path.write_text("{")
    with pytest.raises(OptionError, match="is not JSON"):
        find_motion("pose.json", tmp_path)
    with pytest.raises(OptionError, match=r"motion 'fly' is not known; use walk, .* stand, run"):
        find_motion("fly")


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"arms": "wide"}, "arms 'wide' cannot be used; it should be 'auto', 'classic' or 'slim'"),
        ({"speed": 11.0}, "speed 11 cannot be used; it should be less than or equal to 10"),
        ({"kind": "horse", "motion": "sit"}, "motion 'sit' is for players; a horse walks"),
    ],
)
def test_a_field_of_a_wearer_is_checked(fields: dict[str, object], said: str) -> None:
    with pytest.raises(OptionError, match=re.escape(said)):
        make_wearer(**fields)


def test_what_is_worn_is_cloth_of_its_own() -> None:
    player = dressed_player(make_wearer(motion="stand"), wear=("cape", "skirt"))
    cape, skirt = tailor(player, open_packs(()))
    assert cape.solid == find_garment("cape").wearer.solid  # type: ignore[union-attr]
    assert {each.name for each in (*cape.pieces, *skirt.pieces)} == {"cape", "skirt"}
    wings = dressed_player(make_wearer(), cape="cape.png", elytra=True).over[0].piece
    assert all(piece.texture is not None and piece.texture.front for piece in wings)


def test_what_is_for_a_horse_is_refused() -> None:
    """A player whom it covered was torn cloth from the first step."""
    with pytest.raises(OptionError, match="garment caparison is for a horse, not for a player; "):
        dressed_player(make_wearer(), wear=("coat", "caparison"))


def test_what_hangs_behind_a_player_is_seen() -> None:
    """A player from the front hides its cape."""
    behind = ({"wear": ("cape",)}, {"cape": "cape.png"}, {"elytra": True})
    turned = [dressed_player(make_wearer(), **words).settings().rotation for words in behind]
    assert turned == [find_garment("cape").settings().rotation] * 3
    for words in ({}, {"wear": ("coat",)}):
        assert dressed_player(make_wearer(), **words).settings().rotation == 0


@pytest.mark.parametrize("motion", ["run", "sneak", "sit"])
def test_a_cape_stays_outside_a_player_that_moves(motion: str) -> None:
    cape = find_garment("cape")
    who = make_wearer(motion=motion, speed=2.0, solid=("body", "right_leg", "left_leg"))
    check_garment(cape.model_copy(update={"wearer": who}), 0.4)


@pytest.mark.parametrize(("motion", "speed"), [("stand", 0.0), ("glide", 8.0)])
def test_wings_bend_and_do_not_fold(motion: str, speed: float) -> None:
    player = dressed_player(make_wearer(motion=motion, speed=speed), elytra=True)
    dressed = Dressed(player, open_packs(()), player.settings())
    columns, rows = find_garment("elytra").piece[0].points  # type: ignore[union-attr]
    at = Schedule.at([0.5, 0.9, 1.2, 1.6], dressed.step, every=round(0.1 / dressed.step))
    for sheet in dressed.record(at):
        down = np.diff(sheet.reshape(4, rows, columns, 3), axis=1)
        along = down / np.linalg.norm(down, axis=-1, keepdims=True)
        cosines = np.einsum("trci,tsci->trsc", along, along)
        assert np.degrees(np.arccos(cosines.min())) < 75


def test_the_head_looks_and_the_rest_stays() -> None:
    ahead, aside = (
        Dressed(dressed_player(make_wearer(look=look)), open_packs(()), Settings()).wearer
        for look in ((0, 0), (90, 0))
    )
    assert ahead is not None and aside is not None
    nose = np.array([0, 28, 4]) * TEXEL
    place, turn = aside.poses(0.0)["head"]
    np.testing.assert_allclose(turn @ nose + place, np.array([4, 28, 0]) * TEXEL, atol=1e-9)
    assert np.array_equal(ahead.poses(0.0)["body"][0], aside.poses(0.0)["body"][0])


@pytest.mark.parametrize("shown", ["full", "bust", "head"])
def test_a_player_looks_as_it_did(shown: str, golden: Golden) -> None:
    player = dressed_player(make_wearer(skin="dancer", motion="wave", shown=shown))
    golden(draw(player, size=(96, 120), time=1.0))


def test_a_loop_of_a_motion_has_no_seam() -> None:
    player = dressed_player(make_wearer(motion="run", speed=4.0))
    frames = animate(player, size=(48, 64), seconds=1, fps=10).frames
    pixels = [frame.pixels.astype(float) for frame in frames]
    steps = [np.abs(a - b).mean() for a, b in zip(pixels, [*pixels[1:], pixels[0]], strict=True)]
    assert steps[-1] <= 1.2 * max(steps[:-1])


def test_a_turntable_shows_a_player_from_all_sides() -> None:
    player = dressed_player(make_wearer(motion="stand", shown="head"))
    options = {"size": (24, 24), "view": "front", "light": "flat", "seconds": 1, "fps": 4}
    ahead, right, behind, left = animate(player, turntable=True, **options).frames  # type: ignore[arg-type]
    back = draw(player, size=(24, 24), view="back", light="flat").pixels
    drawn = [frame.pixels for frame in (ahead, right, behind, left)]
    assert len({pixels.tobytes() for pixels in drawn}) == 4
    face, nape = (pixels[8:16, 8:16, :3].mean() for pixels in (drawn[0], drawn[2]))
    assert abs(nape - back[8:16, 8:16, :3].mean()) < 6 < face - nape


def test_a_turntable_is_not_for_items() -> None:
    with pytest.raises(OptionError, match="turntable is not for an item in its slot; leave it out"):
        Settings(turntable=True, placement="item")


def test_a_sheet_of_players_has_a_row_for_each_skin_and_view() -> None:
    sheet = players_sheet(Settings(size=(24, 24)), ("dancer",), ("stand", "sit"), wear=())
    assert sheet.down == ("dancer front", "dancer hero", "dancer back") and len(sheet.cells) == 6


def test_the_blocks_of_the_page_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocks = dict(re.findall(r"```(\w+)\n(.*?)```", PAGE, re.DOTALL))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pose.json").write_text(blocks["json"])
    assert find_motion("pose.json").poses[0].shift == (0, 2, 0)
    exec(blocks["python"], {})
    assert (tmp_path / "player.png").exists()


def test_the_table_of_options_knows_all_motions() -> None:
    assert sorted(MOTIONS) == sorted(motion_names())


def command(*words: object) -> None:
    command_line()([str(word) for word in words], standalone_mode=False)


def test_the_command_draws_a_player(tmp_path: Path) -> None:
    Image.fromarray(marked()).save(tmp_path / "skin.png")
    (tmp_path / "pose.json").write_text('{"head": [0, 20, 0]}')
    own = ("--skin", tmp_path / "skin.png", "--motion", tmp_path / "pose.json", "--look", "10,5")
    command("player", *own, "-o", tmp_path / "p.png", "--size", "32x32", "--shown", "head")
    with Image.open(tmp_path / "p.png") as picture:
        assert picture.size == (32, 32) and picture.getextrema()[3] == (0, 255)
    with pytest.raises(
        OptionError, match=r"look 'up' is not two angles or a point; write it like 30,10 or"
    ):
        command("player", "--look", "up", "-o", tmp_path / "p.png")


def poses_of(motion: str, time: float, loop: float | None = None, **fields: object) -> dict:
    who = make_wearer(motion=motion, **fields)
    return player_poses(who, Path(), PARTS, loop)(time)


def test_layered_motions_turn_the_bones_that_the_later_one_moves() -> None:
    both = poses_of("walk+wave", 1.1, speed=2.0)
    walk, wave = poses_of("walk", 1.1, speed=2.0), poses_of("wave", 1.1)
    for bone, wanted in {"right_leg": walk, "left_leg": walk, "right_arm": wave}.items():
        np.testing.assert_allclose(both[bone][1], wanted[bone][1], atol=1e-12)
    # The feet of a walk touch the ground.
    assert both["body"][0][1] == pytest.approx(walk["body"][0][1], abs=1e-9)


def test_a_mean_of_motions_has_their_weights() -> None:
    only = poses_of("walk:0,sit:1", 1.0, speed=2.0)
    for bone, (place, turn) in poses_of("sit", 1.0).items():
        np.testing.assert_allclose(only[bone][0], place, atol=1e-12)
        np.testing.assert_allclose(only[bone][1], turn, atol=1e-12)
    half = poses_of("stand:0.5,point:0.5", 2.0)["right_arm"][1]
    raised = np.degrees(np.arccos(half[1, 1] / np.hypot(half[1, 1], half[2, 1])))
    assert raised == pytest.approx((88 - 1) / 2, abs=1.5)


@pytest.mark.parametrize("motion", ["walk+wave", "run:0.5,stand:0.5", "swim", "sneak+point"])
def test_a_loop_of_blended_motions_ends_where_it_begins(motion: str) -> None:
    first, last = (poses_of(motion, 2.0 + time, 3.1, speed=1.5) for time in (0, 3.1))
    for bone in PARTS:
        for one, other in zip(first[bone], last[bone], strict=True):
            np.testing.assert_allclose(one, other, atol=1e-9)


@pytest.mark.parametrize(
    ("motion", "said"),
    [
        ("walk:2,wave:1", "its weight is not 0 to 1"),
        ("walk:0,wave:0", "has only weights of 0"),
        ("+".join(["wave"] * 9), "blends over 8 motions"),
        ("walk+fly", "motion 'fly' is not known"),
    ],
)
def test_a_blend_that_cannot_be_read_is_refused(motion: str, said: str) -> None:
    with pytest.raises(OptionError, match=said):
        poses_of(motion, 1.0)


@pytest.mark.parametrize("motion", ["stand", "glide", "sit", "walk+wave"])
@pytest.mark.parametrize("point", [(1.0, 2.0, 2.0), (-2.0, 0.2, 1.0), (0.0, 3.0, 1.0)])
def test_a_head_looks_at_a_point(motion: str, point: tuple[float, float, float]) -> None:
    poses = poses_of(motion, 1.0, look=point)
    place, turn = poses["head"]
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(turn) == pytest.approx(1)
    joint = np.array([0, 24 * TEXEL, 0])
    plain = poses_of(motion, 1.0)["head"]
    np.testing.assert_allclose(turn @ joint + place, plain[1] @ joint + plain[0], atol=1e-12)
    middle = turn @ joint + place + poses["body"][1] @ np.array([0, 4 * TEXEL, 0])
    towards = np.array(point) - middle
    if (poses["body"][1].T @ towards)[2] > 0:
        np.testing.assert_allclose(turn[:, 2], towards / np.linalg.norm(towards), atol=1e-12)


def test_a_head_does_not_turn_farther_than_its_shoulder() -> None:
    _, turn = poses_of("stand", 1.0, look=(1.0, 28.0 * TEXEL, -5.0))["head"]
    np.testing.assert_allclose(turn[:, 2], [1, 0, 0], atol=1e-9)
