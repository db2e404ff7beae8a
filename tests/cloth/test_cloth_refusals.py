"""Every solver refuses in one line what cannot be, or runs: never garbage without a word."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from drapery.cloth import Drag, Fabric, Gravity, Wind, grid, rest_state, simulate
from drapery.cloth.solvers.registry import SOLVERS, solver
from drapery.errors import OptionError

CLOTH, FALL = grid(4, 5, 1.0, 1.2), (Gravity(),)
each = pytest.mark.parametrize("name", SOLVERS)
no_number = pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])


class Push:
    def __init__(self, size):
        self.size = size

    def acceleration(self, cloth, state):
        return np.full(state.positions.shape, self.size)


def moved(cloth, name="desbrun", forces=FALL, dt=1 / 60, steps=20, **options):
    return next(islice(simulate(cloth, solver(name), forces, dt, every=steps, **options), 1, None))


def with_length(length):
    lengths = CLOTH.spring_length.copy()
    lengths[3] = length
    return replace(CLOTH, spring_length=lengths)


def started(bad):
    state = rest_state(CLOTH)
    state.velocities[0, 7, 1] = bad
    return state


REFUSED = {
    "width": lambda bad: grid(4, 5, bad, 1.0),
    "density": lambda bad: grid(4, 5, 1.0, 1.0, fabric=Fabric(bad)),
    "stiffness": lambda bad: grid(4, 5, 1.0, 1.0, fabric=Fabric(0.3, 5.0, bad, 1.0)),
    "spring": lambda bad: with_length(bad),
    "gravity": lambda bad: moved(CLOTH, forces=[Gravity((0.0, bad, 0.0))]),
    "drag": lambda bad: moved(CLOTH, forces=[Drag(bad)]),
    "wind": lambda bad: Wind((0.0, bad, 1.0)),
    "custom force": lambda bad: moved(CLOTH, forces=[Push(bad)]),
    "dt": lambda bad: moved(CLOTH, dt=bad),
    "start": lambda bad: moved(CLOTH, start=started(bad)),
    "pin path": lambda bad: moved(CLOTH, pins=lambda time: np.full((4, 3), bad)),
}


@no_number
@pytest.mark.parametrize("what", REFUSED)
def test_no_input_may_hold_nan_or_infinity(what, bad):
    with pytest.raises(OptionError) as refusal:
        REFUSED[what](bad)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: with_length(0.0), "spring 3"),
        (lambda: grid(4, 5, 1, 1, pins=[0, 2, 2]), "pin 2 is given twice"),
        (lambda: grid(4, 5, 1, 1, pins=[0, 20]), "pin 20 is not a particle; use 0 to 19"),
        (lambda: grid(4, 5, 1, 1, pins=[-1]), "pin -1"),
        (
            lambda: grid(4, 5, 1, 1, fabric=Fabric(0.3, 1e30, 1.0, 1.0)),
            "fabric stretch 1e\\+30 is out",
        ),
    ],
)
def test_springs_without_length_and_wrong_pins_are_named(make, words):
    with pytest.raises(OptionError, match=words):
        make()


@each
@pytest.mark.parametrize("dt", [0.0, -1 / 60])
def test_time_goes_on(name, dt):
    with pytest.raises(OptionError, match="dt"):
        moved(CLOTH, name, dt=dt)


@each
@pytest.mark.parametrize("columns", [4, 18])
def test_a_cloth_of_pins_alone_stays(name, columns):
    cloth = grid(columns, 5, 1.0, 1.2, pins=lambda rest: rest[:, 0] < 9)
    end = moved(cloth, name, [Gravity(), Wind((1.0, 0.0, 5.0))])
    np.testing.assert_array_equal(end.positions[0], cloth.rest_positions.astype(np.float32))
    assert not end.velocities.any()


@each
@pytest.mark.parametrize("stiffness", [0.0, 1e-30, 1e9])
def test_absurd_stiffness_is_refused_or_runs(name, stiffness):
    cloth = grid(4, 5, 1.0, 1.2, fabric=Fabric(0.3, *(stiffness,) * 3))
    try:
        end = moved(cloth, name)
    except OptionError as refusal:
        assert "stiffness" in str(refusal)
    else:
        assert np.isfinite(end.positions).all() and np.abs(end.positions).max() < 3


@each
def test_what_is_torn_apart_is_an_error(name):
    try:
        end = moved(CLOTH, name, [Gravity(), Wind((1e4, 0.0, 0.0)), Push(1e30)], steps=60)
    except OptionError as refusal:
        assert "use a smaller dt" in str(refusal)
    else:
        assert np.isfinite(end.positions).all() and np.isfinite(end.velocities).all()
