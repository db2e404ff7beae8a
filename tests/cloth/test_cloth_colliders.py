"""Colliders: nothing enters, nothing tunnels, bounces and friction follow the physics."""

import functools
import math
import pickle
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings, strategies as st

from drapery.cloth.cloth import Cloth
from drapery.cloth.colliders import (
    Box,
    Capsule,
    Collider,
    Plane,
    Pose,
    Sphere,
    Voxels,
    check_collider,
    height_collider,
    load_mesh,
    mesh_collider,
    rotation_about,
    straight,
    swinging,
)
from drapery.cloth.colliders.check import sample_distances
from drapery.cloth.colliders.collision_world import CollisionWorld
from drapery.cloth.colliders.packing import distance, pack
from drapery.cloth.colliders.sampling import sample_points
from drapery.cloth.collisions import Collisions, collision_world
from drapery.cloth.contact.self_contact_data import make_self_contact
from drapery.cloth.state import State
from drapery.errors import OptionError

GRAVITY = np.array([0, -9.81, 0])
UP = np.array([0.0, 1, 0])
ORIGIN = np.zeros(3)
RADIUS = 1e-3


def dust(count, inv_mass=None):
    """Particles without springs."""
    return Cloth(
        rest_positions=np.zeros((count, 3)),
        inv_mass=np.ones(count) if inv_mass is None else np.asarray(inv_mass, float),
        spring_pairs=np.zeros((0, 2), np.int32),
        spring_length=np.zeros(0),
        spring_stiffness=np.zeros(0),
        spring_kind=np.zeros(0, np.uint8),
        triangles=np.zeros((0, 3), np.int32),
        uvs=np.zeros((count, 2)),
    )


def sheet(rows, columns, spacing, height):
    """A level sheet of faces about the y axis, without springs: positions [N, 3] and a Cloth."""
    z, x = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    places = np.stack([x - (columns - 1) / 2, 0 * x, z - (rows - 1) / 2], axis=-1) * spacing
    i = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]
    faces = np.concatenate([np.stack(f, axis=-1).reshape(-1, 3) for f in ((a, d, c), (a, c, b))])
    cloth = dust(rows * columns)
    positions = places.reshape(-1, 3) + np.array([0, height, 0])
    return Cloth(**{**vars(cloth), "triangles": faces.astype(np.int32)}), positions


def state(positions, velocities=None, time=0.0):
    positions = np.atleast_2d(np.asarray(positions, float))
    positions = positions[None] if positions.ndim == 2 else positions
    velocities = np.zeros_like(positions) if velocities is None else velocities
    return State(positions, np.broadcast_to(velocities, positions.shape).astype(float), time)


def world_of(cloth, colliders, order=1, radius=RADIUS):
    return CollisionWorld(cloth.inv_mass, colliders, sample_points(cloth, order), radius)


def fall(cloth, start, colliders, steps, dt, order=1, force=GRAVITY, radius=RADIUS):
    """Semi-implicit Euler with collisions; yields every state."""
    world, now = world_of(cloth, colliders, order, radius), start
    for step in range(steps):
        v = now.velocities + force * dt
        after = State(now.positions + v * dt, v, start.time + (step + 1) * dt)
        now = world.resolve(now, after)
        yield now


packed = functools.cache(pack)


def gap(shape, points):
    """Signed distances [m] of points [M, 3] to a shape."""
    return sample_distances(packed(shape), np.ascontiguousarray(points, float))


ICOSPHERE = trimesh.creation.icosphere(subdivisions=2, radius=1.0)
SHAPES = {
    "sphere": Sphere(ORIGIN, 1.0),
    "small sphere": Sphere(ORIGIN, 0.05),
    "capsule": Capsule(np.array([0, -0.5, 0]), np.array([0.3, 0.5, 0]), 0.1),
    "box": Box(ORIGIN, np.array([0.06, 0.8, 0.8]), rotation_about((1, 2, 3), 40)),
    "plane": Plane(ORIGIN, np.array([1.0, 2, 3])),
    "voxels": Voxels(np.array([[0, 0, 0], [-1, 0, 0], [0, 0, -1], [0, -1, 0]])),
    "small voxels": Voxels(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0]]) - 1, size=1 / 16),
    "mesh": mesh_collider(ICOSPHERE.vertices * 0.3, ICOSPHERE.faces),
    "sheet of triangles": mesh_collider(
        [[-1, -0.1, -1], [1, -0.1, -1], [1, 0.1, 1], [-1, 0.1, 1]], [[0, 1, 2], [0, 2, 3]]
    ),
    "ground": height_collider(np.sin(np.arange(30.0)).reshape(5, 6) * 0.3),
}


