"""Scenes of banners: they hang from their bars, sag, stretch little and wave in loops."""

import numpy as np
import pytest
from scene_truths import still

from drapery.cloth import Gravity, Wind, max_stretch
from drapery.scenes import banner, stress
from drapery.scenes.catalogue import Shot
from drapery.scenes.flags import Stand, flag_cloth, hung
from drapery.scenes.motion import motion
from drapery.style.block import FLAG_SIZE
from drapery.testing.plugin import Golden

SHORT = Shot((64, 64), 6, 20.0)


@pytest.mark.parametrize("facing", [0, 90, 180, 270])
@pytest.mark.parametrize("placement", ["standing", "wall"])
def test_a_flag_hangs_from_its_bar(placement, facing) -> None:
    stands = [Stand((3, 0, -2), placement, facing)]
    cloth = flag_cloth((3, 5))
    rest = hung(cloth, stands).positions[0]
    state = list(motion(cloth, SHORT, start=hung(cloth, stands), step=1 / 60))[-1]
    np.testing.assert_allclose(state.positions[0, :3], rest[:3], atol=1e-12)
    lower = state.positions[0, 3:].reshape(4, 3, 3)
    assert (np.diff(lower[..., 1], axis=0) < 0).all()
    assert np.isclose(np.ptp(rest[:, 1]), FLAG_SIZE[1])


def test_banners_wave_and_hardly_stretch() -> None:
    cloth = flag_cloth((5, 9))
    wind = Wind((1.75, 0, 4.7), gusts=0.5, period=banner.LOOP)
    start = hung(cloth, banner.STANDS)
    states = motion(cloth, SHORT, forces=(Gravity(), wind), start=start, settle=2, step=1 / 60)
    positions = np.stack([state.positions for state in states])
    assert max_stretch(positions, cloth) < 0.06
    assert (np.ptp(positions[:, :, -1], axis=0).max(axis=-1) > 0.01).all()
    assert (positions[:, :, -1, 2] > start.positions[:, -1, 2]).all()


def test_the_cube_holds_4913_banners_in_rows() -> None:
    places = stress._places(stress.Parameters())
    assert places.shape == (4913, 3)
    assert len(np.unique(places, axis=0)) == 4913
    worn = stress._bands(17)
    assert worn.min() == 0 and worn.max() == len(stress.RAINBOW) * stress.VARIANTS - 1


def test_every_banner_of_the_cube_moves_by_itself() -> None:
    parameters = stress.Parameters(side=3, settle=0.5)
    shot = Shot((64, 64), 2, 20.0)
    first, second = stress._motion(parameters, shot, stress._places(parameters))
    moves = (second - first)[:, -1]
    assert len(np.unique(np.round(moves, 7), axis=0)) == 27


def test_banner(golden: Golden) -> None:
    golden(still("banner", 3), "banner")


def test_stress(golden: Golden) -> None:
    golden(still("stress", side="5", settle="0.5"), "stress")
