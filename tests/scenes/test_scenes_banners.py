"""Scenes of banners: they hang from their bars, sag, stretch little and wave in loops."""

import numpy as np
import pytest

from drapery.cloth import Cloth, SolverDesbrun, max_stretch
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.scenes import banner, flag, fold, hall, rainbow, stress
from drapery.scenes.banners import BannerBlock, flag_cloth, hang_flags, meeting
from drapery.scenes.catalogue import Clip
from drapery.scenes.misprint import SolverMisprinted
from drapery.scenes.moving import LOOP, looped_wind
from drapery.style.block import FLAG_SIZE, sway_angle
from drapery.style.sway import cape_lean, stiff_cape, sway_phase

SHORT = Clip((64, 64), 6, 20.0)


@pytest.mark.parametrize("facing", [0, 90, 180, 270])
@pytest.mark.parametrize("placement", ["standing", "wall"])
def test_a_flag_hangs_from_its_bar(placement, facing) -> None:
    banner_blocks = [BannerBlock((3, 0, -2), placement, facing)]
    flags = hang_flags(banner_blocks, (3, 5), ("white",), open_packs(()))
    rest = flags.start.positions[0]
    state = list(flags.motion(SHORT))[-1]
    np.testing.assert_allclose(state.positions[0, :3], rest[:3], atol=1e-12)
    lower = state.positions[0, 3:].reshape(4, 3, 3)
    assert (np.diff(lower[..., 1], axis=0) < 0).all()
    assert np.isclose(np.ptp(rest[:, 1]), FLAG_SIZE[1])


def test_banners_wave_and_stretch_little() -> None:
    flags = hang_flags(banner.BLOCKS, (5, 9), ("white",), open_packs(()))
    states = flags.motion(Clip((64, 64), 60, 20.0), looped_wind(5.0, 0), settle=2)
    positions = np.stack([state.positions for state in states])
    assert max_stretch(positions, flags.cloth) < 0.06
    assert (np.ptp(positions[:, :, -1], axis=0).max(axis=-1) > 0.01).all()
    assert (positions[:, :, -1, 2].mean(axis=0) > flags.start.positions[:, -1, 2]).all()


def crossings(one: Cloth, places: Array, other: Cloth, others: Array) -> int:
    """How many springs of one cloth pass through a face of another."""
    start, end = (places[one.spring_pairs[:, side], None] for side in (0, 1))
    a, b, c = (others[other.triangles[:, corner]] for corner in (0, 1, 2))

    def volume(p: Array, q: Array, r: Array, s: Array) -> Array:
        return np.sum(np.cross(q - p, r - p) * (s - p), axis=-1)

    sides = np.sign([volume(start, end, *pair) for pair in ((a, b), (b, c), (c, a))])
    apart = volume(a, b, c, start) * volume(a, b, c, end) < 0
    return int((apart & (abs(sides.sum(axis=0)) == 3)).sum())


@pytest.mark.slow
def test_the_flags_of_the_scene_pass_through_nothing() -> None:
    packs, shapes, clip = open_packs(()), ((3, 5), (5, 9), (7, 13)), Clip((64, 64), 80, 20.0)
    flags = [
        hang_flags((block,), shape, ("white",), packs)
        for block, shape in zip(banner.BLOCKS, shapes, strict=True)
    ]
    wind = looped_wind(5.0, 0)
    apart = zip(*(flag.motion(clip, wind, settle=2 * LOOP) for flag in flags), strict=True)
    met = meeting(flags, banner.BLOCKS, clip, wind, thickness=1.0, settle=2 * LOOP)
    left, middle, right = (flag.cloth for flag in flags)
    found = {"apart": 0, "met": 0}
    for name, motion in (("apart", apart), ("met", met)):
        for states in motion:
            x, y, z = (state.positions[0] for state in states)
            found[name] += crossings(left, x, middle, y) + crossings(middle, y, left, x)
            found[name] += crossings(middle, y, right, z) + crossings(right, z, middle, y)
    assert found["apart"] > 0 and found["met"] == 0


def test_the_cube_holds_4913_banners_in_rows() -> None:
    places = stress.places_of(stress.StressParameters())
    assert places.shape == (4913, 3)
    assert len(np.unique(places, axis=0)) == 4913
    numbers = rainbow.numbers_in_cube(17)
    assert set(numbers) == set(range(len(rainbow.rainbow_banners(1, 0))))