@pytest.mark.parametrize("restitution", [0.3, 0.5, 0.8])
def test_a_ball_bounces_to_the_restitution_squared_of_its_height(restitution):
    ground = Collider(Plane(ORIGIN, UP), restitution=restitution)
    motion = list(fall(dust(1), state([0, 1 + RADIUS, 0]), [ground], 1400, 1 / 1000))
    height = np.array([s.positions[0, 0, 1] for s in motion]) - RADIUS
    assert height.min() >= -1e-12
    landing = int(np.argmax(height < 0.01))
    assert height[landing + 10 :].max() == pytest.approx(restitution**2, rel=0.01)


@pytest.mark.parametrize(("angle", "slides"), [(20, False), (26, False), (27, True), (40, True)])
def test_friction_holds_a_slider_below_the_friction_angle_only(angle, slides):
    # tan 26.565 degrees = 0.5.
    slope = rotation_about((0, 0, 1), angle)
    ground = Collider(Plane(ORIGIN, slope @ UP), friction=0.5)
    last = list(fall(dust(1), state(slope @ UP * RADIUS), [ground], 60, 1 / 60))[-1]
    slope_gain = np.sin(np.radians(angle)) - 0.5 * np.cos(np.radians(angle))
    expected = 0.5 * 9.81 * max(slope_gain, 0)
    assert np.linalg.norm(last.positions) == pytest.approx(expected, rel=0.02, abs=2e-3)
    assert (np.linalg.norm(last.velocities) > 1e-9) == slides


@pytest.mark.parametrize("name", SHAPES)
@settings(max_examples=80, deadline=None)
@given(data=st.data())
def test_nothing_tunnels_at_20_m_per_s(name, data):
    number = st.floats(-1, 1)
    direction = np.array(data.draw(st.tuples(number, number, number)))
    if np.linalg.norm(direction) < 1e-3:
        return
    shape = SHAPES[name]
    direction /= np.linalg.norm(direction)
    target = np.array(data.draw(st.tuples(number, number, number))) * 0.2
    target += [3, 0, 2] if name == "ground" else 0
    start = target - direction * data.draw(st.floats(1, 4))
    if gap(shape, [start])[0] < RADIUS:
        return
    restitution = data.draw(st.sampled_from([0.0, 0.7]))
    flight = fall(
        dust(1),
        state(start, direction * 20),
        [Collider(shape, restitution=restitution)],
        steps=24,
        dt=1 / 60,
        force=0 * GRAVITY,
    )
    before = start
    for now in flight:
        place = now.positions[0, 0]
        assert gap(shape, [place])[0] >= RADIUS - 1e-6
        if name == "sheet of triangles":
            # A sheet has no inside: no straight piece of the way may cross it.
            a, b = (p[1] - 0.1 * p[2] for p in (before, place))
            assert a * b > 0 or abs(place).max() > 0.9 or abs(before).max() > 0.9
        before = place


def finned_cube(half=2.0, height=1.0, thickness=0.005):
    """One closed surface: a cube with a thin fin along the middle of its top."""
    e, top = thickness / 2, half + height
    outline = [(-half, -half), (half, -half), (half, half), (e, half)]
    outline += [(e, top), (-e, top), (-e, half), (-half, half)]
    near = np.array([(x, y, half) for x, y in outline])
    cap = np.array([[3, 4, 5], [3, 5, 6], [1, 2, 3], [0, 1, 3], [0, 3, 6], [0, 6, 7]])
    i, j = np.arange(8), np.roll(np.arange(8), -1)
    wall = np.concatenate([np.stack([i, i + 8, j + 8], 1), np.stack([i, j + 8, j], 1)])
    return mesh_collider(
        np.concatenate([near, near * (1, 1, -1)]), np.concatenate([cap, cap[:, ::-1] + 8, wall])
    )


