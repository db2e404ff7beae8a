"""Cloths of every solver fall on things, lie still on them and never pass through."""

import itertools
import re
from dataclasses import replace
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
import trimesh

from drapery import Settings
from drapery.cloth import (
    Drag,
    Gravity,
    MovingCloth,
    Wind,
    World,
    grid,
    max_stretch,
    rest_state,
    simulate,
)
from drapery.cloth.colliders import (
    Capsule,
    Collider,
    Plane,
    Sphere,
    Voxels,
    mesh_collider,
    swinging,
)
from drapery.cloth.colliders.check import sample_distances
from drapery.cloth.colliders.packing import pack
from drapery.cloth.collisions import Collisions
from drapery.cloth.solvers.registry import DEFAULT_SOLVER, SOLVERS, solver
from drapery.errors import OptionError
from drapery.settings import SolverName

THICKNESS = 0.03
FLOOR = Plane(np.array([0, -0.9, 0]), np.array([0.0, 1, 0]))


def insect():
    """A head, a body, a tail and six legs, merged into one mesh of overlapping parts."""

    def egg(size, place):
        mesh = trimesh.creation.icosphere(subdivisions=1)
        return mesh.apply_scale(size).apply_translation(place)

    parts = [
        egg((0.22, 0.16, 0.3), (0, 0, 0)),
        egg((0.14, 0.12, 0.14), (0, 0.05, 0.34)),
        egg((0.2, 0.18, 0.3), (0, 0.04, -0.42)),
    ]
    for side in (-1, 1):
        for z in (-0.15, 0.0, 0.15):
            leg = trimesh.creation.capsule(radius=0.04, height=0.4, count=(6, 8))
            leg.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], [side, -0.6, 0.0]))
            parts.append(leg.apply_translation([side * 0.18, -0.02, z]))
    mesh = trimesh.util.concatenate(parts)
    return mesh_collider(mesh.vertices, mesh.faces)


SHAPES = {
    "sphere": Sphere(np.array([0, -0.2, 0]), 0.4),
    "insect": insect(),
    "voxels": Voxels(
        np.array([[-1, -1, -1], [0, -1, -1], [-1, -1, 0], [0, -1, 0], [-1, 0, -1]]), 0.3
    ),
}


def level(cloth, height):
    """The cloth at rest, laid level about the y axis."""
    state = rest_state(cloth)
    places = state.positions[..., [0, 2, 1]] * np.array([1, 1, -1], np.float32)
    places = places - places.mean(axis=1, keepdims=True)
    places[..., 1] += height
    return replace(state, positions=np.ascontiguousarray(places))


def gaps(shape, points):
    """Signed distances [m] to a shape."""
    return sample_distances(pack(shape), np.ascontiguousarray(points, float))


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(("name", "side"), [*((name, 10) for name in SOLVERS), ("desbrun", 20)])
def test_a_cloth_drapes_and_never_passes_through(name, side, shape):
    cloth = grid(side, side, 1.2, 1.2, pins="none")
    collisions = Collisions(
        [Collider(SHAPES[shape], friction=0.6), Collider(FLOOR, friction=0.6)],
        THICKNESS,
        order=3 if side == 10 else 2,
    )
    forces = [Gravity(), Drag(2.0)]
    start = level(cloth, 0.45)
    places = []
    for state in itertools.islice(
        simulate(cloth, solver(name), forces, start=start, collisions=collisions, every=15), 16
    ):
        places.append(state.positions[0].astype(float))
        worst = min(gaps(SHAPES[shape], places[-1]).min(), gaps(FLOOR, places[-1]).min())
        assert worst >= THICKNESS / 2 - 1e-5
    # Points inside the faces may dip into the cloth's own half thickness, no further.
    shares = np.random.default_rng(0).dirichlet([1, 1, 1], size=2)
    faces = (shares @ places[-1][cloth.triangles]).reshape(-1, 3)
    assert gaps(SHAPES[shape], faces).min() > 0
    # It still lies on top, has come to rest but for a slow slide, and is whole.
    assert places[-1][:, 1].max() > SHAPE_TOPS[shape]
    assert np.abs(places[-1] - places[-2]).max() < 0.1
    assert max_stretch(state.positions, cloth) < 0.45


SHAPE_TOPS = {"sphere": 0.2, "insect": 0.15, "voxels": 0.3}


@pytest.mark.parametrize("name", SOLVERS)
def test_a_hanging_cloth_is_kicked_by_a_walking_leg(name):
    cloth = grid(7, 9, 0.6, 0.8)
    leg = Capsule(np.array([0.0, 0.2, -0.25]), np.array([0.0, -0.7, -0.25]), 0.07)
    path = swinging((0.0, 0.2, -0.25), 35, 0.8, 0.0)
    collisions = Collisions([Collider(leg, path)], 0.02, order=3)
    pushed = 0.0
    states = simulate(cloth, solver(name), [Gravity(), Drag(0.5)], collisions=collisions, every=4)
    for state in itertools.islice(states, 1, 30):
        pose = path(state.time)
        local = (state.positions[0] - pose.position) @ pose.rotation
        assert gaps(leg, local).min() >= 0.01 - 1e-5
        pushed = max(pushed, float(state.positions[0, :, 2].max()))
    assert pushed > 0.1
    np.testing.assert_array_equal(state.positions[0, :7], rest_state(cloth).positions[0, :7])


def test_a_batch_that_collides_equals_its_cloths_alone():
    cloth = grid(6, 6, 0.8, 0.8)
    ball = Sphere(np.array([0.1, -0.4, 0.2]), 0.18)
    phases = np.arange(4) * 0.7
    start = rest_state(cloth, 4)

    def after(chosen, threads):
        wind = Wind((0.0, 0.0, 3.0), phases=phases[chosen])
        part = replace(
            start, positions=start.positions[chosen], velocities=start.velocities[chosen]
        )
        collisions = Collisions([Collider(ball)], 0.02, threads=threads, apart=0.05)
        return next(
            itertools.islice(
                simulate(
                    cloth,
                    solver("pbd", threads=threads),
                    [Gravity(), wind],
                    start=part,
                    collisions=collisions,
                    every=40,
                ),
                1,
                None,
            )
        )

    together = after(slice(0, 4), 2)
    for b in range(4):
        alone = after(slice(b, b + 1), 1)
        np.testing.assert_array_equal(alone.positions[0], together.positions[b])
        np.testing.assert_array_equal(alone.velocities[0], together.velocities[b])


def test_solvers_are_found_by_name_with_their_options():
    for name in SOLVERS:
        assert type(solver(name, threads=1)).__module__.endswith(f".{name}")
    assert tuple(SOLVERS) == get_args(SolverName)
    with pytest.raises(OptionError, match="use one of: desbrun, xpbd"):
        solver("euler")
    with pytest.raises(OptionError, match="solver pbd has no option 'glue'; use one of: passes"):
        solver("pbd", glue=1)


def test_the_default_solver_is_the_same_everywhere():
    assert solver() == MovingCloth.begin(grid(3, 3, 1.0, 1.0)).solver == World().solver
    assert Settings().solver == DEFAULT_SOLVER


def test_the_pages_on_solvers_and_contact_run_as_they_are_written():
    folder = Path(__file__).parents[2] / "docs" / "explanation"
    page = "".join((folder / f"{name}.md").read_text("utf-8") for name in ("solvers", "contact"))
    names: dict[str, object] = {}
    for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL):
        exec(block.replace("180", "3"), names)
    assert len(names["cloth"].inv_mass) == 11 * 21
    first, second = itertools.islice(names["states"], 2)
    assert second.time > first.time
