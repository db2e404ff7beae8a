"""What every solver must do, on every layout of its arrays and with every kind of contact.

What only one method promises is in `test_cloth_physics` and `test_cloth_solvers_classic`.
"""

from dataclasses import dataclass
from itertools import pairwise, product
from math import hypot
from typing import Any

import numpy as np
import pytest
import trimesh
from bounds_sweep import contacts, folded, layouts
from scipy.integrate import solve_ivp

from drapery.cloth import (
    SOLVERS,
    STRUCTURAL,
    Box,
    Capsule,
    Cloth,
    Collider,
    Collisions,
    Drag,
    Fabric,
    Force,
    Gravity,
    MovingCloth,
    Plane,
    Pose,
    Solver,
    Sphere,
    State,
    Voxels,
    Wind,
    carried,
    grid,
    max_stretch,
    mesh_collider,
    rest_state,
    rotation_about,
    solver,
    strip,
)
from drapery.cloth.colliders.check import sample_distances
from drapery.cloth.colliders.pose import Path
from drapery.jit import when_numba_compiles
from drapery.mesh import Array

G = 9.81
FALL = Gravity((0.0, -G, 0.0))
each_solver = pytest.mark.parametrize("name", SOLVERS)


def at(state: State, **parts: Any) -> State:
    """A state in double precision with other positions or velocities."""
    shape = state.positions.shape
    positions, velocities = (
        np.broadcast_to(np.asarray(parts.get(name, getattr(state, name)), float), shape).copy()
        for name in ("positions", "velocities")
    )
    return State(positions, velocities)


def after(
    cloth: Cloth, method: Solver, forces: list[Force], dt: float, steps: int, start: State
) -> State:
    moving = MovingCloth.begin(cloth, method, dt, start=start)
    return moving.advance(forces, steps).state


def exact(name: str, **options: Any) -> Solver:
    """A solver that solves its equations to rounding."""
    return solver(name, **({"tolerance": 1e-12} if name == "implicit" else {}), **options)


FREE = [
    *((name, "grid without pins", {}) for name in SOLVERS),
    ("desbrun", "loose plane of lanes", {"angular": "none"}),
    ("provot", "loose plane of lanes", {}),
    ("verlet", "loose plane of lanes", {}),
]


@pytest.mark.parametrize(("name", "layout", "options"), FREE)
def test_a_cloth_without_pins_falls_and_keeps_its_momentum(
    name: str, layout: str, options: dict[str, Any]
) -> None:
    cloth, dt, steps = layouts(name)[layout][0], 1 / 120, 60
    method, rest = exact(name, **options), rest_state(cloth)
    fallen = after(cloth, method, [FALL], dt, steps, at(rest))
    drop = fallen.positions[0, :, 1] - cloth.rest_positions[:, 1]
    # Euler's sums are 1 + 2 + ... + n, Verlet's are exact.
    assert np.abs(drop + G * (steps * dt) ** 2 / 2).max() <= 0.51 * G * steps * dt * dt
    assert np.ptp(drop) < 1e-8
    np.testing.assert_allclose(fallen.velocities[0, :, 1], -G * steps * dt, rtol=1e-8)
    shaken = at(rest, velocities=np.random.default_rng(4).normal(size=rest.positions.shape))
    moved = after(cloth, method, [], dt, steps, shaken)
    speed, mass = shaken.velocities[0].mean(axis=0), len(cloth.inv_mass)
    np.testing.assert_allclose(moved.velocities[0].mean(axis=0), speed, atol=1e-12 * mass)
    way = (moved.positions - shaken.positions)[0].mean(axis=0)
    np.testing.assert_allclose(way, speed * steps * dt, atol=1e-11 * mass)


@each_solver
def test_drag_ends_a_fall_at_g_over_its_rate(name: str) -> None:
    cloth = grid(3, 3, 0.2, 0.2, pins="none")
    end = after(cloth, solver(name), [FALL, Drag(2.0)], 1 / 60, 480, at(rest_state(cloth)))
    np.testing.assert_allclose(end.velocities[0, :, 1], -G / 2.0, rtol=0.02)