def plates(*places, thickness=0.001):
    """Square plates of 2 m across the x axis, centred at these x."""
    boxes = [trimesh.creation.box(extents=(thickness, 2, 2)) for _ in places]
    for box, place in zip(boxes, places, strict=True):
        box.apply_translation([place, 0, 0])
    both = trimesh.util.concatenate(boxes)
    return mesh_collider(both.vertices, both.faces)


def spiked_ball():
    """A ball of 1 m with one vertex pulled out to 3 m: a needle about the y axis."""
    ball = trimesh.creation.icosphere(subdivisions=3, radius=1.0)
    tip = int(np.argmax(ball.vertices[:, 1]))
    vertices = (
        np.array(ball.vertices)
        @ trimesh.geometry.align_vectors(ball.vertices[tip], [0, 1, 0])[:3, :3].T
    )
    vertices[tip] = [0, 3, 0]
    return mesh_collider(vertices, ball.faces)


# Each shape with the places at which a point that moves along x must be stopped.
THIN = {
    "fin": (finned_cube(), [[0, 2.02, 0], [0, 2.5, 1.1], [0, 2.99, -1.9]]),
    "plate": (plates(0.0), [[0, 0, 0], [0, 0.97, -0.8]]),
    "two plates": (plates(-0.002, 0.002), [[0, 0, 0], [0, -0.6, 0.7]]),
    "needle": (spiked_ball(), [[0, 2.99, 0], [0, 2.9, 0.001]]),
}


@pytest.mark.parametrize("radius", [1e-4, 1e-3, 0.02])
@pytest.mark.parametrize("speed", [0.5, 5.0, 60.0])
@pytest.mark.parametrize("name", THIN)
def test_nothing_passes_a_thin_feature_of_a_large_shape(name, speed, radius):
    shape, targets = THIN[name]
    dt = 1 / 60
    # Many starts, so that steps end before, in and behind the feature.
    away = np.concatenate([np.linspace(0.001, 1.3, 13) * speed * dt, [0.031, 0.3]]) + radius + 0.01
    sides = np.array([-1.0, 1.0])
    starts = np.array(
        [
            (target[0] + side * distance, *target[1:])
            for target in targets
            for side in sides
            for distance in away
        ]
    )
    side = np.sign(starts[:, 0])
    velocities = np.stack([-side * speed, 0 * side, 0 * side], axis=1)
    flight = fall(
        dust(len(starts)),
        state(starts, velocities[None]),
        [Collider(shape, friction=100.0)],
        steps=4,
        dt=dt,
        force=0 * UP,
        radius=radius,
    )
    for now in flight:
        assert (now.positions[0, :, 0] * side > 0).all()


@pytest.mark.parametrize("radius", [1e-3, 0.02])
def test_what_is_between_two_plates_stays_between_them(radius):
    shape = plates(-0.004, 0.004)
    x = np.linspace(-0.003, 0.003, 7)
    starts = np.stack([x, 0 * x, 0 * x], axis=1)
    for speed in (0.0, 0.1, 5.0, -60.0):
        flight = state(starts, np.array([speed, 0.3, 0]))
        for now in fall(dust(7), flight, [Collider(shape)], 6, 1 / 60, force=0 * UP, radius=radius):
            assert np.abs(now.positions[0, :, 0]).max() < 0.0035


@pytest.mark.parametrize(
    "shape", [Box(ORIGIN, np.full(3, 4.0)), Voxels(np.zeros((1, 3), int), 4.0)]
)
def test_a_way_through_a_corner_is_stopped(shape):
    corner = np.array([2.0, 2.0, 0.0] if isinstance(shape, Box) else [4.0, 4.0, 2.0])
    for depth in (0.002, 0.01, 0.05):
        start = corner + np.array([-3 * depth, depth, 0])
        velocity = np.array([4.0, -4.0, 0]) * depth * 60
        step = fall(
            dust(1), state(start, velocity), [Collider(shape, friction=100.0)], 1, 1 / 60,
            force=0 * UP, radius=1e-3,
        )  # fmt: skip
        end = next(step).positions[0, 0]
        assert end[0] < corner[0] and end[1] > corner[1]


