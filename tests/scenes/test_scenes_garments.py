"""Garments stay on, move with the walk, and never enter the body of the figure."""

import numpy as np
import pytest
from scene_helpers import clearance

from drapery.cloth import max_stretch, rotation_about
from drapery.errors import OptionError
from drapery.mesh import vertex_normals
from drapery.scenes import cape, scarf, skirt
from drapery.scenes.catalogue import Clip, find_scene
from drapery.stage.gait import LEG, Gait
from drapery.style.extrusion import boundary_edges
from drapery.style.figure import PARTS, TEXEL

STRIDE = Clip((64, 64), 16, 20.0)


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


def test_a_walk_turns_limbs_by_the_bits_of_any_rotation() -> None:
    gait = Gait()
    times = np.linspace(0, gait.period, 9)
    leg = gait.poses.path("right_leg").at(times)[:, 3:].reshape(-1, 3, 3)
    assert np.array_equal(leg, rotation_about((1, 0, 0), gait.turn(times)))


def test_a_foot_moves_back_as_far_as_the_ground() -> None:
    gait = Gait(speed=2.0)
    step = 2 * LEG * np.sin(np.radians(gait.swing))
    assert np.isclose(step, gait.speed * gait.period / 2)


def test_a_cape_stays_on_and_out_of_the_body() -> None:
    parameters, gait = cape.CapeParameters(), Gait()
    sewn = cape.cape_cloth(parameters)
    cloth = sewn.cloth
    for state in cape.cape_states(parameters, sewn, gait, STRIDE):
        pins = sewn.pin_path(gait.poses)(state.time)
        np.testing.assert_allclose(state.positions[0][cloth.inv_mass == 0], pins, atol=1e-9)
        assert clearance(cloth, state, gait.colliders(sewn.solid)) > 0.45 * TEXEL
        assert max_stretch(state.positions, cloth) < 0.1
        assert state.positions[0][-1, 2] < -0.2  # the walk blows it backwards


def test_a_walk_in_a_cape_ends_as_it_began() -> None:
    parameters, loop = cape.CapeParameters(), Clip((64, 64), 81, 20.0)
    sewn = cape.cape_cloth(parameters)
    states = list(cape.cape_states(parameters, sewn, Gait(), loop))
    apart = np.abs(states[-1].positions - states[0].positions).max()
    step = np.abs(states[1].positions - states[0].positions).max()
    assert apart < step  # the seam of the loop is no wider than a step between frames


@pytest.mark.parametrize("place", [0, 1])
def test_a_scarf_stays_on_and_out_of_the_body(place) -> None:
    parameters, gait = scarf.ScarfParameters(), Gait()
    sewn = scarf.tails(parameters)[place]
    cloth = sewn.cloth
    for state in scarf.tail_states(parameters, sewn, gait, STRIDE):
        pins = sewn.pin_path(gait.poses)(state.time)
        np.testing.assert_allclose(state.positions[0][cloth.inv_mass == 0], pins, atol=1e-9)
        assert clearance(cloth, state, gait.colliders(tuple(PARTS))) > 0
        assert state.positions[0, -1, 2] < -0.5  # it streams behind
        assert state.positions[0, :, 1].min() > 0  # and off the ground


def test_a_skirt_stays_on_and_is_moved_by_the_legs_alone() -> None:
    parameters, gait = skirt.SkirtParameters(), Gait(2.0)
    sewn = skirt.skirt_cloth(parameters)
    cloth = sewn.cloth
    states = list(skirt.skirt_states(parameters, sewn, gait, STRIDE))
    for state in states:
        pins = sewn.pin_path(gait.poses)(state.time)
        np.testing.assert_allclose(state.positions[0][cloth.inv_mass == 0], pins, atol=1e-9)
        assert clearance(cloth, state, gait.colliders(sewn.solid), order=3) > 0
        assert max_stretch(state.positions, cloth) < 0.15
    hem = np.stack([state.positions[0, -parameters.panels :] for state in states])
    assert np.ptp(hem[..., 2], axis=0).max() > 0.05


def test_a_skirt_is_a_closed_ring_seen_from_outside() -> None:
    cloth = skirt.skirt_cloth(skirt.SkirtParameters()).cloth
    assert len(boundary_edges(cloth.triangles)) == 2 * 24  # waist and hem
    outwards = vertex_normals(cloth.rest_positions, cloth.triangles)
    level = cloth.rest_positions * [1, 0, 1]
    assert (np.sum(outwards * level, axis=1) > 0).all()


@pytest.mark.parametrize(
    ("words", "fault"),
    [({"panels": "3"}, "panels"), ({"sides": "outside under"}, "under"), ({"dye": "sky"}, "sky")],
)
def test_a_parameter_that_a_skirt_cannot_have_is_named(words, fault) -> None:
    scene = find_scene("skirt")
    with pytest.raises(OptionError, match=fault):
        next(scene.play(scene.parameters(words), STRIDE))
