"""Garments of one wearer: the outer ones begin outside the inner ones, and none passes another."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from drapery import Settings
from drapery.cloth import Collisions, State, grid, max_stretch, rotation_about, sew
from drapery.cloth.collisions import contact_stage
from drapery.garments import SewnCloth, dressed_player, find_garment, make_wearer, tailor
from drapery.garments.layering import outermost, put_outside, sampled
from drapery.packs import open_packs
from drapery.scenes import Dressed, Schedule
from drapery.stage.layered import common_bones, meet_each_other
from drapery.style.figure import TEXEL

SQUARE = np.array([[-1.0, -1, 2], [1, -1, 2], [-1, 1, 2], [1, 1, 2]])
FACES = np.array([[0, 1, 2], [1, 3, 2]], np.int32)


def crossings(one: np.ndarray, faces: np.ndarray, other: np.ndarray, others: np.ndarray) -> int:
    """How many edges of each surface pass through a face of the other."""
    found = 0
    for a, at, b, bt in ((one, faces, other, others), (other, others, one, faces)):
        ends = np.unique(np.sort(at[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
        start, along = a[ends[:, 0]][:, None], (a[ends[:, 1]] - a[ends[:, 0]])[:, None]
        corner, u, v = b[bt[:, 0]], b[bt[:, 1]] - b[bt[:, 0]], b[bt[:, 2]] - b[bt[:, 0]]
        across = np.cross(along, v)
        volume = (across * u).sum(axis=-1)
        volume = np.where(np.abs(volume) < 1e-15, np.inf, volume)
        s = ((start - corner) * across).sum(axis=-1) / volume
        turned = np.cross(start - corner, u)
        t = (along * turned).sum(axis=-1) / volume
        r = (turned * v).sum(axis=-1) / volume
        found += int(((s > 0) & (t > 0) & (s + t < 1) & (r > 0) & (r < 1)).sum())
    return found


def pair_of(inner: str, outer: str) -> list[SewnCloth]:
    player = dressed_player(make_wearer(speed=2.5), wear=(inner, outer))
    return [*tailor(player, open_packs(()))]


def test_a_ray_ends_at_the_last_triangle() -> None:
    points = np.array([[0.0, 0, 1], [0, 0.5, 9], [1.5, 0, 1], [0, 3, 1]])
    near = np.concatenate([SQUARE, SQUARE * [1, 1, 0.5]])
    distances, faces = outermost(points, near, np.concatenate([FACES, FACES + 4]))
    assert distances.tolist() == [2, 2, 0, 0] and set(faces[:2]) <= {0, 1}


def test_the_order_of_cloths_is_that_of_their_garments() -> None:
    player = dressed_player(make_wearer(), wear=("skirt", "scarf", "coat"), cape="cape.png")
    named = [each.name for each in player.over]
    assert named == ["skirt", "coat", "cape", "scarf"]
    tight = player.model_copy(update={"over": player.over[:1] + player.over[3:]})
    assert [each.order for each in tailor(tight, open_packs(()))] == [0, 1, 1, 1]


@pytest.mark.parametrize(
    ("inner", "outer"), [("skirt", "coat"), ("coat", "cape"), ("cape", "scarf")]
)
def test_the_outer_garment_begins_outside(inner: str, outer: str) -> None:
    cloths = pair_of(inner, outer)
    placed = put_outside(cloths)
    assert placed[0] is cloths[0]
    for cloth in placed[1:]:
        if cloth.order:
            surfaces = [(each.start, each.cloth.triangles) for each in (placed[0], cloth)]
            assert crossings(*surfaces[0], *surfaces[1]) == 0
    assert max(np.abs(a.start - b.start).max() for a, b in zip(cloths, placed, strict=True)) < (
        4 * TEXEL
    )


@pytest.mark.parametrize(
    ("inner", "outer"),
    [
        *(("skirt", "cape"), ("hood", "cape"), ("poncho", "elytra")),
        pytest.param("poncho", "coat", marks=pytest.mark.slow),
    ],
)
def test_garments_over_each_other_begin_behind_a_shield(inner: str, outer: str) -> None:
    player = dressed_player(make_wearer(shield="white"), wear=(inner, outer))
    dressed = Dressed(player, open_packs(()), SETTINGS)
    assert dressed.wearer is not None
    ((plate, _),) = dressed.wearer.held_boxes()
    for sewn in dressed.cloths:
        away = np.abs(sampled(sewn.start, sewn.cloth.triangles) - plate.centre)
        clear = (away - np.asarray(plate.size) / 2).max(axis=1).min()
        assert clear > sewn.distance / 2
    pairs = [(a, b) for a in dressed.cloths for b in dressed.cloths if a.order < b.order]
    for a, b in pairs:
        assert crossings(a.start, a.cloth.triangles, b.start, b.cloth.triangles) == 0


def test_only_cloth_on_the_body_meets_other_garments() -> None:
    cape, coat = pair_of("cape", "coat")
    assert meet_each_other((cape, coat)) == [0, 1] and meet_each_other((cape,)) == []
    who = make_wearer(head="black")
    flag = Dressed(dressed_player(who, wear=("cape",)), open_packs(()), SETTINGS).cloths
    assert meet_each_other(flag) == []
    assert common_bones((cape, coat), ("head", "body", "left_arm", "left_leg")) == (
        *("body", "left_leg"),
    )


def test_contact_on_a_body_does_not_depend_on_its_motion() -> None:
    sheets = [grid(3, 3, 0.2, 0.2, pins="none") for _ in range(2)]
    stage = contact_stage(sew(sheets), Collisions(apart=0.02))
    assert stage is not None
    above = np.repeat([0.0, 0.03], 9)[:, None] * [0.0, 0.0, 1.0]
    start = np.concatenate([sheet.rest_positions for sheet in sheets]) + above
    nearer = start - above * 0.9
    still = stage.resolve(state_at(start, 0.0), state_at(nearer, 0.01))
    assert np.ptp(still.positions[0, :, 2]) > 0.012  # from 0.003
    turn, shift = rotation_about((0, 1, 0), 30), np.array([0.0, 0.1, 0.2])
    carried = np.einsum("ij,nj->ni", turn, nearer) + shift
    moved = stage.resolve(state_at(start, 0.0), state_at(carried, 0.01), (turn, shift))
    expected = np.einsum("ij,nj->ni", turn, still.positions[0]) + shift
    np.testing.assert_allclose(moved.positions[0], expected, atol=1e-9)


def state_at(positions: np.ndarray, time: float) -> State:
    return State(positions[None], np.zeros_like(positions)[None], time)


SETTINGS = find_garment("cape").settings()


def test_garments_of_one_wearer_do_not_pass_through_each_other() -> None:
    player = dressed_player(make_wearer(speed=2.5, motion="run"), wear=("skirt", "cape"))
    dressed = Dressed(player, open_packs(()), player.settings())
    times = [0.0, 0.2, 0.4, 0.6]
    one, other = dressed.record(Schedule.at(times, dressed.step))
    faces = [each.cloth.triangles for each in dressed.cloths]
    assert [crossings(a, faces[0], b, faces[1]) for a, b in zip(one, other, strict=True)] == [0] * 4
    again = Dressed(player, open_packs(()), player.settings()).record(
        Schedule.at(times[:2], dressed.step)
    )
    assert np.array_equal(again[1], other[:2])


def test_a_poncho_is_not_torn_by_a_head_that_tilts_back() -> None:
    """Its neck is held by the body, and would be inside of the head."""
    player = dressed_player(make_wearer(motion="glide"), wear=("poncho",))
    dressed = Dressed(player, open_packs(()), player.settings())
    (sheets,) = dressed.record(Schedule.at([0.5, 1.0], dressed.step, round(0.5 / dressed.step)))
    (sewn,) = dressed.cloths
    assert max(max_stretch(sheet, sewn.cloth) for sheet in sheets) < 0.16


SWIMMING = [("hood", {}), ("tabard", {}), ("poncho", {}), ("poncho", {"solver": "pbd", "wind": 40})]


@pytest.mark.filterwarnings("ignore:pins or colliders pull cloth")  # for a step, by a part
@pytest.mark.parametrize(("name", "options"), SWIMMING)
def test_arms_that_sweep_over_pins_do_not_tear_a_garment(name, options) -> None:
    player = dressed_player(make_wearer(motion="swim"), wear=(name,))
    settings = Settings(**{**player.settings().given_values, **options})
    dressed = Dressed(player, open_packs(()), settings)
    swum = dressed.record(Schedule.at([1.25, 1.375, 1.5, 1.625, 1.875], dressed.step))
    for sewn, places in zip(dressed.cloths, swum, strict=True):
        assert max(max_stretch(each, sewn.cloth) for each in places) < 0.2


def pins_of(name: str, motion: str) -> int:
    player = dressed_player(make_wearer(motion=motion), wear=(name,))
    cloths = Dressed(player, open_packs(()), player.settings()).cloths
    assert all(len(each.bones) == (each.cloth.inv_mass == 0).sum() for each in cloths)
    return sum(len(each.bones) for each in cloths)


def test_only_pins_that_a_limb_sweeps_over_hold_nothing() -> None:
    """The seated wearer's legs stay in the waist of a skirt, and a scarf lies in its arms."""
    assert pins_of("hood", "walk") - pins_of("hood", "swim") == 2
    assert pins_of("skirt", "walk") == pins_of("skirt", "sit")
    assert pins_of("scarf", "walk") == pins_of("scarf", "swim")
    assert pins_of("cape", "walk") == pins_of("cape", "swim")


def test_the_hem_of_a_skirt_on_a_runner_lies_in_folds_and_swings() -> None:
    """A bell without folds is as long around as the line around all of its points."""
    player = dressed_player(make_wearer(motion="run"), wear=("skirt",))
    dressed = Dressed(player, open_packs(()), player.settings())
    at = Schedule.at([1.0, 1.125, 1.25, 1.375], dressed.step, every=round(0.125 / dressed.step))
    (sheets,) = dressed.record(at)
    (sewn,) = dressed.cloths
    low = sewn.start[:, 1] < sewn.start[:, 1].min() + 1e-6
    hems = sheets[:, low][..., [0, 2]]
    around = [np.hypot(*(np.roll(hem, -1, axis=0) - hem).T).sum() for hem in hems]
    outline = [ConvexHull(hem).area for hem in hems]  # of a plane figure: its perimeter
    assert np.mean(np.array(around) / outline) > 1.05
    assert np.ptp(hems[..., 1], axis=0).max() > 0.2