def test_a_cloth_falling_at_20_m_per_s_does_not_pass_a_thin_bar():
    cloth, positions = sheet(8, 8, 0.1, 0.5)
    bar = Capsule(np.array([-2, 0, 0.04]), np.array([2, 0, 0.04]), 0.02)
    start = state(positions, np.array([0, -20.0, 0]))
    for now in fall(cloth, start, [Collider(bar)], 6, 1 / 60, order=6):
        faces = now.positions[0][cloth.triangles]
        shares = np.random.default_rng(1).dirichlet([1, 1, 1], size=20)
        inside = gap(bar, (shares @ faces).reshape(-1, 3))
    assert inside.min() > -0.01
    # The row over the bar was stopped by it, the outermost fell past it.
    heights = now.positions[0, :, 1].reshape(8, 8)
    assert heights[4].min() > 0 and heights[0].mean() < -0.8


def test_points_on_a_sphere_drape_without_entering():
    ball = Sphere(ORIGIN, 0.5)
    cloth, positions = sheet(15, 15, 0.08, 0.6)
    for now in fall(cloth, state(positions), [Collider(ball)], 60, 1 / 60, order=3):
        assert gap(ball, now.positions[0]).min() >= RADIUS - 1e-9


@settings(max_examples=40, deadline=None)
@given(
    x=st.floats(-2.9, 2.9),
    z=st.floats(-2.9, 2.9),
    heading=st.floats(0, 360),
    speed=st.floats(0.5, 20),
)
def test_faces_between_blocks_never_catch_a_slider(x, z, heading, speed):
    i, k = np.meshgrid(np.arange(-40, 40), np.arange(-40, 40))
    floor = Voxels(np.stack([i.ravel(), -1 + 0 * i.ravel(), k.ravel()], axis=1))
    way = rotation_about((0, 1, 0), heading) @ np.array([1.0, 0, 0])
    start = state([x, RADIUS, z], way * speed)
    now = start
    for now in fall(dust(1), start, [Collider(floor, friction=0)], 30, 1 / 60):  # noqa: B007
        pass
    expected = np.array([x, RADIUS, z]) + way * speed * 0.5
    np.testing.assert_allclose(now.positions[0, 0], expected, atol=1e-5)
    np.testing.assert_allclose(now.velocities[0, 0], way * speed, atol=1e-5)


def test_points_at_seams_edges_and_corners_of_blocks_rest_on_top():
    steps = Voxels(np.array([[0, 0, 0], [1, 0, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1]]))
    corners = [[1, 1.5, 0.5], [0.5, 1.5, 1], [1, 2.5, 1], [2, 2.5, 2], [0, 1.5, 0], [1, 1.5, 0]]
    last = list(fall(dust(6), state(corners), [Collider(steps, friction=1)], 60, 1 / 60))[-1]
    assert gap(steps, last.positions[0]).min() >= RADIUS - 1e-9
    np.testing.assert_allclose(
        last.positions[0, :, 1] - RADIUS, [1, 1, 2, 2, 1, 1], atol=RADIUS, err_msg="heights"
    )


def test_a_point_inside_a_pile_of_blocks_leaves_through_free_air():
    pile = Voxels(np.stack(np.meshgrid(*[np.arange(5)] * 3), axis=-1).reshape(-1, 3))
    points = np.array([[2.5, 4.2, 2.5], [0.9, 2.5, 2.5], [2.5, 2.5, 3.4], [2.9, 2.9, 2.9]])
    last = list(fall(dust(4), state(points), [Collider(pile)], 1, 1 / 60, force=0 * UP))[-1]
    assert gap(pile, last.positions[0]).min() >= RADIUS - 1e-9


def test_a_mesh_of_a_sphere_is_a_sphere_within_its_facets():
    ball = trimesh.creation.icosphere(subdivisions=3, radius=1.0)
    points = np.random.default_rng(3).normal(size=(300, 3))
    error = gap(mesh_collider(ball.vertices, ball.faces), points) - gap(Sphere(ORIGIN, 1.0), points)
    inscribed = np.abs(np.einsum("ij,ij->i", ball.face_normals, ball.triangles[:, 0])).min()
    assert error.min() >= -1e-9 and error.max() <= 1 - inscribed + 1e-9


