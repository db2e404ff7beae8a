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
    World,
    grid,
    max_stretch,
    rest_state,
    simulate,
)
from drapery.cloth.colliders import (
    Collider,
    Plane,
    Sphere,
    Voxels,
    mesh_collider,
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


DRAPED = [*((name, "sphere") for name in SOLVERS), ("xpbd", "insect"), ("xpbd", "voxels")]


@pytest.mark.parametrize(("name", "shape"), DRAPED)
def test_a_cloth_drapes_and_never_passes_through(name, shape):
    cloth = grid(10, 10, 1.2, 1.2, pins="none")
    collisions = Collisions(
        [Collider(SHAPES[shape], friction=0.6), Collider(FLOOR, friction=0.6)],
        THICKNESS,
        order=3,
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
