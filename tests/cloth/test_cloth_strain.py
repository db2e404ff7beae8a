"""No allowed setting draws cloth with edges over their limit; see `drapery.cloth.strain`."""

from itertools import islice

import numpy as np
import pytest
import trimesh
from scene_helpers import flag_of

from drapery import Settings
from drapery.cloth import (
    Box,
    Capsule,
    Collider,
    Collisions,
    Gravity,
    MovingCloth,
    SolverDesbrun,
    SolverXPBD,
    Sphere,
    grid,
    max_stretch,
    mesh_collider,
    simulate,
    straight,
)
from drapery.cloth.colliders.check import sample_distances
from drapery.cloth.solvers.registry import SOLVERS
from drapery.cloth.strain import (
    HELD_TO,
    MOST_STRETCH,
    NEVER,
    allowed_stretch,
    limit_strain,
    strain_limit,
)
from drapery.stage.recording import Drape, Schedule, record

SMALL = {"grid": (9, 17)}
STORMS = [
    *({"solver": name, "fabric": "silk", "wind": 30.0, "gusts": 2.0, **SMALL} for name in SOLVERS),
    {"solver": "implicit", "fabric": "wool", "wind": 20.0},
    {"solver": "implicit", "fabric": "linen", "pins": "none", **SMALL},
    {"solver": "pbd", "fabric": "silk", "wind": 20.0, "gusts": 2.0},
    {"solver": "desbrun", "fabric": "silk", "wind": 40.0, "direction": 90.0},
    {"thickness": 8.0},
    {"solver": "provot", "fabric": "leather", "thickness": 8.0, "wind": 0.0, **SMALL},
    {"solver": "verlet", "placement": "wall", "wind": 40.0, "direction": 180.0, **SMALL},
]


@pytest.mark.parametrize("options", STORMS, ids=str)
def test_a_storm_leaves_no_edge_over_its_limit(options):
    settings = Settings(**options)
    moving, forces = flag_of(settings)
    for _ in range(6):
        moving = moving.advance(forces, 15)
        positions = moving.state.positions[0].astype(float)
        assert 1 + max_stretch(positions, moving.cloth) <= MOST_STRETCH + 1e-5
        assert moving.state.strain == 0.0


def stretched(amount):
    """A hanging grid whose lower half is farther away than its springs allow."""
    cloth = grid(5, 9, 0.5, 1.0)
    x = cloth.rest_positions.copy()
    x[20:, 1] -= amount
    return cloth, x


def test_springs_that_are_too_long_are_shortened_and_others_keep_their_bits():
    cloth, x = stretched(0.5)
    limit = strain_limit(cloth, MOST_STRETCH)
    start = x.copy()
    assert limit_strain(start, x, limit) == 1
    assert 1 + max_stretch(x, cloth) <= MOST_STRETCH
    within = x.copy()
    assert limit_strain(start, within, limit) == 0
    assert (within == x).all()


def test_a_solver_may_ask_for_more():
    assert allowed_stretch(1.02, 3) == MOST_STRETCH
    assert allowed_stretch(1.5, 3) == 1.5
    assert strain_limit(grid(3, 3, 1.0, 1.0), allowed_stretch(1.02, 0)) is NEVER


def test_pins_that_move_apart_are_told():
    cloth = grid(5, 5, 1.0, 1.0, pins="corners")

    def apart(time):
        return cloth.rest_positions[cloth.inv_mass == 0] * (1 + 4 * time)

    states = simulate(cloth, SolverDesbrun(), pins=apart, every=12)
    assert next(states).strain == 0.0
    told = r"apart: at 0.2 s the edge between particles 0 and 1 at \(-0.59.* m was [\d.]+ % longer"
    with pytest.warns(UserWarning, match=told):
        strain = next(states).strain
    assert strain > 0.2
    assert next(states).strain > strain  # without a second warning


def apart_and_back(cloth):
    """A path on which pins are farthest from each other at 0.1 s, and at rest again at 0.2 s."""
    return lambda time: cloth.rest_positions[cloth.inv_mass == 0] * (1 + 6 * min(time, 0.2 - time))


FAR = np.array([0.0, -9.0, 0.0])
MEETINGS = {
    "nothing": None,
    "a box": Collisions((Collider(Box(FAR, np.ones(3))),)),
    "a ball": Collisions((Collider(Sphere(FAR, 1.0)),)),
    "itself": Collisions(apart=0.01),
    "a box and itself": Collisions((Collider(Box(FAR, np.ones(3))),), apart=0.01),
}