def test_a_mesh_agrees_with_the_shape_that_it_copies():
    points = np.random.default_rng(5).uniform(-1, 1, size=(400, 3))
    box = trimesh.creation.box(extents=(0.6, 0.8, 1.0))
    copy = gap(mesh_collider(box.vertices, box.faces), points)
    np.testing.assert_allclose(copy, gap(Box(ORIGIN, np.array([0.6, 0.8, 1.0])), points), atol=1e-9)
    inside_out = mesh_collider(box.vertices, box.faces[:, ::-1])
    np.testing.assert_allclose(gap(inside_out, points), copy, atol=1e-9)


def test_overlapping_parts_of_a_mesh_unite():
    left, right = (trimesh.creation.box(extents=(1, 1, 1)) for _ in range(2))
    right.apply_translation([0.5, 0.25, 0.1])
    both = trimesh.util.concatenate([left, right])
    points = np.random.default_rng(6).uniform(-1.5, 1.5, size=(400, 3))
    apart = np.minimum(
        gap(mesh_collider(left.vertices, left.faces), points),
        gap(mesh_collider(right.vertices, right.faces), points),
    )
    np.testing.assert_allclose(
        gap(mesh_collider(both.vertices, both.faces), points), apart, atol=1e-12
    )


def test_ground_is_solid_below_its_heights():
    heights = np.array([[0, 1, 0], [1, 2, 1], [0, 1, 0.0]])
    ground = height_collider(heights, cell=2.0, depth=0.5)
    assert ground.solid.all()
    below = [[2, 1.9, 2], [1, 0.4, 1], [3.9, 0.05, 3.9]]
    above = [[2, 2.1, 2], [0.1, 0.3, 0.1], [3.9, 0.3, 3.9], [-0.1, 0, 1], [2, -0.6, 2]]
    assert (gap(ground, below) < 0).all() and (gap(ground, above) > 0).all()


def test_a_mesh_file_loads_like_its_arrays(tmp_path):
    path = tmp_path / "ball.obj"
    ICOSPHERE.export(path)
    points = np.random.default_rng(7).normal(size=(50, 3))
    arrays = mesh_collider(ICOSPHERE.vertices * 2, ICOSPHERE.faces)
    np.testing.assert_allclose(
        gap(load_mesh(path, scale=2), points), gap(arrays, points), atol=1e-6
    )


def test_a_moving_collider_carries_what_lies_on_it():
    lift = Collider(Plane(ORIGIN, UP), path=straight((1.0, 2.0, 0.0)), friction=10.0)
    last = list(fall(dust(1), state([0, RADIUS, 0]), [lift], 60, 1 / 60))[-1]
    np.testing.assert_allclose(last.positions[0, 0], [1, 2 + RADIUS, 0], atol=1e-6)
    np.testing.assert_allclose(last.velocities[0, 0], [1, 2, 0], atol=1e-6)


def test_a_fast_collider_does_not_pass_a_resting_point():
    ball = Collider(Sphere(np.array([-1.0, 0, 0]), 0.05), path=straight((20.0, 0, 0)))
    for now in fall(dust(1), state(ORIGIN), [ball], 30, 1 / 60, force=0 * UP):
        centre = ball.path(now.time).position[0] - 1
        assert now.positions[0, 0, 0] - centre >= 0.05 + RADIUS - 1e-9 or centre < -0.05


def test_a_walking_leg_pushes_and_never_swallows():
    leg = Capsule(np.array([0.0, 1, 0]), np.array([0.0, 0.1, 0]), 0.1)
    walk = swinging((0.0, 1, 0), 45, 0.5, 0)
    z, y = np.meshgrid(np.linspace(-0.8, 0.8, 9), np.linspace(0, 1, 9))
    points = np.stack([0.02 + 0 * z, y, z], axis=-1).reshape(-1, 3)
    points = points[gap(leg, points) > 0.01]
    collider = Collider(leg, path=walk)
    for now in fall(dust(len(points)), state(points), [collider], 60, 1 / 60, force=0 * UP):
        pose = walk(now.time)
        local = (now.positions[0] - pose.position) @ pose.rotation
        assert gap(leg, local).min() >= RADIUS - 1e-6