INTEGRATORS: dict[str, dict[str, Any]] = {
    "desbrun": {"sweeps": 0},
    "xpbd": {"substeps": 1, "compliance": (None, None, None), "attach": False},
    "pbd": {"substeps": 1, "sweeps": 0},
    "verlet": {"substeps": 1, "sweeps": 0},
    "provot": {"substeps": 1, "sweeps": 0},
    "implicit": {"sweeps": 0, "tolerance": 1e-12},
}
"""Without limits on stretch: the equations alone."""


def elastic_pendulum(_time: float, moved: Array, stiffness: float) -> Array:
    """The derivatives of the place and the velocity of 1 kg on a spring of 1 m, in its plane."""
    x, y, u, v = moved
    pull = -stiffness * (1 - 1 / hypot(x, y))
    return np.array([u, v, pull * x, pull * y - G])


def rigid_pendulum(_time: float, moved: Array) -> Array:
    """The same of its angle and angular velocity, on a rod of 1 m."""
    return np.array([moved[1], -G * np.sin(moved[0])])


@each_solver
def test_the_error_of_a_pendulum_has_the_order_of_the_method(name: str) -> None:
    """Its bob swings on a spring; on a rod with pbd, which has no stiffness in N/m."""
    place, exactly = (0.6, -0.8, 0.0), {"rtol": 1e-12, "atol": 1e-12}
    # The constraint of xpbd is Hooke's law where stretch is small.
    stiffness = 5000.0 if name == "xpbd" else 200.0
    cloth = Cloth(
        rest_positions=np.array([(0.0, 0.0, 0.0), place]),
        inv_mass=np.array([0.0, 1.0]),
        spring_pairs=np.array([[0, 1]], np.int32),
        spring_length=np.array([1.0]),
        spring_stiffness=np.array([stiffness]),
        spring_kind=np.array([STRUCTURAL], np.uint8),
        triangles=np.zeros((0, 3), np.int32),
        uvs=np.zeros((2, 2)),
    )
    if name == "pbd":
        angle = solve_ivp(rigid_pendulum, (0, 1), [np.arcsin(0.6), 0], **exactly).y[0, -1]
        end = np.array([np.sin(angle), -np.cos(angle)])
    else:
        begin, exactly = [*place[:2], 0, 0], exactly | {"args": (stiffness,)}
        end = solve_ivp(elastic_pendulum, (0, 1), begin, **exactly).y[:2, -1]
    errors = []
    for steps in (2000, 4000, 8000):
        method, start = solver(name, **INTEGRATORS[name]), at(rest_state(cloth))
        state = after(cloth, method, [FALL], 1 / steps, steps, start)
        errors.append(np.linalg.norm(state.positions[0, 1, :2] - end))
    order = 2 if name == "verlet" else 1
    assert -np.diff(np.log2(errors)) == pytest.approx([order, order], abs=0.2)


HUNG: dict[str, dict[str, Any]] = {
    "desbrun": {"sweeps": 40},
    "xpbd": {"substeps": 40},
    "pbd": {"substeps": 20, "stiffness": (1.0, 0.0, 0.0)},
    "verlet": {"sweeps": 0},
    "provot": {"sweeps": 0},
    "implicit": {"sweeps": 0},
}


