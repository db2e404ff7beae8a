"""Wings of cloth: they hang behind the back, follow its motions alike, and spread in a glide."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from drapery.errors import OptionError
from drapery.garments import Garment, dressed_player, find_garment, make_wearer, motion_names
from drapery.garments.motions import KeyPose, bone_table, find_motion, player_bones
from drapery.garments.poses import BonePoses
from drapery.packs import open_packs
from drapery.scenes import Dressed, Schedule
from drapery.stage.gait import Gait
from drapery.style.figure import PARTS, TEXEL, WING_JOINTS
from drapery.testing import check_garment

SPEEDS = {"walk": 2.0, "run": 4.0, "sneak": 1.0, "jump": 2.0, "glide": 8.0, "swim": 2.0}
"""How fast a player moves [m/s]; it stands in other motions."""
STEP, SECONDS = 0.1, 3.0
SHOULDERS = 24 * TEXEL
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])


def winged(motion: str, speed: float) -> Dressed:
    player = dressed_player(make_wearer(motion=motion, speed=speed), elytra=True)
    return Dressed(player, open_packs(()), player.settings())


@cache
def wings(motion: str) -> tuple[np.ndarray, np.ndarray]:
    """The left and the right wing at moments of a motion, [2][F, rows, columns, 3], both with the
    outer edge first; and the height of the top of the head [F]."""
    dressed = winged(motion, SPEEDS.get(motion, 0.0))
    return recorded(dressed, [STEP * step for step in range(round(SECONDS / STEP) + 1)])


def recorded(dressed: Dressed, times: list[float]) -> tuple[np.ndarray, np.ndarray]:
    columns, rows = find_garment("elytra").piece[0].points  # type: ignore[union-attr]
    left, right = (
        sheet.reshape(-1, rows, columns, 3)
        for sheet in dressed.record(
            Schedule.at(times, dressed.step, every=round(STEP / dressed.step))
        )
    )
    assert dressed.wearer is not None
    head = PARTS["head"].centre + CORNERS * PARTS["head"].extent / 2
    poses = [dressed.wearer.poses(time)["head"] for time in times]
    tops = np.array([(head @ turn.T + place)[:, 1].max() for place, turn in poses])
    return np.array([left, right[:, :, ::-1]]), tops


def apart(both: np.ndarray) -> np.ndarray:
    """How far the right wing is from the mirror image of the left one at each moment [m]."""
    away = both[1] - both[0] * [-1, 1, 1]
    return np.asarray(np.linalg.norm(away, axis=-1).max(axis=(1, 2)))


@pytest.mark.parametrize("motion", motion_names())
def test_wings_stay_below_the_top_of_the_head(motion: str) -> None:
    both, tops = wings(motion)
    over = both[..., 1].max(axis=(0, 2, 3)) - tops
    if motion == "glide":
        # They beat once as they spread; a head that looks ahead of a level body is hardly higher.
        assert over.max() < 0.5 and over[20:].max() < 0.2
    else:
        assert over.max() < 0


@pytest.mark.parametrize(
    ("motion", "bound"),
    [
        *(("stand", 0.02), ("wave", 0.02), ("point", 0.02), ("sneak", 0.05)),
        *(("glide", 0.25), ("sit", 0.2), ("swim", 0.4), ("walk", 0.2)),
    ],
)
def test_wings_mirror_each_other(motion: str, bound: float) -> None:
    both, _ = wings(motion)
    away = apart(both)
    assert away[0] < 1e-12
    assert away[10:].max() < bound


def test_wings_spread_in_a_glide_and_are_folded_at_rest() -> None:
    gliding, standing = (
        np.ptp(both[:, 10:, ..., 0], axis=(0, 2, 3))
        for both in (wings("glide")[0], wings("stand")[0])
    )
    assert gliding.min() > 2.6
    assert standing.max() < 1.6


@pytest.mark.parametrize("motion", ["stand", "walk", "wave", "point"])
def test_wings_hang_behind_the_back_at_rest(motion: str) -> None:
    both, _ = wings(motion)
    tips = both[:, 10:, -1]
    assert (tips[..., 1] < 0.4 * SHOULDERS).all()
    assert (tips[..., 2] < -2 * TEXEL).all()


def test_wings_lift_at_a_run_and_come_down_after_each_jump() -> None:
    standing, running, jumping = (
        wings(name)[0][:, :, -1, :, 1] for name in ("stand", "run", "jump")
    )
    assert running[:, 10:].mean() > standing.mean() + 3 * TEXEL
    landed = jumping[:, 10::10]  # a jump takes a second
    assert landed.max() < 0.5 * SHOULDERS


def test_both_wings_return_after_a_glide() -> None:
    dressed = winged("stand", 0.0)
    assert dressed.wearer is not None
    glide = find_motion("glide")

    def table(times: np.ndarray) -> np.ndarray:
        shares = np.clip(3.0 - 2 * times, 0.0, 1.0)  # all of it until 1 s, nothing from 1.5 s on
        return bone_table(shares[:, None, None] * glide.turns(0 * times), PARTS, True)

    poses = BonePoses(player_bones(PARTS), table)
    dressed.__dict__["wearer"] = replace(dressed.wearer, poses=poses)
    both, _ = recorded(dressed, [0.0, 1.0, 4.0])
    away = np.linalg.norm(both[:, 2] - wings("stand")[0][:, -1], axis=-1)
    assert away.max() < 0.1
    assert np.linalg.norm(both[:, 2] - both[:, 1], axis=-1).max() > 0.5


def test_wings_turn_about_the_shoulders_of_the_body() -> None:
    pose = KeyPose(root=(40, 20, 10), body=(0, 30, 0), left_wing=(15, -10, 60), shift=(1, 2, 3))
    table = bone_table(pose.turns[None], PARTS, False)
    placed = BonePoses(player_bones(PARTS), lambda times: table)(0.0)
    joint = np.array(WING_JOINTS["left_wing"]) * TEXEL * [1, -1, -1]
    at_wing, at_body = (
        place + turn @ joint for place, turn in (placed["left_wing"], placed["body"])
    )
    np.testing.assert_allclose(at_wing, at_body, atol=1e-12)
    for name in WING_JOINTS:
        walking = Gait(2.0).poses(0.3)
        assert np.array_equal(walking[name][1], walking["body"][1])
        assert np.array_equal(walking[name][0], walking["body"][0])


def test_only_pins_name_the_bones_of_wings(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="solid 'left_wing' is not a bone"):
        make_wearer(solid=("left_wing",))
    text = '[wearer]\nkind = "horse"\n[[piece]]\nname = "a"\nsize = [4, 4]\npoints = [2, 2]\n'
    path = tmp_path / "a.toml"
    path.write_text(text + '[[pin]]\npiece = "a"\nat = "top"\nto = "left_wing"\n')
    with pytest.raises(OptionError, match="to 'left_wing' is not known"):
        Garment.load(path)


def test_cloth_that_begins_in_its_wearer_is_a_fault() -> None:
    elytra = find_garment("elytra")
    check_garment(elytra, 0.2)
    wing = elytra.piece[0]
    inwards = wing.model_copy(update={"turn": (10.0, 180.0, 12.0)})
    refused = pytest.raises(OptionError, match=r"left begins \d+\.\d mm inside what it meets; pin")
    with refused:
        check_garment(elytra.model_copy(update={"piece": (inwards,)}), 0.1)
