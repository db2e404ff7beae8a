"""Cloths of every shape are what they say, and what cannot be is refused in one line."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest
import trimesh

from drapery.cloth import (
    FLEXION,
    SHEAR,
    STRUCTURAL,
    Cloth,
    Fabric,
    Gravity,
    Seam,
    SolverDesbrun,
    SolverXPBD,
    State,
    Wind,
    disc,
    from_mesh,
    from_triangles,
    grid,
    max_stretch,
    rest_state,
    sew,
    simulate,
    strip,
)
from drapery.cloth.builders import spring_lengths
from drapery.errors import OptionError
from drapery.mesh import face_normals


def area(cloth):
    return np.linalg.norm(face_normals(cloth.rest_positions, cloth.triangles), axis=1).sum() / 2


def mass(cloth):
    return (1 / cloth.inv_mass[cloth.inv_mass > 0]).sum()


def euler(cloth):
    """Vertices - edges + faces."""
    return len(cloth.inv_mass) - (cloth.spring_kind == STRUCTURAL).sum() + len(cloth.triangles)


def test_a_grid_hangs_from_its_top_row_facing_forward():
    cloth = grid(5, 9, 0.8, 1.6)
    x = cloth.rest_positions.reshape(9, 5, 3)
    assert (x[0, :, 1] == 0).all() and (x[..., 2] == 0).all()
    assert x[0, -1, 0] - x[0, 0, 0] == pytest.approx(0.8)
    assert x[-1, 0, 1] == pytest.approx(-1.6)
    np.testing.assert_array_equal(cloth.uvs[[0, 4, -1]], [[0, 0], [1, 0], [1, 1]])
    assert (face_normals(cloth.rest_positions, cloth.triangles)[:, 2] > 0).all()
    np.testing.assert_array_equal(np.flatnonzero(cloth.inv_mass == 0), np.arange(5))
    counts = np.bincount(cloth.spring_kind)
    assert counts[STRUCTURAL] == 4 * 9 + 5 * 8
    assert counts[SHEAR] == 2 * 4 * 8
    assert counts[FLEXION] == 3 * 9 + 5 * 7
    assert mass(grid(5, 9, 0.8, 1.6, pins="none")) == pytest.approx(0.3 * 0.8 * 1.6)
    assert area(cloth) == pytest.approx(0.8 * 1.6)


def test_springs_are_at_rest_in_the_rest_shape():
    sphere = from_mesh(trimesh.creation.icosphere(2))
    for cloth in (grid(5, 9, 0.8, 1.6), disc(3, 1.0), strip(7, 1.0), sphere):
        np.testing.assert_allclose(spring_lengths(cloth.rest_positions, cloth), cloth.spring_length)
        assert max_stretch(cloth.rest_positions, cloth) == pytest.approx(0)


def test_a_disc_is_whole_round_and_faces_up():
    cloth = disc(6, 0.5, fabric=Fabric(2.0))
    assert len(cloth.inv_mass) == 1 + 3 * 6 * 7
    assert euler(cloth) == 1
    assert (face_normals(cloth.rest_positions, cloth.triangles)[:, 1] > 0).all()
    assert area(cloth) == pytest.approx(np.pi / 4, rel=0.01)
    assert mass(cloth) == pytest.approx(2.0 * area(cloth))
    np.testing.assert_allclose(np.linalg.norm(cloth.uvs - 0.5, axis=1).max(), 0.5)


def test_a_mesh_gets_each_edge_once_and_a_bend_across_each_inner_one():
    ball = trimesh.creation.icosphere(2)
    cloth = from_mesh(ball, fabric=Fabric(1.0))
    assert (cloth.spring_kind == STRUCTURAL).sum() == len(ball.edges_unique)
    assert (cloth.spring_kind == FLEXION).sum() == len(ball.face_adjacency)
    assert euler(cloth) == 2
    assert mass(cloth) == pytest.approx(ball.area)


def test_a_loaded_file_is_sewn_along_the_seams_of_its_texture(tmp_path):
    box = trimesh.creation.box()
    apart = trimesh.Trimesh(
        box.triangles.reshape(-1, 3), np.arange(36).reshape(-1, 3), process=False
    )
    path = tmp_path / "box.ply"
    apart.export(path)
    assert len(from_mesh(str(path)).inv_mass) == 8


def test_two_halves_sewn_are_the_whole():
    left = grid(3, 4, 0.5, 1.0)
    right = replace(left, rest_positions=left.rest_positions + np.array([0.5, 0, 0]))
    edge = [2, 5, 8, 11]
    sewn = sew([left, right], [Seam(0, edge, 1, [0, 3, 6, 9])])
    whole = grid(5, 4, 1.0, 1.0)
    assert len(sewn.inv_mass) == len(whole.inv_mass)
    assert euler(sewn) == euler(whole)
    assert area(sewn) == pytest.approx(area(whole))
    pinned = sewn.rest_positions[sewn.inv_mass == 0]
    assert (pinned[:, 1] == 0).all() and len(pinned) == 5
    lengths = spring_lengths(sewn.rest_positions, sewn)
    np.testing.assert_allclose(lengths, sewn.spring_length)


@pytest.mark.parametrize(
    "pins, expected",
    [
        ("none", []),
        ("top", [0, 1, 2]),
        ("corners", [0, 2]),
        ("three-corners", [0, 2, 9]),
        ("four-corners", [0, 2, 9, 11]),
        ([7, 3], [3, 7]),
        (lambda x: x[:, 0] > 0.4, [2, 5, 8, 11]),
    ],
)
def test_pins_by_name_number_or_predicate(pins, expected):
    cloth = grid(3, 4, 1, 1, pins=pins)
    np.testing.assert_array_equal(np.flatnonzero(cloth.inv_mass == 0), expected)


def made(**changes):
    return replace(grid(3, 3, 1, 1), **changes)


GRID = grid(3, 3, 1, 1)
WRONG = {
    "one column": lambda: grid(1, 3, 1, 1),
    "no width": lambda: grid(3, 3, 0, 1),
    "nan width": lambda: grid(3, 3, np.nan, 1),
    "too many": lambda: grid(2000, 2000, 1, 1),
    "pin outside": lambda: grid(3, 3, 1, 1, pins=[9]),
    "pin below": lambda: grid(3, 3, 1, 1, pins=[-1]),
    "pin twice": lambda: grid(3, 3, 1, 1, pins=[1, 1]),
    "pin name": lambda: grid(3, 3, 1, 1, pins="left"),
    "pin half": lambda: grid(3, 3, 1, 1, pins=[0.5]),
    "corners of a strip": lambda: strip(3, 1.0, pins="corners"),
    "predicate": lambda: grid(3, 3, 1, 1, pins=lambda x: x),
    "stiffness nan": lambda: grid(3, 3, 1, 1, fabric=Fabric(0.3, np.nan, 1, 1)),
    "stiffness negative": lambda: grid(3, 3, 1, 1, fabric=Fabric(0.3, -1, 1, 1)),
    "stiffness absurd": lambda: grid(3, 3, 1, 1, fabric=Fabric(0.3, 1e30, 1, 1)),
    "bending negative": lambda: Fabric(bending=-1e-5),
    "damping endless": lambda: Fabric(damping=np.inf),
    "friction nan": lambda: Fabric(friction=np.nan),
    "stiffness text": lambda: Fabric(flexion="soft"),
    "drag negative": lambda: Fabric(drag=-1.0),
    "density zero": lambda: Fabric(density=0.0),
    "density huge": lambda: Fabric(density=10**400),
    "fabric number": lambda: grid(3, 3, 1, 1, fabric=0.3),
    "columns half": lambda: grid(2.5, 3, 1, 1),
    "drags differ": lambda: sew([GRID, replace(GRID, drag=0.5)]),
    "rest nan": lambda: made(rest_positions=GRID.rest_positions * np.nan),
    "mass inf": lambda: made(inv_mass=GRID.inv_mass + np.inf),
    "mass negative": lambda: made(inv_mass=GRID.inv_mass - 1),
    "length zero": lambda: made(spring_length=GRID.spring_length * 0),
    "spring outside": lambda: made(spring_pairs=GRID.spring_pairs + 1),
    "springs short": lambda: made(spring_length=GRID.spring_length[1:]),
    "triangle outside": lambda: made(triangles=GRID.triangles - 1),
    "grid shape": lambda: made(grid_shape=(3, 4)),
    "no triangles": lambda: from_triangles(np.zeros((3, 3)), np.zeros((0, 3), int)),
    "flat triangle": lambda: from_triangles(np.zeros((3, 3)), np.array([[0, 1, 2]])),
    "no mesh": lambda: from_mesh("nowhere.obj"),
    "seam": lambda: sew([GRID, GRID], [Seam(0, [0], 1, [0, 1])]),
    "seam outside": lambda: sew([GRID, GRID], [Seam(0, [0], 1, [99])]),
    "sew nothing": lambda: sew([]),
    "no cloths": lambda: rest_state(GRID, 0),
    "half precision": lambda: rest_state(GRID, 1, np.float16),
    "dt zero": lambda: simulate(GRID, dt=0.0),
    "dt below": lambda: simulate(GRID, dt=-1.0),
    "dt nan": lambda: simulate(GRID, dt=np.nan),
    "dt text": lambda: simulate(GRID, dt="fast"),
    "no step": lambda: simulate(GRID, every=0),
    "half a step": lambda: simulate(GRID, every=0.5),
    "no cloth": lambda: simulate(None),
    "solver class": lambda: simulate(GRID, SolverXPBD),
    "solver name": lambda: simulate(GRID, "xpbd"),
    "forces none": lambda: simulate(GRID, forces=None),
    "force at the call": lambda: simulate(GRID, forces=["wind"]),
    "pins at the call": lambda: simulate(GRID, pins="top"),
    "start at the call": lambda: simulate(GRID, start=GRID),
    "start of whole numbers": lambda: simulate(GRID, start=State(*np.zeros((2, 1, 9, 3), int))),
    "count text": lambda: simulate(GRID, count="many"),
    "gravity nan": lambda: run(forces=[Gravity((0, np.nan, 0))]),
    "wind 1e20": lambda: Wind((1e20, 0, 0)),
    "wind text": lambda: Wind("north"),
    "wind two": lambda: Wind((1, 2)),
    "wind gusts": lambda: Wind((1, 0, 0), gusts=None),
    "wind seed": lambda: Wind((1, 0, 0), seed=0.5),
    "wind period": lambda: Wind((1, 0, 0), period=1e-300),
    "wind origins": lambda: Wind((1, 0, 0), origins="here"),
    "gravity text": lambda: run(forces=[Gravity("down")]),
    "gravity 1e30": lambda: run(forces=[Gravity((0, 1e30, 0))]),
    "force": lambda: run(forces=["wind"]),
    "path of nothing": lambda: run(pins=lambda time: None),
    "path": lambda: run(pins=lambda time: np.zeros((2, 3))),
    "start nan": lambda: run(start=State(np.full((1, 9, 3), np.nan), np.zeros((1, 9, 3)))),
    "start shape": lambda: run(start=State(np.zeros((1, 8, 3)), np.zeros((1, 8, 3)))),
    "limit": lambda: SolverDesbrun(limit=0.9),
    "limit text": lambda: SolverDesbrun(limit="1"),
    "sweeps": lambda: SolverDesbrun(sweeps=-1),
    "sweeps none": lambda: SolverDesbrun(sweeps=None),
    "threads": lambda: SolverDesbrun(threads=0),
    "threads half": lambda: SolverXPBD(threads=1.5),
    "compliance two": lambda: SolverXPBD(compliance=(0.0, 0.0)),
    "attach": lambda: SolverXPBD(attach=None),
    "pins ragged": lambda: grid(3, 3, 1, 1, pins=[[0], [1, 2]]),
    "triangles ragged": lambda: from_triangles([[0, 0, 0]], [[0], [1, 2]]),
    "columns huge": lambda: grid(10**400, 3, 1, 1),
    "angular": lambda: SolverDesbrun(angular="some"),
    "substeps": lambda: SolverXPBD(substeps=0),
    "compliance": lambda: SolverXPBD(compliance=(-1.0, None, None)),
}


def run(cloth=GRID, **options):
    return next(islice(simulate(cloth, **options), 5, None))


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_be_is_refused_in_one_line(name):
    with pytest.raises(OptionError) as refusal:
        WRONG[name]()
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("solver", [SolverDesbrun(), SolverXPBD()])
@pytest.mark.parametrize(
    "cloth",
    [
        grid(3, 3, 1, 1, pins=range(9)),
        grid(17, 3, 1, 1, pins=lambda x: x[:, 0] < 9),
        grid(2, 2, 1, 1, pins="none"),
        grid(4, 4, 1, 1, fabric=Fabric(0.3, 1e9, 1e9, 1e9)),
        grid(4, 4, 1, 1, fabric=Fabric(0.3, 0.0, 0.0, 0.0)),
        grid(4, 4, 1e-3, 1e-3),
        grid(4, 4, 1e3, 1e3),
        strip(2, 1.0),
        disc(1, 1.0, pins=[0]),
    ],
)
def test_odd_cloths_run(cloth: Cloth, solver):
    end = run(cloth, solver=solver, forces=[Gravity(), Wind((1, 0, 2.0))], every=20)
    assert np.isfinite(end.positions).all() and np.isfinite(end.velocities).all()
