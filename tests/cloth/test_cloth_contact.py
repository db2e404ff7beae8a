"""Contact inside the steps of the solvers: no part of a cloth passes into a box or a plane."""

from itertools import pairwise, product
from typing import Any

import numpy as np
import pytest
import trimesh
from contact_cloths import BAR, FLOOR, GROUND, MET, POLE, UNIT, crosses, depth, flag

from drapery.cloth import (
    Box,
    Collider,
    Collisions,
    Gravity,
    MovingCloth,
    Plane,
    SolverDesbrun,
    SolverXPBD,
    Sphere,
    State,
    Wind,
    grid,
    max_stretch,
    rest_state,
    sew,
)
from drapery.cloth.colliders import straight
from drapery.cloth.collisions import boxes_met, resolver
from drapery.cloth.contact.box_data import COLUMNS, bands_of, candidate_arrays
from drapery.cloth.contact.box_depths import line_passes_by
from drapery.cloth.contact.box_guard import edge_enters, guard_boxes
from drapery.cloth.contact.lanes_contact import contact_work, resolve
from drapery.cloth.contact.near_boxes import find_boxes, whole_margin
from drapery.cloth.contact.self_contact_data import NOT_ITSELF
from drapery.cloth.solvers.registry import solver
from drapery.cloth.strain import NEVER
from drapery.jit import entry_point
from drapery.mesh import Array


def test_a_banner_stays_out_of_its_pole_and_bar() -> None:
    cloth = flag((5, 9))
    wind = Wind((1.0, 0.0, -8.0), gusts=0.5)
    moving = MovingCloth.begin(cloth, collisions=MET)
    for _ in range(90):
        moving = moving.advance((Gravity(), wind))
        positions = moving.state.positions[0]
        assert max(depth(positions, shape, cloth) for shape in (POLE, BAR)) < 1e-4
    assert positions[:, 2].min() < -3 * UNIT  # its sides reach behind the pole
    assert positions[:, 1].min() > -1.0


@pytest.mark.parametrize("name", ["desbrun", "xpbd"])
def test_cloth_that_is_thicker_than_a_cell_is_not_torn_from_its_pins(name: str) -> None:
    """Its first row had to be 4 texels from a bar from which the pins are half a texel away: edges
    were 2.7 times as long as at rest, and leather rolled up over its bar."""
    cloth, thick = flag((16, 31)), Collisions((POLE, BAR), thickness=8 * UNIT, apart=8 * UNIT)
    moving = MovingCloth.begin(cloth, solver(name), collisions=thick)
    for _ in range(6):
        moving = moving.advance((Gravity(), Wind((0.0, 0.0, 4.0))), 15)
        assert max_stretch(moving.state.positions, cloth) < 0.15
    assert moving.state.positions[0, :, 1].min() < -36 * UNIT  # it hangs down


@pytest.mark.parametrize("pins", ["top", "three-corners"])
@pytest.mark.parametrize("shape", [(3, 5), (5, 9), (16, 31)])
def test_thick_cloth_that_begins_below_the_end_of_a_box_hangs_beside_its_pins(
    shape: tuple[int, int], pins: Any
) -> None:
    """An edge from the pin beside the box to the particle below it passes nearer to the box than
    the pin. To keep the pin's distance it was pushed, and turned its free end aside: cells there
    were twice as wide as at rest, and a fine grid was pressed together until it could not move."""
    cloth = grid(*shape, 10 * UNIT, 16 * UNIT, pins=pins)
    head = Collider(Box((0.0, 4 * UNIT, -2.6 * UNIT), (8 * UNIT, 8 * UNIT, 8 * UNIT)))
    met = Collisions((head,), thickness=8 * UNIT, apart=8 * UNIT)
    moving = MovingCloth.begin(cloth, collisions=met)
    for _ in range(6):
        moving = moving.advance((Gravity(),), 15)
        assert max_stretch(moving.state.positions, cloth) < 0.151
    x = moving.state.positions[0]
    assert np.abs(x[:, 0]).max() < 6.5 * UNIT
    assert x[:, 1].min() < -15 * UNIT