@each_solver
def test_a_chain_between_two_pins_hangs_as_a_catenary(name: str) -> None:
    count, span = 15, 0.7
    stiffness = 50.0 if name in ("desbrun", "xpbd") else 1000.0
    cloth = strip(count, 1.0, pins=[0, count - 1], fabric=Fabric(0.2, stiffness, 1.0, 0.0))
    places = cloth.rest_positions * (span, 0.0, 0.0)
    places[1:-1, 1] = -1e-3
    start, forces = at(rest_state(cloth), positions=places), [FALL, Drag(2.0)]
    hung = after(cloth, solver(name, **HUNG[name]), forces, 1 / 120, 900, start)
    x, y = hung.positions[0, :, 0] - span / 2, hung.positions[0, :, 1]
    assert max_stretch(hung.positions, cloth) < 0.03
    # The catenary of the chain's own length: 2 a sinh(span / 2a), by bisection.
    own = np.hypot(np.diff(x), np.diff(y)).sum()
    low, high = 0.05, 5.0
    for _ in range(60):
        a = (low + high) / 2
        low, high = (a, high) if 2 * a * np.sinh(span / 2 / a) > own else (low, a)
    assert np.abs(y - a * np.cosh(x / a) + a * np.cosh(span / 2 / a)).max() < 0.01 * span


CASES = [
    (name, layout) for name in SOLVERS for layout in layouts(name) if layout != "grid without pins"
]
MET = contacts()
KINDS = ("nothing", "moving box", "sphere", "itself and a moving box", "itself and a sphere")
FINE = 1 / 64
"""A step of which all multiples are exact, so that a call of many steps has the times of many."""
HALVED = {name: {"substeps": 8} for name in ("xpbd", "verlet", "provot")}
"""Substeps that are as exact; the others have them by default."""