def test_pins_stay_and_share_nothing():
    cloth, positions = sheet(3, 3, 0.2, 0.05)
    pinned = Cloth(**{**vars(cloth), "inv_mass": np.where(np.arange(9) % 2, 1.0, 0.0)})
    start = state(positions, np.array([0, -20.0, 0]))
    moved = State(start.positions - 0.3 * UP, start.velocities, 1 / 60)
    ground = [Collider(Plane(ORIGIN, UP))]
    after = world_of(pinned, ground, 2).resolve(start, moved)
    np.testing.assert_array_equal(after.positions[0, ::2], moved.positions[0, ::2])
    assert after.positions[0, 1::2, 1].min() >= RADIUS - 1e-12


def test_a_push_on_a_face_lifts_corners_and_lowers_none():
    cloth, positions = sheet(2, 2, 1.0, 0.3)
    cloth = Cloth(**{**vars(cloth), "inv_mass": np.array([1.0, 2, 4, 8])})
    start = state(positions, np.array([0, -20.0, 0]))
    moved = State(start.positions - 0.33 * UP, start.velocities, 1 / 60)
    needle = [Collider(Sphere(np.array([0.02, 0, 0.01]), 0.1), friction=0)]
    after = world_of(cloth, needle, 6).resolve(start, moved)
    assert after.positions[0].min(axis=0)[1] > moved.positions[0].min(axis=0)[1] - 1e-12
    assert np.abs(after.positions - moved.positions).max() > 0.01
    tilt = after.positions - moved.positions
    assert (tilt[0, :, 1] >= -1e-12).all()


def test_the_points_of_the_faces_are_each_tested_once():
    cloth, positions = sheet(4, 3, 0.1, 0.0)
    edges = 3 * 3 + 4 * 2 + 3 * 2
    assert len(sample_points(cloth, 1).weights) == 12
    assert len(sample_points(cloth, 2).weights) == 12 + edges
    assert len(sample_points(cloth, 3).weights) == 12 + 2 * edges + 12
    for order in (1, 2, 3, 5):
        points = sample_points(cloth, order)
        np.testing.assert_allclose(points.weights.sum(axis=1), 1)
        places = np.einsum("mc,mci->mi", points.weights, positions[points.particles])
        assert len(np.unique(places.round(9), axis=0)) == len(places)


class Torus:
    """A user-defined shape about the y axis, in the shape's frame."""

    def __init__(self, radius, tube):
        reach = radius + tube
        self.parameters = radius, tube
        self.bounds = (-reach, -tube, -reach), (reach, tube, reach)

    @staticmethod
    def signed_distance(point, parameters):
        x, y, z = point
        return math.hypot(math.hypot(x, z) - parameters[0], y) - parameters[1]


class Ball:
    """A sphere about the origin, with its own gradient."""

    bounds = -np.ones(3), np.ones(3)
    parameters = ()

    @staticmethod
    def signed_distance(point, parameters):
        x, y, z = point
        return math.sqrt(x * x + y * y + z * z) - 1.0

    @staticmethod
    def gradient(point, parameters):
        x, y, z = point
        length = math.sqrt(x * x + y * y + z * z)
        return x / length, y / length, z / length


class FinnedBall(Ball):
    """A large ball with a plate of 1 mm on top: its gradient is taken by differences."""

    bounds = (-1, -1, -1), (1, 2, 1)
    gradient = None

    @staticmethod
    def signed_distance(point, parameters):
        x, y, z = point
        ball = math.sqrt(x * x + y * y + z * z) - 1.0
        a, b, c = abs(x) - 0.0005, abs(y - 1.5) - 0.5, abs(z) - 0.2
        outside = math.sqrt(max(a, 0.0) ** 2 + max(b, 0.0) ** 2 + max(c, 0.0) ** 2)
        return min(ball, outside + min(max(a, b, c), 0.0))