@pytest.mark.parametrize("method", [SolverDesbrun, SolverXPBD])
def test_a_crowd_in_contact_equals_its_cloths_alone_on_any_threads(method: Any) -> None:
    # More cloths than a register holds; gusts press some of them against the pole.
    cloth, origins = flag((5, 9)), np.arange(60.0).reshape(20, 3)
    wind = Wind((0.5, 0.0, 4.0), gusts=0.8, origins=origins)
    frame = Collisions((POLE, BAR), thickness=UNIT)
    runs = [
        MovingCloth.begin(cloth, method(threads=threads), count=20, collisions=frame)
        for threads in (1, 2)
    ]
    one, two = (run.advance((Gravity(), wind), 40).state for run in runs)
    assert np.array_equal(one.positions, two.positions)
    assert np.array_equal(one.velocities, two.velocities)
    free = MovingCloth.begin(cloth, method(), count=20).advance((Gravity(), wind), 40).state
    met = (one.positions != free.positions).any(axis=(1, 2))
    assert met.any() and not met.all()
    for number in (0, 7, 15, 16, 19):
        alone = MovingCloth.begin(cloth, method(), collisions=frame)
        wind = Wind((0.5, 0.0, 4.0), gusts=0.8, origins=origins[[number]])
        state = alone.advance((Gravity(), wind), 40).state
        assert np.array_equal(state.positions[0], one.positions[number])
        assert np.array_equal(state.velocities[0], one.velocities[number])


def test_how_far_contact_looks_at_first_changes_no_bit() -> None:
    cloth = flag((9, 17))
    boxes = boxes_met(cloth, MET)
    assert boxes is not None
    contact, ends = boxes.contact, []
    noise = np.random.default_rng(0).normal(0, 0.01, cloth.rest_positions.shape)
    for far in (0.0, 0.4, 1.0, 3.0, 1e3):
        work = contact_work(contact, len(cloth.inv_mass))
        work.start[:] = cloth.rest_positions
        work.end[:] = cloth.rest_positions + noise - (0.02, 0.0, 0.03)
        work.near.longest[:] = far * contact.radius
        work.starts[:] = work.ends[:] = contact.ends
        assert resolve(work, contact, NOT_ITSELF, NEVER, 1)
        ends.append(work.end)
    assert all(np.array_equal(ends[0], end) for end in ends[1:])


def test_a_line_that_passes_by_a_rectangle_keeps_its_distance() -> None:
    passes_by: Any = line_passes_by
    random, parts = np.random.default_rng(0), np.linspace(-8, 8, 8001)[:, None]
    found = []
    for _ in range(500):
        half, start, angle = random.uniform(0.1, 2, 2), random.normal(0, 2, 2), random.uniform(0, 7)
        along = np.array([np.cos(angle), np.sin(angle)])
        away = np.maximum(np.abs(start + parts * along) - half, 0)
        distance = np.sqrt(np.square(away).sum(axis=1)).min()
        found.append(passes_by.py_func(*half, 0.3, *start, *along))
        assert distance >= 0.3 if found[-1] else distance < 0.3001
    assert any(found) and not all(found)


@entry_point
def first_edge_enters(half: Any, kept: Any, frame: Any) -> Any:
    """Whether the edge from particle 0 to 1 of a frame enters a box."""
    return edge_enters(half, kept, frame, 0, 1)


def test_an_edge_that_is_micrometres_deep_is_found() -> None:
    numbers, half = np.random.default_rng(5), np.array([0.04, 0.9, 0.04])
    tested = 0
    for a, b in numbers.uniform(-1, 1, (100, 2, 3)) * (0.12, 0.3, 0.12):
        normal = numbers.normal(size=3)
        low, high = -0.5, 0.5  # how far along the normal 5 µm of the edge are in the box
        for _ in range(40):
            middle = (low + high) / 2
            distance = deepest(half, a + middle * normal, b - a)
            low, high = (low, middle) if distance > -5e-6 else (middle, high)
        frame = np.zeros((2, COLUMNS))
        frame[:, 3:6] = np.array([a, b]) + low * normal
        frame[:, 0:3] = frame[:, 3:6] + (1, 1, 1)
        ends = distances(half, frame[:, 3:6])
        if not -6e-6 < distance < -4e-6 or ends.min() < 1e-4:
            continue
        tested += 1
        assert first_edge_enters(tuple(half), 2e-5, frame)
    assert tested > 10