@pytest.mark.parametrize("columns", [5, 17])
@pytest.mark.parametrize("meeting", MEETINGS)
def test_the_worst_moment_is_told_and_not_the_first_or_the_last(meeting, columns):
    cloth = grid(columns, 5, 1.0, 1.0, pins="corners")
    begun = MovingCloth.begin(cloth, SolverDesbrun(), collisions=MEETINGS[meeting])
    path = apart_and_back(cloth)
    farthest = begun.unmet((Gravity(),), 6, path).state
    worst = farthest.worst
    i, j = worst.particles
    ends = farthest.positions[0, [i, j]].astype(float)
    assert worst.time == pytest.approx(0.1)
    assert worst.cloth == 0
    assert worst.place == pytest.approx(ends.mean(axis=0).tolist(), abs=1e-6)
    rest = np.linalg.norm(cloth.rest_positions[i] - cloth.rest_positions[j])
    length = np.linalg.norm(ends[1] - ends[0])
    assert worst.over == pytest.approx(length / rest / MOST_STRETCH - 1, abs=1e-5)
    with pytest.warns(UserWarning, match=f"at 0.1 s the edge between particles {i} and {j} "):
        state = begun.advance((Gravity(),), 12, path).state
    assert state.worst == worst
    assert state.strain == worst.over


def test_a_recorded_motion_is_told_once_of_its_worst_moment():
    cloth = grid(5, 5, 1.0, 1.0, pins="corners")
    drape = Drape(
        lambda dt: MovingCloth.begin(cloth, SolverDesbrun(), dt),
        lambda period: (Gravity(),),
        apart_and_back(cloth),
    )
    with pytest.warns(UserWarning, match=r"cloth 0 apart: at 0\.1 s the edge") as told:
        record([drape], Schedule(1 / 60, 2, range(7), tuple(n / 30 for n in range(7))))
    assert len(told) == 1


def ball_of_triangles():
    ball = trimesh.creation.icosphere(subdivisions=1, radius=0.25)
    return mesh_collider(ball.vertices + np.array([0.0, -1.0, -0.6]), ball.faces)


SHAPES = {
    "sphere": Sphere(np.array([0.0, -1.0, -0.6]), 0.25),
    "capsule": Capsule(np.array([-0.6, -1.0, -0.5]), np.array([0.6, -1.0, -0.5]), radius=0.12),
    "mesh": ball_of_triangles(),
}


@pytest.mark.parametrize("method", [SolverXPBD(), SolverDesbrun()], ids=lambda m: type(m).__name__)
@pytest.mark.parametrize("name", SHAPES)
def test_a_fast_body_passes_under_the_cloth_and_does_not_stretch_it(name, method):
    body, cloth = Collider(SHAPES[name], straight((0.0, 0.0, 4.0))), grid(11, 17, 0.9, 1.5)
    moving = MovingCloth.begin(cloth, method, collisions=Collisions((body,), thickness=0.02))
    farthest = 0.0
    for _ in range(24):
        moving = moving.advance((Gravity(),))
        places = moving.state.positions[0].astype(float)
        assert 1 + max_stretch(places, cloth) <= MOST_STRETCH * (1 + HELD_TO)
        local = np.ascontiguousarray(places - body.path(moving.state.time).position)
        assert sample_distances(body.packed, local).min() > 0.0095, "it keeps half its thickness"
        farthest = max(farthest, places[:, 2].max())
    assert moving.state.strain == 0.0
    assert farthest > 0.3, "the body took the cloth with it"


def test_a_body_that_is_driven_through_pinned_cloth_is_told_once():
    body = Collider(Sphere(np.array([0.0, 0.0, -0.4]), 0.2), straight((0.0, 0.0, 3.0)))
    states = simulate(grid(7, 9, 0.9, 1.5), collisions=Collisions((body,)), every=6)
    with pytest.warns(UserWarning, match="pins or colliders pull cloth 0 apart") as told:
        *_, last = islice(states, 4)
    assert len(told) == 1
    assert last.strain > 1.0


FLAT = [{"solver": "xpbd"}, {"solver": "xpbd", "placement": "wall"}, {"solver": "pbd"}]


@pytest.mark.parametrize("options", FLAT, ids=str)
def test_wind_exactly_along_the_cloth_does_not_leave_it_flat(options):
    settings = Settings(wind=40.0, gusts=0.0, direction=90.0, **SMALL, **options)
    moving, forces = flag_of(settings)
    places = moving.advance(forces, 120).state.positions[0]
    across = np.linalg.svd(places - places.mean(axis=0), full_matrices=False)[1][2]
    assert across / np.sqrt(len(places)) > 0.01, "rms distance from the plane that fits best"