@pytest.mark.filterwarnings("ignore:pins or colliders pull")  # of the fast box
@pytest.mark.parametrize(("name", "layout"), CASES)
def test_a_cloth_has_the_same_bits_in_a_crowd_as_alone(name: str, layout: str) -> None:
    """On any number of threads, in one call or in many, on whatever it moves and wherever it is
    held."""
    cloth, count = layouts(name)[layout]
    is_loose = name == "desbrun" and layout.startswith("loose")  # the others correct no rotation
    options: dict[str, Any] = {"angular": "none"} if is_loose else {}
    options |= HALVED.get(name, {})
    count, pinned = max(count, 3), np.flatnonzero(cloth.inv_mass == 0)

    def sway(time: float) -> tuple[Array, Array]:
        return np.eye(3), np.array([0.1 * np.sin(3 * time), 0.0, 0.1 * time])

    pins = carried(cloth.rest_positions, pinned, sway) if len(pinned) else None
    begun, origins = folded(cloth, count), np.arange(3.0 * count).reshape(count, 3)
    seen = []
    for kind in KINDS:

        def moved(first: int, last: int, threads: int, calls: int, kind: str = kind) -> State:
            start = State(begun.positions[first:last], begun.velocities[first:last])
            method = solver(name, threads=threads, **options)
            moving = MovingCloth.begin(cloth, method, FINE, start=start, collisions=MET[kind])
            wind = Wind((0.0, 0.0, 20.0), gusts=0.5, ripples=0.2, origins=origins[first:last])
            for _ in range(calls):
                moving = moving.advance([FALL, wind], 6 // calls, pins)
            return moving.state

        crowd = moved(0, count, 2, 1)
        seen.append(crowd.positions)
        for one in (0, count - 1):
            alone = moved(one, one + 1, 1, 6)
            assert (alone.positions[0] == crowd.positions[one]).all(), kind
            assert (alone.velocities[0] == crowd.velocities[one]).all(), kind
    if pins is not None:
        np.testing.assert_allclose(crowd.positions[0, pinned], pins(6 * FINE), atol=1e-6)
    different = [(a != b).any(axis=(1, 2)).all() for a, b in pairwise(seen)]
    assert all(different), "every cloth meets what is near"


@dataclass(frozen=True)
class OwnBall:
    """A ball of a user's own."""

    parameters: tuple[float] = (0.2,)
    bounds: tuple[Any, Any] = ((-0.2,) * 3, (0.2,) * 3)

    @staticmethod
    def signed_distance(point: Any, parameters: Any) -> Any:
        x, y, z = point
        return hypot(hypot(x, y), z) - parameters[0]


def round_mesh() -> Any:
    ball = trimesh.creation.icosphere(subdivisions=1, radius=0.2)
    return mesh_collider(ball.vertices, ball.faces)


SHAPES: dict[str, Any] = {
    "rod": Box(np.zeros(3), np.array([2.0, 0.02, 0.02])),
    "plane": Plane(np.zeros(3), np.array([0.0, 0.0, 1.0])),
    "sphere": Sphere(np.zeros(3), 0.2),
    "capsule": Capsule(np.array([-0.6, 0.0, 0.0]), np.array([0.6, 0.0, 0.0]), 0.1),
    "voxels": Voxels(np.array([[-1, -1, -1], [0, -1, -1], [0, 0, -1]], np.int32), 0.25),
    "mesh": round_mesh(),
    "own": OwnBall(),
}
"""The rod is thinner than half a cell."""
THICKNESS = 0.02
BEHIND = np.array([0.0, -0.5, -0.08])
"""Where the foremost point of each shape is at first [m]."""
FRONT = {"rod": 0.01, "plane": 0.0, "sphere": 0.2, "capsule": 0.1, "voxels": 0.0}
"""How far that is before its origin [m]; as far as that of a sphere if none is given."""


@pytest.mark.parametrize(("name", "shape"), [*product(SOLVERS, SHAPES)])
def test_no_part_of_a_cloth_is_in_a_shape_at_rest_or_moving(name: str, shape: str) -> None:
    """The wind blows a hanging cloth onto it; or it flies into the cloth, and turns."""
    cloth = grid(7, 9, 0.7, 1.0)
    place = BEHIND - np.array([0.0, 0.0, FRONT.get(shape, 0.2)])
    # A plane must not reach the pins.
    speed = 0.1 if shape == "plane" else 0.6
    for path in (lambda _: Pose(place), flying(place, speed)):
        collider = Collider(SHAPES[shape], path)
        met = Collisions([collider], THICKNESS, order=3)
        moving, nearest = MovingCloth.begin(cloth, solver(name), collisions=met), np.inf
        for _ in range(20):
            moving = moving.advance([FALL, Wind((0.0, 0.0, -9.0))])
            particles, edges = gaps(moving, collider)
            # Between sample points, 6 cm apart on diagonals, the cloth cuts the edges of cubes.
            assert edges > (-THICKNESS if shape == "voxels" else -1e-4)
            assert particles > THICKNESS / 2 - 1e-5 or shape in ("rod", "plane")
            nearest = min(nearest, particles, edges)
        assert nearest < THICKNESS, "they met"
        assert moving.state.strain == 0.0


def flying(place: Array, speed: float) -> Path:
    """A path along z at a speed [m/s] that turns about y."""

    def pose(time: float) -> Pose:
        return Pose(
            place + np.array([0.0, 0.0, speed * time]), rotation_about((0, 1, 0), 12 * time)
        )

    return pose


def gaps(moving: MovingCloth, collider: Collider) -> tuple[float, float]:
    """From the shape to the particles, and to points along all edges of the faces [m]."""
    pose = collider.path(moving.state.time)
    local = (moving.state.positions[0].astype(float) - pose.position) @ pose.rotation
    corners = local[moving.cloth.triangles]
    parts = np.linspace(0, 1, 9)[:, None, None, None]
    edges = corners + parts * (np.roll(corners, 1, axis=1) - corners)
    particles, along = (
        sample_distances(collider.packed, np.ascontiguousarray(points.reshape(-1, 3)))
        for points in (local, edges)
    )
    return float(particles.min()), float(along.min())


@each_solver
def test_the_loop_of_a_solver_is_compiled_once_for_all_processes(name: str) -> None:
    moving = MovingCloth.begin(strip(4, 1.0), solver(name), 1 / 60).advance([FALL])
    moving.solver_state.kernel.forget()
    compiled: list[Any] = []
    with when_numba_compiles(compiled.append):
        moving.advance([FALL])
    assert not compiled