def deepest(half: Array, start: Array, along: Array) -> float:
    """The least distance of an edge's places from a box [m], of which there is one: a box is
    convex, and so is the distance from it."""
    low, high = 0.0, 1.0
    for _ in range(4):
        parts = np.linspace(low, high, 33)
        found = distances(half, start + parts[:, None] * along)
        least = int(found.argmin())
        low, high = parts[max(least - 1, 0)], parts[min(least + 1, 32)]
    return float(found.min())


def distances(half: Array, places: Array) -> Array:
    """From a box about the origin [m]; below 0 inside."""
    away = np.abs(places) - half
    outside: Array = np.sqrt(np.square(np.maximum(away, 0)).sum(axis=1))
    return outside + np.minimum(away.max(axis=1), 0)


@entry_point
def guarded(x0: Any, x: Any, contact: Any, near: Any) -> float:
    """`guard_boxes` after the search for what is near."""
    find_boxes(x0, x, contact, whole_margin(contact), near)
    return guard_boxes(x0, x, contact, near)


def test_cloth_that_returns_because_of_one_box_is_not_left_in_another() -> None:
    """Each box was looked at once: edges of which one end returned from the second crossed the
    first."""
    posts = [((0.0, 0.0, 0.0), (1.0, 1.0, 4.0)), ((2.0, 0.8, 0.0), (0.6, 0.6, 4.0))]
    met = Collisions([Collider(Box(np.array(at), np.array(size))) for at, size in posts], 0.02)
    cloth = grid(2, 2, 2.0, 2.0, pins="none")
    boxes = boxes_met(cloth, met)
    assert boxes is not None
    near = candidate_arrays(boxes.contact)
    start = np.array([(-1, 1, -1), (-1, 1, 1), (1, 1, -1), (1, 1, 1)], float)
    end = np.array([(2, 0.8, -1), (2, 0.8, 1), (0.6, -0.6, -1), (0.6, -0.6, 1)], float)
    assert guarded(start, end, boxes.contact, near) > 0
    parts = np.linspace(0, 1, 101)[:, None]
    for (at, size), corner in product(posts, (0, 1)):
        along = end[corner] + parts * (end[corner + 2] - end[corner])
        assert distances(np.array(size) / 2, along - at).min() > 0


def test_edges_and_faces_join_only_neighbouring_bands() -> None:
    shuffled = np.random.default_rng(0).permutation(45).astype(np.int32)
    for triangles in (flag((5, 9)).triangles, shuffled[flag((5, 9)).triangles]):
        pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        edges = np.unique(np.sort(pairs, axis=1), axis=0)
        bands = bands_of(45, edges, triangles)
        assert (bands[0] == 0).all() and (bands[-1] == (45, len(edges), len(triangles))).all()
        for first, last in pairwise(bands):
            later = bands[bands[:, 0] > last[0], 0].min(initial=45)
            for parts, column in ((edges, 1), (triangles, 2)):
                mine = parts[first[column] : last[column]]
                assert ((mine >= first[0]) & (mine < later)).all()
                assert (mine.min(axis=1, initial=45) < last[0]).all()
    assert len(bands_of(45, edges[:0], triangles[:0])) == 2


def test_a_falling_cloth_comes_to_rest_on_a_box_and_friction_holds_it() -> None:
    table = Collider(Box(np.array([0, -0.5, 0]), np.array([0.3, 1.0, 0.3])), friction=0.8)
    cloth = grid(13, 13, 0.8, 0.8, pins="none")
    start = rest_state(cloth, dtype=np.float64)
    lying = start.positions[..., [0, 2, 1]] * (1, 1, -1)
    lying = lying - lying.mean(axis=1, keepdims=True) + (0.05, 0.15, 0)
    moving = MovingCloth.begin(
        cloth,
        SolverXPBD(),
        start=State(lying, start.velocities),
        collisions=Collisions((table, FLOOR), thickness=0.01),
    )
    moving = moving.advance((Gravity(),), 240)
    before = moving.state.positions[0].copy()
    assert depth(before, table, cloth) < 1e-4
    moving = moving.advance((Gravity(),), 60)
    middle = np.linalg.norm(before[:, [0, 2]], axis=1) < 0.1
    assert np.abs(moving.state.positions[0] - before)[middle].max() < 0.01


