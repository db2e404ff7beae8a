"""The scenes of the course project: hammock, free corner, curtain, sail, and falling cloth."""

import numpy as np
import pytest
from scene_helpers import clearance

from drapery.cloth import max_stretch
from drapery.cloth.forces import Gravity
from drapery.errors import OptionError
from drapery.scenes import corners, freefall, sail
from drapery.scenes.catalogue import Clip
from drapery.stage.wind_script import parse_script, read_script

LONG = Clip((64, 64), 100, 20.0)
FOUR = (("corners",),)
THREE = (("top-left", "top-right", "bottom-left"),)
TWO = (("top-left", "top-right"), 0.0)
"""Where the cloth is held, and z of its first row [m]."""


def swung(pins, **words):
    parameters = corners.CornersParameters(**words)
    cloth = corners.level_cloth(parameters, *pins).cloth
    return cloth, list(corners.cloth_states(cloth, parameters, LONG))


def energy(cloth, state) -> float:
    """The energy of motion, height and stretched springs [J]."""
    free = cloth.inv_mass > 0
    mass = 1 / cloth.inv_mass[free]
    x, v = state.positions[0], state.velocities[0]
    height = Gravity().acceleration[1] * -x[free, 1]
    a, b = cloth.spring_pairs.T
    stretch = np.linalg.norm(x[b] - x[a], axis=1) - cloth.spring_length
    motion = 0.5 * np.sum(v[free] ** 2, axis=1)
    return float(
        np.sum(mass * (motion + height)) + 0.5 * np.sum(cloth.spring_stiffness * stretch**2)
    )


def test_four_corners_sag_into_a_hammock_and_rest() -> None:
    cloth, states = swung(FOUR, drag=3.0)
    assert abs(states[-1].positions - states[-2].positions).max() < 5e-4  # no jitter at rest
    last = states[-1].positions[0].reshape(10, 10, 3)
    assert last[4:6, 4:6, 1].max() < last[[0, 0, 9, 9], [4, 5, 4, 5], 1].min()
    np.testing.assert_allclose(last[..., 1], last[:, ::-1, 1], atol=0.02)
    np.testing.assert_allclose(last[..., 1], last[::-1, :, 1], atol=0.02)
    assert max_stretch(states[-1].positions, cloth) < 0.15


def test_the_free_one_of_four_corners_is_lowest() -> None:
    _, states = swung(THREE, drag=3.0)
    last = states[-1].positions[0]
    assert last[:, 1].argmin() == 99
    assert last[99, 1] < corners.HEIGHT - 0.9


@pytest.mark.parametrize("shape", [(10, 10), (16, 16)])
def test_two_corners_swing_like_a_curtain_and_lose_energy(shape) -> None:
    cloth, states = swung(TWO, grid=shape)
    middle = np.array([state.positions[0, :, 2].mean() for state in states])
    turns = np.flatnonzero(np.diff(np.sign(middle)))
    assert len(turns) >= 3  # it swings through several times
    energies = np.array([energy(cloth, state) for state in states])
    assert energies.max() <= energies[0] + 0.02 * (energies[0] - energies[-1])
    thirds = energies[:99].reshape(3, 33).max(axis=1)
    assert thirds[0] > thirds[1] > thirds[2]
    hanging = states[-1].positions[0]
    assert hanging[:, 1].min() > 0  # clear of the ground
    assert hanging[-shape[0] :, 1].max() < corners.HEIGHT - 1


@pytest.mark.parametrize("direction", [0, 180])
def test_a_sail_billows_where_the_wind_blows(direction) -> None:
    parameters = sail.SailParameters(gusts=0.0)
    script = f"0 direction {direction}\n0 strength 8\n1.5 off"
    dressed = sail.rigged_sail(parameters)
    (sewn,) = dressed.cloths
    states = list(
        sail.sail_states(parameters, tuple(parse_script(script)), dressed, Clip((64, 64), 50, 20.0))
    )
    assert len(states) == 50
    rest = sewn.start[:, 2].mean()
    ahead = [state.positions[0].reshape(10, 10, 3)[3:7, 3:7, 2].mean() - rest for state in states]
    blown, calm = ahead[29], ahead[-1]
    if direction == 0:
        assert blown > 0.25
        assert calm < blown - 0.1  # off: it falls back
    else:
        assert blown < 0.05  # taken aback: against the mast
    for state in states[::7]:
        assert clearance(sewn.cloth, state, dressed.colliders(sewn), order=3) > -1e-4


def test_a_sail_under_one_command_is_one_motion() -> None:
    """Commands that change nothing leave the motion as it is."""
    parameters = sail.SailParameters(grid=(6, 6))
    cloth = sail.rigged_sail(parameters)
    clip = Clip((64, 64), 12, 20.0)
    plain = sail.sail_states(parameters, tuple(parse_script("0 strength 6")), cloth, clip)
    parts = "0 strength 6\n0.2 strength 6\n0.3 on\n0.41 strength 6"
    for one, other in zip(
        plain, sail.sail_states(parameters, tuple(parse_script(parts)), cloth, clip), strict=True
    ):
        np.testing.assert_allclose(one.positions, other.positions, atol=1e-12)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("1 faster", "line 1: '1 faster' is not a command"),
        ("0 on\n\nsoon off", "line 3: 'soon' is not a number"),
        ("0 strength -2", "from 0 to 40"),
        ("0 strength nan", "is not a number"),
        ("2 on\n1 off", "line 2: 1 s is before 2 s"),
        ("0 strength", "line 1"),
    ],
)
def test_a_script_error_names_its_line(text, fault) -> None:
    with pytest.raises(OptionError, match=fault):
        list(parse_script(text))


def test_a_script_is_read_from_a_file(tmp_path) -> None:
    file = tmp_path / "wind.txt"
    file.write_text("# calm at first\n0 off\n1.5 on # up it comes\n1.5 direction 90\n")
    settings = read_script(str(file))
    assert [setting.time for setting in settings] == [0, 0, 1.5, 1.5]
    assert [setting.speed for setting in settings] == [5, 0, 5, 5]
    with pytest.raises(OptionError, match="cannot be read"):
        read_script(str(tmp_path / "none.txt"))
    file.write_bytes(b"\xff\xfe")
    with pytest.raises(OptionError, match="is not text in UTF-8"):
        read_script(str(file))


@pytest.mark.parametrize("on", [pytest.param("beetle", marks=pytest.mark.slow), "fox"])
def test_falling_cloth_drapes_and_never_goes_through(on) -> None:
    dressed = freefall.falling(freefall.FreefallParameters(grid=(14, 14)))
    sewn = dressed.cloths[("beetle", "fox").index(on)]
    cloth, met = sewn.cloth, dressed.colliders(sewn)
    states = list(freefall.cloth_states(dressed, sewn, Clip((64, 64), 60, 20.0)))
    for state in states[8::6]:
        assert clearance(cloth, state, met) > 0  # half the thickness may go in; the middle not
    last = states[-1]
    heights = last.positions[0, :, 1]
    assert heights.max() > 0.8  # on top
    assert heights.min() < 0.5 and np.ptp(heights) > 0.5  # down its sides
    assert np.sqrt((last.velocities**2).sum(axis=-1)).mean() < 0.1  # at rest
    assert max_stretch(last.positions, cloth) < 0.2
