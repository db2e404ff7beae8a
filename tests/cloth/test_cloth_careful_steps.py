"""Steps that are made again with contact in every substep, since cloth would cross itself."""

from itertools import islice
from typing import Any

import numpy as np
import pytest
from contact_cloths import BAR, POLE, UNIT, flag

from drapery.cloth import (
    Box,
    Cloth,
    Collider,
    Collisions,
    Gravity,
    MovingCloth,
    SolverDesbrun,
    SolverProvot,
    SolverXPBD,
    State,
    Wind,
    grid,
    max_stretch,
    simulate,
)
from drapery.cloth.colliders import rotation_about, straight
from drapery.cloth.contact.box_data import HELD, NO_CONTACT
from drapery.cloth.contact.box_frame import set_pose
from drapery.cloth.contact.lanes_contact import contact_work, resolve
from drapery.cloth.contact.self_contact_data import make_self_contact
from drapery.cloth.solvers import desbrun, xpbd
from drapery.cloth.strain import NEVER
from drapery.jit import entry_point
from drapery.mesh import Array

APART = Collisions(apart=UNIT)


@pytest.mark.parametrize(
    ("speed", "apart"),
    [(15.0, UNIT), pytest.param(-10.0, UNIT, marks=pytest.mark.slow), (-10.0, None)],
)
def test_a_storm_does_not_tear_a_fine_banner(speed: float, apart: float | None) -> None:
    """Where contact held cloth once a step, the solver tore at its neighbours: edges became ten
    times as long as at rest, and the banner a heap."""
    cloth = flag((33, 65))
    met = Collisions((POLE, BAR), UNIT, apart=apart)
    forces = Gravity(), Wind((0.0, 0.0, speed), gusts=0.4)
    states = simulate(cloth, SolverXPBD(), forces, every=10, collisions=met)
    assert max(max_stretch(s.positions, cloth) for s in islice(states, 1, 14)) < 0.4


@pytest.mark.parametrize("method", [SolverXPBD, SolverProvot])
@pytest.mark.parametrize("columns", [9, 17])
def test_cloths_whose_step_is_made_again_equal_those_that_are_alone(
    method: Any, columns: int
) -> None:
    """columns: 9 are stepped as lanes of one register, 17 as a plane of lanes."""
    cloth = flag((columns, 17))
    origins = np.arange(18.0).reshape(6, 3)
    crowd = MovingCloth.begin(cloth, method(), count=6, collisions=APART)
    some, each = 0, [MovingCloth.begin(cloth, method(), collisions=APART) for _ in origins]
    for _ in range(60):
        before = crowd.state
        crowd = crowd.advance((Gravity(), storm(origins)))
        each = [one.advance((Gravity(), storm(origins[[k]]))) for k, one in enumerate(each)]
        assert np.array_equal(crowd.state.positions, [one.state.positions[0] for one in each])
        assert np.array_equal(crowd.state.velocities, [one.state.velocities[0] for one in each])
        some += 0 < held(cloth, method(), before, storm(origins)).sum() < 6
    assert some > 0


def storm(origins: Array) -> Wind:
    return Wind((0.0, 0.0, 20.0), gusts=0.8, origins=origins)


def held(cloth: Cloth, method: Any, state: State, wind: Wind) -> Array:
    """Which cloths would be kept from crossing themselves if their step had only one contact."""
    free = MovingCloth.begin(cloth, method, start=state).advance((Gravity(), wind)).state
    itself, codes = make_self_contact(cloth, UNIT), []
    for start, end in zip(state.positions, free.positions, strict=True):
        work = contact_work(NO_CONTACT, len(start), itself)
        work.start[:], work.end[:] = start, end
        codes.append(resolve(work, NO_CONTACT, itself, NEVER, 1))
    return np.array(codes) == HELD


@pytest.mark.parametrize("method", [SolverDesbrun, SolverXPBD])
def test_a_step_is_made_again_in_each_layout(method: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """A plane of lanes of desbrun never made a step again."""
    cloth, start = flag((17, 9)), Box(np.array([0.0, -1.2, -0.2]), np.array([0.8, 0.1, 0.1]))
    bar, ends = Collisions([Collider(start, straight((0.0, 0.0, 12.0)))], UNIT), []
    for layout in ("plane", "lanes"):
        if layout == "lanes":
            for module in (desbrun, xpbd):
                monkeypatch.setattr(module, "is_sheet", lambda cloth: False)
        moving = MovingCloth.begin(cloth, method(substeps=8), collisions=bar)
        ends.append(moving.advance((Gravity(),), 4).state.positions[0])
    way = np.abs(ends[0] - cloth.rest_positions).max()
    assert way > 0.2
    # Only the order of corrections along a row differs.
    assert np.abs(ends[0] - ends[1]).max() < 0.1 * way


@entry_point
def pose(out: Array, first: Array, second: Array, k: int, part: float) -> None:
    set_pose(out, first, second, k, part)


def test_the_poses_of_a_box_in_a_step_are_rotations_between_those_at_its_ends() -> None:
    first, second, out = np.zeros((3, 1, 12))
    first[0, :3], second[0, :3] = (1, 2, 3), (2, 2, 5)
    first[0, 3:] = rotation_about((1, 2, 3), 20).ravel()
    second[0, 3:] = rotation_about((1, 2, 3), 30).ravel()
    for part in (0.0, 0.25, 0.5, 0.75, 1.0):
        pose(out, first, second, 0, part)
        rotation = out[0, 3:].reshape(3, 3)
        assert np.allclose(out[0, :3], (1 + part, 2, 3 + 2 * part))
        assert np.allclose(rotation @ rotation.T, np.eye(3))
        assert np.isclose(np.linalg.det(rotation), 1)
        assert np.allclose(
            rotation, rotation_about((1, 2, 3), 20 + 10 * part), atol=np.radians(10) ** 2 / 8
        )
    assert np.array_equal(out, second)
    second[0, 3:] = rotation_about((0, 1, 0), 180).ravel()
    first[0, 3:] = np.eye(3).ravel()
    pose(out, first, second, 0, 0.5)
    assert np.array_equal(out[0, 3:], first[0, 3:])


@pytest.mark.parametrize(("shape", "thickness"), [((9, 17), 0.2), ((17, 33), 0.1)])
def test_cloth_that_begins_too_near_to_a_box_is_not_thrown(
    shape: tuple[int, int], thickness: float
) -> None:
    """The box stretches it, so its step is made again, and takes it to its distance in one substep:
    at the speed of that motion it would swing up to its pins."""
    box = Collider(Box(np.array([0, -1.3, -0.105]), np.array([2.0, 0.6, 0.2])))
    moving = MovingCloth.begin(
        grid(*shape, 0.8, 1.6), SolverXPBD(), collisions=Collisions([box], thickness)
    )
    for _ in range(30):
        moving = moving.advance((Gravity(),))
        assert moving.state.positions[..., 2].max() < 0.6
