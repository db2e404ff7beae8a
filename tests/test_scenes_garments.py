"""Garments stay on, hang with the walk, and never enter the one who wears them."""

import numpy as np
from scene_truths import clearance, still

from drapery.cloth import max_stretch
from drapery.scenes import cape
from drapery.scenes.catalogue import Shot
from drapery.scenes.gait import LEG, Gait
from drapery.style.figure import PARTS, TEXEL
from drapery.testing.plugin import Golden

STRIDE = Shot((64, 64), 16, 20.0)


def test_the_lower_foot_of_a_walk_stays_on_the_ground() -> None:
    gait = Gait()
    for time in np.linspace(0, gait.period, 9):
        low = []
        for leg in ("right_leg", "left_leg"):
            position, rotation = gait.poses(float(time))[leg]
            part = PARTS[leg]
            corners = part.centre + part.extent / 2 * np.array([[1, -1, 1], [1, -1, -1]])
            low.append((corners @ rotation.T + position)[:, 1].min())
        assert abs(min(low)) < 1e-9


def test_a_foot_goes_back_as_far_as_the_ground() -> None:
    gait = Gait(speed=2.0)
    step = 2 * LEG * np.sin(np.radians(gait.swing))
    assert np.isclose(step, gait.speed * gait.period / 2)


def test_a_cape_stays_on_and_out_of_the_body() -> None:
    parameters, gait = cape.Parameters(), Gait()
    cloth = cape.cape_cloth(parameters.grid)
    for state in cape.walk(parameters, cloth, gait, STRIDE):
        pins = gait.pins(cloth)(state.time)
        np.testing.assert_allclose(state.positions[0][cloth.inv_mass == 0], pins, atol=1e-9)
        assert clearance(cloth, state, gait.colliders(cape.BODY)) > 0.45 * TEXEL
        assert max_stretch(state.positions, cloth) < 0.1
        assert state.positions[0][-1, 2] < -0.2  # the walk blows it backwards


def test_a_walk_in_a_cape_ends_as_it_began() -> None:
    cloth, loop = cape.cape_cloth((6, 9)), Shot((64, 64), 81, 20.0)
    states = list(cape.walk(cape.Parameters(), cloth, Gait(), loop))
    apart = np.abs(states[-1].positions - states[0].positions).max()
    step = np.abs(states[1].positions - states[0].positions).max()
    assert apart < step  # the seam of the loop is no wider than a step between frames


def test_cape(golden: Golden) -> None:
    golden(still("cape", 3), "cape")
