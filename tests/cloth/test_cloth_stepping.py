"""Cloth stepped by hand: the motion of `simulate`, with forces that may change on the way."""

import numpy as np
import pytest

from drapery.cloth import (
    Collider,
    Collisions,
    Force,
    Gravity,
    MovingCloth,
    Plane,
    Wind,
    grid,
)
from drapery.errors import OptionError

CLOTH = grid(5, 9, 0.8, 1.6)
WALL = Collisions((Collider(Plane(np.array([0.0, 0, 0.1]), np.array([0.0, 0, -1]))),), 0.02)
FORCES: tuple[Force, ...] = (Gravity(), Wind((0.0, 0.0, 6.0)))


def test_forces_act_from_the_step_for_which_they_are_given() -> None:
    begun = MovingCloth.begin(CLOTH)
    calm, windy = (begun.advance(forces, 20) for forces in ((Gravity(),), FORCES))
    assert np.ptp(calm.state.positions[..., 2]) < 1e-6
    assert windy.state.positions[0, -1, 2] > 0.05
    assert begun.state.time == 0  # an advance changes nothing that was there before
    later = windy.advance((Gravity(),), 20)
    assert later.state.time == pytest.approx(40 / 60)


@pytest.mark.parametrize("steps", [0, -1, 1.5, "two"])
def test_a_count_of_steps_is_a_whole_number_above_zero(steps) -> None:
    with pytest.raises(OptionError, match="steps"):
        MovingCloth.begin(CLOTH, collisions=WALL).advance(FORCES, steps)