def test_a_fast_box_takes_the_cloth_with_it() -> None:
    cloth = flag((5, 9))
    start = Box(np.array([0.0, -1.2, -0.5]), np.array([0.5, 0.2, 0.2]))
    moving = MovingCloth.begin(
        cloth, collisions=Collisions((Collider(start, straight((0, 0, 4.0))),), thickness=UNIT)
    )
    for _ in range(20):
        moving = moving.advance((Gravity(),))
    middle = moving.state.positions[0, 4 * 5 + 2]
    assert middle[2] > 0.3


@pytest.mark.parametrize("apart", [None, 0.01], ids=["world", "all"])
@pytest.mark.parametrize("method", [SolverDesbrun, SolverXPBD])
def test_cloth_that_begins_in_a_box_comes_out(method: Any, apart: float | None) -> None:
    block = Collider(Box(np.array([0.25, -1.2, 0.1]), np.array([0.5, 0.6, 0.4])))
    cloth = flag((11, 21))
    met = Collisions((block,), thickness=0.01, apart=apart)
    moving = MovingCloth.begin(cloth, method(), collisions=met)
    assert depth(moving.state.positions[0], block, cloth) > 0.09
    moving = moving.advance((Gravity(), Wind((0.0, 0.0, 3.0))), 120)
    assert depth(moving.state.positions[0], block, cloth) < 1e-4
    assert moving.state.strain == 0.0


def test_thin_and_deep_cloth_passes_no_wall_at_any_speed() -> None:
    wall = Collider(Plane(np.array([0, 0, -0.1]), np.array([0, 0, 1.0])))
    cloth = flag((5, 9))
    moving = MovingCloth.begin(cloth, collisions=Collisions((wall,), thickness=1e-3))
    moving = moving.advance((Gravity(), Wind((0, 0, -40.0))), 60)
    assert depth(moving.state.positions[0], wall, cloth) < 1e-6


def test_a_crumpled_cloth_never_passes_through_itself() -> None:
    cloth = grid(11, 11, 0.6, 0.6, pins="none")
    start = rest_state(cloth, dtype=np.float64)
    upright = start.positions + np.array([0.0, 0.62, 0.0])
    rolled = upright + 0.02 * np.sin(9 * upright[..., [1]]) * (0, 0, 1)
    moving = MovingCloth.begin(
        cloth,
        SolverXPBD(),
        start=State(rolled, start.velocities),
        collisions=Collisions(
            (Collider(Plane(np.zeros(3), np.array([0, 1.0, 0]))),), 0.01, apart=0.01
        ),
    )
    for _ in range(18):
        moving = moving.advance((Gravity(),), 5)
        assert not crosses(moving.state.positions[0], cloth.triangles)
    positions = moving.state.positions[0]
    assert positions[:, 1].max() < 0.4 and positions[:, 1].min() > -1e-6


def test_cloths_that_are_sewn_without_a_seam_lie_on_each_other() -> None:
    one = grid(7, 7, 0.5, 0.5, pins="none")
    cloth = sew([one, one])
    flat = one.rest_positions[:, [0, 2, 1]] * (1, 1, -1)
    places = np.concatenate([flat + np.array([0, 0.05, 0]), flat + np.array([0.1, 0.12, 0.06])])[
        None
    ]
    moving = MovingCloth.begin(
        cloth,
        SolverXPBD(),
        start=State(places, np.zeros_like(places)),
        collisions=Collisions(
            (Collider(Plane(np.zeros(3), np.array([0, 1.0, 0]))),), 0.02, apart=0.02
        ),
    )
    for _ in range(15):
        moving = moving.advance((Gravity(),), 8)
        assert not crosses(moving.state.positions[0], cloth.triangles)
    lower, upper = moving.state.positions[0].reshape(2, -1, 3)[..., 1]
    assert np.median(upper) > np.median(lower) + 0.012