def test_a_users_shape_has_the_distance_that_its_function_gives():
    points = np.random.default_rng(8).normal(size=(200, 3))
    expected = np.hypot(np.hypot(points[:, 0], points[:, 2]) - 0.5, points[:, 1]) - 0.2
    np.testing.assert_array_equal(gap(Torus(0.5, 0.2), points), expected)
    for tube in (0.1, 0.2):
        assert gap(Torus(0.5, tube), [[0.5, 0, 0]]) == -tube


@pytest.mark.parametrize("kind", [Ball, type("Plain", (Ball,), {"gradient": None})])
def test_a_users_ball_and_a_sphere_stop_a_cloth_alike(kind):
    cloth, positions = sheet(9, 9, 0.1, 1.1)
    ends = [
        list(fall(cloth, state(positions), [Collider(shape)], 30, 1 / 60, order=2))[-1].positions
        for shape in (kind(), Sphere(ORIGIN, 1.0))
    ]
    np.testing.assert_allclose(*ends, atol=RADIUS)


@pytest.mark.parametrize("speed", [0.5, 5.0, 60.0])
def test_nothing_passes_a_thin_feature_of_a_users_shape(speed):
    shape = FinnedBall()
    away = np.linspace(0.01, 0.5, 15)
    starts = np.array([(side * x, 1.9, 0.1) for side in (-1, 1) for x in away])
    side = np.sign(starts[:, 0])
    velocities = np.stack([-side * speed, 0 * side, 0 * side], axis=1)
    flight = fall(
        dust(30), state(starts, velocities), [Collider(shape, friction=9.0)], 6, 1 / 60, 1, 0 * UP
    )
    for now in flight:
        assert (now.positions[0, :, 0] * side > 0).all()
        assert gap(shape, now.positions[0]).min() >= RADIUS - 1e-6


def test_a_users_shape_moves_on_a_path():
    ring = Collider(Torus(0.5, 0.1), path=straight((20.0, 0, 0)))
    start = state([[0.75, 0, 0], [0.0, 0.5, 0.0]])
    for now in fall(dust(2), start, [ring], 30, 1 / 60, force=0 * UP):
        local = now.positions[0] - ring.path(now.time).position
        assert gap(ring.shape, local).min() >= RADIUS - 1e-9
    assert now.positions[0, 0, 0] > 10
    np.testing.assert_array_equal(now.positions[0, 1], start.positions[0, 1])


def returning(**attributes):
    """A user's shape that differs from a torus in these attributes."""
    functions = {k: staticmethod(v) if callable(v) else v for k, v in attributes.items()}
    return type("Odd", (Torus,), functions)(0.5, 0.1)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: returning(signed_distance=lambda p, q: p), "signed_distance returned"),
        (lambda: returning(signed_distance=lambda p, q: q[9]), "raised IndexError"),
        (lambda: returning(signed_distance=lambda p: 1.0), "raised TypeError"),
        (lambda: returning(signed_distance=lambda p, q: math.nan), "is nan; return a finite"),
        (lambda: returning(signed_distance=lambda p, q: eval("1.0")), "cannot compile"),
        (lambda: returning(gradient=lambda p, q: 1.0), "cannot compile its gradient"),
        (lambda: type("Odd", (), {"signed_distance": 1})(), "has no parameters"),
        (lambda: type("Odd", (Torus,), {"bounds": 3, "__init__": lambda s: None})(), "parameters"),
        (lambda: type("Odd", (), {})(), "has no signed_distance"),
    ],
)
def test_a_users_shape_that_cannot_be_used_is_refused_with_its_name(make, message):
    with pytest.raises(OptionError, match=message) as fault:
        Collider(make())
    assert str(fault.value).startswith("collider Odd")
    assert "\n" not in str(fault.value) and "\x1b" not in str(fault.value)


def test_a_distance_that_fails_in_flight_is_refused_with_its_name():
    hole = returning(
        signed_distance=lambda p, q: math.nan if 1.99 < p[0] < 2.01 else abs(p[0]) + 1.0
    )
    hole.bounds = np.array([[-9.0] * 3, [9.0] * 3])
    flight = fall(dust(1), state([2.0, 0, 0]), [Collider(hole)], 1, 1 / 60)
    with pytest.raises(OptionError, match="collider Odd: its signed_distance is not a number"):
        next(flight)


