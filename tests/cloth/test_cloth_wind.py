"""The wind: what it is made of, and that it repeats, travels and presses as it says."""

from itertools import islice

import numpy as np
import pytest
from numba import njit

from drapery.cloth import Gravity, SolverDesbrun, Wind, grid, kernels, rest_state, simulate
from drapery.cloth.wind import COLUMN, CROSSWIND, lower_winds
from drapery.errors import OptionError


@njit
def _blow(out, x, controls, gusts, time, work):
    kernels.blow(out, x, controls, gusts, 0, 0, time, work)


def velocity(wind, points, time):
    """Wind velocity at points [P, 3], shape [P, 3]."""
    points = np.asarray(points, float)
    x = np.ascontiguousarray(points.T)
    gusts = lower_winds([wind], len(points))
    out = np.empty_like(x)
    _blow(out, x, np.zeros(1, np.int32), gusts, float(time), np.empty((18, len(points))))
    return out.T


POINTS = np.random.default_rng(0).uniform(-40, 40, size=(4000, 3))


def test_each_number_of_a_wind_is_in_the_column_of_its_name():
    sizes = {"gusts": 0.4, "gust_size": 2.0, "sine": 0.3, "sine_period": 4.0, "pressure": 0.5}
    (row,) = lower_winds([Wind((3.0, 0.0, 4.0), **sizes)], 1).numbers
    assert {name: row[at] for name, at in COLUMN._asdict().items() if name != "axes"} == {
        "speed": 5.0,
        "sine": 0.3,
        "sine_rate": 0.25,
        "gusts": 2.0,
        "gust_scale": 0.5,
        "gust_rate": 2.5,
        "gust_start": 0.0,
        "gust_cells": 4096.0,
        "pressure": 0.5,
    }
    along, across, third = row[COLUMN.axes :].reshape(3, 3)
    assert along.tolist() == [0.6, 0.0, 0.8]
    np.testing.assert_allclose(np.cross(along, across), third, atol=1e-15)


def test_a_steady_wind_is_its_velocity_everywhere():
    wind = Wind((1.0, 2.0, 3.0), gusts=0, sine=0)
    np.testing.assert_allclose(velocity(wind, POINTS, 7.7), np.tile([1.0, 2.0, 3.0], (4000, 1)))


def test_the_sine_swells_along_the_wind():
    wind = Wind((0.0, 0.0, 2.0), gusts=0, sine=0.5, sine_period=4.0)
    for time, speed in ((0, 2.0), (1, 3.0), (2, 2.0), (3, 1.0)):
        np.testing.assert_allclose(velocity(wind, POINTS[:3], time)[:, 2], speed, atol=1e-9)


def test_gusts_have_the_turbulence_asked_for_along_across_and_up():
    wind = Wind((0.0, 0.0, 5.0), gusts=0.4, sine=0)
    gusts = velocity(wind, POINTS, 3.0) - [0, 0, 5.0]
    along, across, up = 2.0 * np.array(CROSSWIND)
    np.testing.assert_allclose(gusts.std(axis=0), [across, up, along], rtol=0.06)
    assert np.abs(gusts.mean(axis=0)).max() < 0.15


def test_gusts_travel_with_the_wind():
    wind = Wind((3.0, 0.0, 4.0), gusts=0.4, sine=0)
    carried = POINTS[:50] + 0.7 * np.array([3.0, 0.0, 4.0])
    np.testing.assert_allclose(velocity(wind, POINTS[:50], 2.0), velocity(wind, carried, 2.7))


def test_seeds_differ_and_gusts_are_smooth():
    one, two = (velocity(Wind((0, 0, 4.0), seed=seed), POINTS[:99], 1.0) for seed in (1, 2))
    assert np.abs(one - two).mean() > 0.5
    near = velocity(Wind((0, 0, 4.0), seed=1), POINTS[:99] + 1e-4, 1.0)
    assert np.abs(one - near).max() < 1e-2


@pytest.mark.parametrize("period", [4.0, 0.7, 33.3])
def test_a_periodic_wind_repeats_exactly(period):
    wind = Wind((1.0, 0.0, 4.0), period=period)
    for time in (0.0, 0.31, 2.5):
        np.testing.assert_allclose(
            velocity(wind, POINTS[:99], time),
            velocity(wind, POINTS[:99], time + 3 * period),
            atol=1e-9,
        )


def test_a_phase_is_an_offset_in_time():
    late = Wind((1.0, 0.0, 4.0), phases=np.full(9, 2.5))
    np.testing.assert_allclose(
        velocity(late, POINTS[:9], 1.0), velocity(Wind((1.0, 0.0, 4.0)), POINTS[:9], 3.5)
    )


def test_a_flag_in_a_periodic_wind_comes_to_move_with_its_period():
    cloth = grid(5, 9, 0.8333, 1.6667)
    forces = [Gravity(), Wind((1.0, 0.0, 4.0), period=4.0)]
    start = rest_state(cloth, 1, np.float64)
    states = islice(simulate(cloth, SolverDesbrun(), forces, start=start, every=240), 8)
    turns = [state.positions for state in states]
    assert np.abs(turns[-1] - turns[-2]).max() < 0.02 < np.abs(turns[1] - turns[0]).max()


def test_wind_never_lets_a_banner_come_to_a_dead_stop():
    cloth = grid(5, 9, 0.8333, 1.6667)
    states = islice(simulate(cloth, None, [Gravity(), Wind((0.0, 0.0, 2.0))], every=30), 20, 140)
    speeds = [np.linalg.norm(state.velocities, axis=-1).max() for state in states]
    assert min(speeds) > 0.01


@pytest.mark.parametrize(
    "options",
    [
        {"velocity": (np.nan, 0, 0)},
        {"velocity": (1, 2)},
        {"gusts": -1.0},
        {"gust_size": 0.0},
        {"period": 0.0},
        {"sine_period": np.inf},
        {"phases": np.array([np.nan])},
    ],
)
def test_a_wind_that_cannot_be_is_refused(options):
    with pytest.raises(OptionError):
        Wind(**{"velocity": (0, 0, 1.0), **options})


def test_phases_must_fit_the_batch():
    with pytest.raises(OptionError, match="3 cloths"):
        lower_winds([Wind((0, 0, 1.0), phases=np.zeros(2))], 3)