@pytest.mark.parametrize("speed", [1.0, 4.0])
def test_a_ball_does_not_push_a_cloth_through_the_one_that_lies_on_it(speed: float) -> None:
    """Colliders were applied after contact of the cloth with itself, which was not looked at
    again."""
    one = grid(7, 7, 0.6, 0.6, pins="none")
    cloth, count = sew([one, one]), 49
    flat = one.rest_positions[:, [0, 2, 1]] * (1, 1, -1)
    flat = flat - flat.mean(axis=0)
    places = np.concatenate([flat, flat + np.array([0.02, 0.03, 0.01])])[None]
    ball = Collider(Sphere(np.array([0, -0.26, 0]), 0.2), straight((0, speed, 0)))
    moving = MovingCloth.begin(
        cloth,
        SolverXPBD(),
        start=State(places, np.zeros_like(places)),
        collisions=Collisions((ball,), 0.02, apart=0.02),
    )
    for _ in range(12):
        moving = moving.advance((Gravity(),))
        positions = moving.state.positions[0]
        assert not crosses(positions, cloth.triangles)
        assert depth(positions - (0, speed * moving.state.time, 0), ball, cloth) < 0.001
    lower, upper = positions.reshape(2, count, 3)[..., 1]
    assert upper.max() > lower.max() + 0.01


def test_cloths_that_fall_in_a_row_do_not_fall_through_the_one_that_is_stopped() -> None:
    one = grid(4, 4, 0.3, 0.3, pins="none")
    cloth, count = sew([one] * 4), 16
    flat = one.rest_positions[:, [0, 2, 1]] * (1, 1, -1)
    tilt = 0.1 * flat[:, [0]] * (0, 1, 0)
    places = np.concatenate([flat + tilt + (0, 0.05 + 0.06 * n, 0) for n in range(4)])[None]
    falling = np.zeros_like(places) + np.array([0, -4.3, 0])
    moving = MovingCloth.begin(
        cloth,
        SolverXPBD(),
        start=State(places, falling),
        collisions=Collisions((GROUND,), 0.02, apart=0.02),
    )
    for _ in range(4):
        moving = moving.advance((Gravity(),))
        positions = moving.state.positions[0]
        assert not crosses(positions, cloth.triangles)
        assert (np.diff(positions[:, 1].reshape(-1, count).mean(axis=1)) > 0).all()


def test_cloths_that_are_pressed_together_for_long_stay_apart_by_more_than_rounding() -> None:
    # A step brought a pair nearer by a fifth of its distance, until rounding could let it cross.
    cloth = sew([grid(2, 2, 0.4, 0.4, pins="none"), grid(2, 2, 0.06, 0.06, pins="none")])
    lying = cloth.rest_positions[:, [0, 2, 1]] * (1, 1, -1)
    lying[:4] -= lying[:4].mean(axis=0)
    lying[4:] += (0.1, 0.01, 0.1) - lying[4:].mean(axis=0)  # over one of the two faces below
    places = (lying + np.array([3, 5, 3]))[None].astype(np.float32)
    state, move = State(places, np.zeros_like(places)), np.zeros_like(places)
    move[:, :4, 1], move[:, 4:, 1] = 0.1, -0.1
    press = resolver(cloth, Collisions((GROUND,), 0.02, apart=0.02))
    for number in range(100):
        pressed = State(state.positions + move, state.velocities, (number + 1) / 60)
        state = press(state, pressed)
    x = state.positions[0].astype(float)
    faces = x[cloth.triangles[(cloth.triangles < 4).all(axis=1)]]
    for corner in x[4:]:
        near = trimesh.triangles.closest_point(faces, np.repeat(corner[None], 2, axis=0))
        assert np.linalg.norm(near - corner, axis=1).min() > 1e-5