@pytest.mark.parametrize("name", SHAPES)
def test_the_built_in_shapes_pass_the_check_of_colliders(name):
    check_collider(Collider(SHAPES[name]))


def scaled(factor):
    """A torus's distance times a factor."""
    ring = numba.njit(Torus.signed_distance)
    return lambda point, parameters: factor * ring(point, parameters)


def test_the_check_of_colliders_finds_what_lets_cloth_through():
    check_collider(Collider(Torus(0.5, 0.2)))
    check_collider(Collider(returning(signed_distance=scaled(0.5))))
    with pytest.raises(OptionError, match="steepest slope"):
        check_collider(Collider(returning(signed_distance=scaled(1.5))))
    small = Torus(0.5, 0.2)
    small.bounds = Torus(0.5, 0.1).bounds
    with pytest.raises(OptionError, match="outside its bounds"):
        check_collider(Collider(small))
    with pytest.raises(OptionError, match="no surface"):
        check_collider(Collider(returning(signed_distance=lambda p, q: 1.0 + abs(p[0]))))
    with pytest.raises(OptionError, match="rotation"):
        bent = Pose(rotation=np.ones((3, 3)))
        check_collider(Collider(Sphere(ORIGIN, 1.0), path=lambda time: bent))


def test_threads_may_share_a_world_and_its_shapes():
    cloth, positions = sheet(6, 6, 0.2, 0.7)
    start = state(positions)
    moved = State(start.positions - 0.6 * UP, start.velocities, 1 / 60)
    # A new function, so that all threads ask for its compilation at once.
    shape = returning(signed_distance=lambda p, q: math.hypot(math.hypot(p[0], p[2]), p[1]) - 0.5)
    with ThreadPoolExecutor(4) as pool:
        balls = list(pool.map(lambda _: Collider(shape), range(8)))
        collisions = Collisions([balls[0], Collider(SHAPES["box"])], apart=0.1, threads=2)
        world = collision_world(cloth, collisions)
        ends = list(pool.map(lambda _: world.resolve(start, moved).positions, range(100)))
    assert len({ball.packed.distance_address for ball in balls}) == 1
    for end in ends:
        np.testing.assert_array_equal(end, ends[0])


def test_a_collider_survives_being_sent_to_another_process():
    ring = pickle.loads(pickle.dumps(Collider(Torus(0.5, 0.1), friction=0.7)))
    assert ring.friction == 0.7
    assert distance(ring.packed, (0.5, 0.0, 0.0), 1.0)[0] == -0.1


@pytest.mark.parametrize(
    "make",
    [
        lambda: Sphere(ORIGIN, 0.0),
        lambda: Sphere(np.array([0, np.nan, 0]), 1.0),
        lambda: Capsule(ORIGIN, UP, -1.0),
        lambda: Box(ORIGIN, np.array([1, 0, 1.0])),
        lambda: Box(ORIGIN, np.ones(3), np.ones((3, 3))),
        lambda: Plane(ORIGIN, ORIGIN),
        lambda: Voxels(np.zeros((0, 3), int)),
        lambda: Voxels(np.array([[0.5, 0, 0]])),
        lambda: Voxels(np.array([[0, 0, 0], [10**6, 10**6, 10**6]])),
        lambda: mesh_collider([[0, 0, 0]], [[0, 0, 0]]),
        lambda: mesh_collider([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 3]]),
        lambda: mesh_collider([[0, 0, 0], [1, 0, 0], [0, np.inf, 0]], [[0, 1, 2]]),
        lambda: height_collider([[1.0]]),
        lambda: Collider(Sphere(ORIGIN, 1.0), friction=-1),
        lambda: Collider(Sphere(ORIGIN, 1.0), restitution=1.5),
        lambda: sample_points(dust(1), 0),
        lambda: make_self_contact(sheet(2, 2, 1.0, 0.0)[0], 0.0),
        lambda: load_mesh("no such file.obj"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(make):
    with pytest.raises(OptionError) as fault:
        make()
    assert "\n" not in str(fault.value)