def test_every_banner_of_the_cube_moves_by_itself() -> None:
    parameters = stress.StressParameters(side=3, settle=0.5)
    clip = Clip((64, 64), 2, 20.0)
    first, second = stress.positions_of(parameters, clip, stress.places_of(parameters))
    moves = (second - first)[:, -1]
    assert len(np.unique(np.round(moves, 7), axis=0)) == 27


def test_the_gust_runs_down_the_hall_and_through_no_wall() -> None:
    parameters, clip = hall.HallParameters(), Clip((64, 64), 60, 20.0)
    flags = hang_flags(hall.BLOCKS, parameters.grid, ("white",), open_packs(()))
    states = list(hall.flag_states(parameters, flags, clip))
    assert len(states[0].positions) == 32
    off = np.stack([abs(s.positions[:, -1, 0] - s.positions[:, 0, 0]) for s in states])
    peak = off.argmax(axis=0) / clip.fps
    near, middle = peak[:4].mean(), peak[16:20].mean()
    assert 16 / 11 * 0.7 < middle - near < 16 / 11 * 1.4  # 16 m at 11 m/s
    assert max(abs(s.positions[..., 0]).max() for s in states) < hall.WIDTH / 2
    assert max_stretch(np.stack([s.positions for s in states]), flags.cloth) < 0.15
    # They fold along and across, where boards would swing.
    columns, rows = parameters.grid
    sheets = np.stack([s.positions for s in states]).reshape(-1, 32, rows, columns, 3)
    middle, left, right = sheets[:, :, rows // 2].swapaxes(0, 2)[[columns // 2, 0, -1]]
    top, bottom = sheets[:, :, 0, columns // 2], sheets[:, :, -1, columns // 2]
    for ends in (left + right, (top + bottom).swapaxes(0, 1)):
        fold = np.linalg.norm(middle - ends / 2, axis=-1).max(axis=1)
        assert np.median(fold) > 0.15


def test_a_flag_streams_down_the_wind_from_its_pole() -> None:
    parameters = flag.FlagParameters()
    sewn = flag.flag_cloth(parameters)
    cloth = sewn.cloth
    for state in flag.flag_states(parameters, sewn, SHORT):
        hoist, fly = state.positions[0, :4], state.positions[0, -4:]
        np.testing.assert_allclose(hoist, cloth.rest_positions[:4], atol=1e-12)
        assert (fly[:, 0] - hoist[:, 0]).min() > 0.6 * 44 * sewn.pieces[0].texel
        assert fly[:, 1].mean() < hoist[:, 1].mean()  # its weight shows


def test_the_printed_sign_folds_a_banner_and_the_right_one_does_not() -> None:
    cloth, clip = flag_cloth((5, 9)), Clip((64, 64), 60, 20.0)
    fallen = {}
    for solver in (SolverMisprinted(), SolverDesbrun()):
        *_, last = fold.flag_states(fold.FoldParameters(wind=0.5), cloth, solver, clip)
        edges = np.ptp(last.positions[0].reshape(9, 5, 3)[1:, :, 0], axis=1)
        fallen[type(solver)] = edges.min() / FLAG_SIZE[0]
    assert fallen[SolverDesbrun] > 0.9
    assert fallen[SolverMisprinted] < 0.2


def test_the_sway_is_the_games() -> None:
    assert sway_phase((0, 0, 0), 0.0) == 0
    assert sway_phase((3, 4, 5), 0.0) == (21 + 36 + 65) % 100 / 100
    assert sway_phase((-1, 0, 0), 0.0) == 0.93  # floorMod, not the remainder
    assert np.isclose(sway_phase((0, 0, 0), 1.03), 0.206)
    assert np.isclose(sway_phase((3, 4, 5), 12.5), sway_phase((3, 4, 5), 17.5))
    angles = np.degrees([sway_angle(phase) for phase in (0, 0.5)])
    np.testing.assert_allclose(angles, [-0.45, -4.05], atol=1e-9)


def test_a_stiff_cape_hangs_close_and_lifts_with_speed() -> None:
    assert cape_lean(0.0, 1.0) == 6
    assert 20 < cape_lean(2.5, 0.0) < 30
    assert cape_lean(100.0, 0.0) == 81
    feet = [stiff_cape(lean).positions[:, 2].min() for lean in (0, 6, 30)]
    assert feet[0] > feet[1] > feet[2]
