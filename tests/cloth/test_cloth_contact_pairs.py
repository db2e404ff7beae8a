"""The pairs of parts of a cloth that may meet: none is missed, and far ones change no bit."""

from dataclasses import replace
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest
import trimesh
from contact_cloths import GROUND, MET, crosses, flag

from drapery.cloth import (
    Cloth,
    Collisions,
    Gravity,
    MovingCloth,
    SolverDesbrun,
    SolverXPBD,
    State,
    Wind,
    from_mesh,
    grid,
    sew,
)
from drapery.cloth.contact.pair_distance import nearest
from drapery.cloth.contact.self_contact_data import make_self_contact
from drapery.cloth.contact.smoothness import Windows, is_smooth, windows_of
from drapery.cloth.contact.touching_pairs import (
    TouchingPairs,
    find_pairs,
    keep_near,
    particle_bounds,
    room_for_pairs,
)
from drapery.jit import entry_point
from drapery.mesh import Array

LIMIT = 0.03
"""How near the pairs are that are looked for [m]."""


@entry_point
def search(
    x0: Any,
    x: Any,
    contact: Any,
    stop: Any,
    every: Any,
    room: Any,
    by_all: Any,
    found: Any,
    counts: Any,
    distances: Any,
) -> None:
    """Find the pairs by the tree, and those among all pairs of which the bounds overlap.

    every: all pairs and their kinds, [P, 5].
    room, by_all: take the pairs of either way, see `TouchingPairs`.
    found: takes the pairs of either way with their kinds, [2, P, 5]. counts: their numbers, [2].
    distances: takes those of all pairs at the start and the end [m], [P, 2].
    """
    none = Windows(np.empty((4, 0)), np.zeros(0, np.uint8))
    by_tree = find_pairs(x0, x, contact, none, LIMIT, stop, room)
    bounds = particle_bounds(x0, x, 0.5 * LIMIT, stop)
    waiting = 0
    for n in range(len(every)):
        i, j, k, m, kind = every[n]
        apart = False
        for low in range(3):
            high = low + 3
            first = bounds[i, low], bounds[i, high]
            last = min(bounds[k, low], bounds[m, low]), max(bounds[k, high], bounds[m, high])
            if kind:
                first = min(first[0], bounds[j, low]), max(first[1], bounds[j, high])
            else:
                last = min(last[0], bounds[j, low]), max(last[1], bounds[j, high])
            apart = apart or first[0] > last[1] or last[0] > first[1]
        if not apart:
            by_all.ends[waiting] = every[n]
            waiting += 1
        for end, places in enumerate((x0, x)):
            _weights, offset = nearest(places, i, j, k, m, kind)
            distances[n, end] = np.sqrt(offset[0] ** 2 + offset[1] ** 2 + offset[2] ** 2)
    counts[0] = len(by_tree.ends)
    counts[1] = keep_near(x0, x, LIMIT, stop, by_all, 0, waiting)
    for way, pairs in enumerate((by_tree, by_all)):
        for n in range(counts[way]):
            for end in range(5):
                found[way, n, end] = pairs.ends[n, end]


def all_pairs(contact: Any) -> Any:
    """All pairs of parts without a common particle, and whether they are edges, [P, 5]."""
    corners = [(p, *face, 0) for p in contact.particles for face in contact.triangles]
    pairs = [(*e, *f, 1) for e, f in combinations(contact.edges, 2)]
    apart = [pair for pair in corners if pair[0] not in pair[1:4]]
    apart += [pair for pair in pairs if not {*pair[:2]} & {*pair[2:4]}]
    return np.array(apart, np.int32).reshape(-1, 5)


@entry_point
def find_smooth(x: Any, contact: Any, smooth: Any) -> None:
    """Whether each window is smooth, [W]."""
    made, levels = windows_of(x, contact), contact.levels
    for level in range(len(levels)):
        for i in range(levels[level, 1]):
            for j in range(levels[level, 2]):
                block = levels[level, 0] + i * levels[level, 2] + j
                smooth[block] = is_smooth(made, levels, level, i, j)


def windows(x: Any, contact: Any) -> Any:
    """Whether each window is smooth."""
    levels = contact.levels
    smooth = np.zeros(levels[-1, 0] + levels[-1, 1] * levels[-1, 2], np.bool_)
    find_smooth(x, contact, smooth)
    return smooth


def known(rows: Any) -> set[tuple[int, ...]]:
    """Pairs, whichever of two edges comes first."""
    found = set()
    for i, j, k, m, kind in rows.tolist():
        first, second = (tuple(sorted(pair)) for pair in ((i, j), (k, m)))
        pair = (*min(first, second), *max(first, second)) if kind else (i, *sorted((j, k, m)))
        assert (kind, *pair) not in found
        found.add((kind, *pair))
    return found


def triangle() -> Cloth:
    corners = np.array([[0.0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]])
    return from_mesh(trimesh.Trimesh(corners, [[0, 1, 2]]))


def adversarial() -> dict[str, tuple[Cloth, Array, Array]]:
    """Cloths with their places at the start and the end of a step [m]."""
    random = np.random.default_rng(1)
    sheet, pair = grid(5, 6, 0.4, 0.5), sew([grid(3, 4, 0.2, 0.3, pins="none")] * 2)
    count, rest = len(sheet.inv_mass), sheet.rest_positions.astype(float)
    crumpled = random.normal(0, 0.05, (count, 3))
    layers = pair.rest_positions + np.repeat([0.0, 0.02], 12)[:, None] * np.array([0.3, 0.4, 1])
    twice = np.repeat(crumpled[::2], 2, axis=0)
    return {
        "crumpled": (sheet, crumpled, crumpled + random.normal(0, 0.02, (count, 3))),
        "flat": (sheet, rest, rest),
        "fast": (sheet, rest, rest + random.normal(0, 1, (count, 3))),
        "triangle": (triangle(), triangle().rest_positions, triangle().rest_positions + 0.5),
        "one place": (sheet, np.zeros((count, 3)), np.zeros((count, 3))),
        "duplicates": (sheet, twice, twice + 0.01 * np.sign(crumpled)),
        "far away": (sheet, crumpled + 1e6, crumpled + 1e6 + random.normal(0, 0.02, (count, 3))),
        "huge": (sheet, 1e100 * crumpled, 1e100 * crumpled),
        "two": (pair, layers, layers + random.normal(0, 0.01, layers.shape)),
    }


@pytest.mark.parametrize("name", adversarial())
@pytest.mark.parametrize("stop", [False, True])
def test_the_tree_finds_the_pairs_that_a_search_among_all_pairs_finds(
    name: str, stop: bool
) -> None:
    cloth, x0, x = adversarial()[name]
    contact = make_self_contact(cloth, 0.02)
    every = all_pairs(contact)
    pairs, counts = np.zeros((2, *every.shape), np.int32), np.zeros(2, int)
    room = room_for_pairs(contact)
    by_all = TouchingPairs(np.empty_like(every), np.empty((len(every), 4)))
    distances = np.empty((len(every), 2))
    search(x0, x, contact, stop, every, room, by_all, pairs, counts, distances)
    found = known(pairs[0, : counts[0]])
    assert found == known(pairs[1, : counts[1]])
    near = every[(distances < LIMIT * (1 - 1e-6)).any(axis=1)]
    assert known(near) <= found
    if name != "huge":  # squares of lengths are infinite there, so all pairs may be near
        assert bool(found) == (name not in ("flat", "triangle"))


def test_a_smooth_window_has_no_crossing_and_a_folded_cloth_is_not_smooth() -> None:
    cloth = grid(9, 12, 0.8, 1.1)
    contact, random, smooth = make_self_contact(cloth, 0.02), np.random.default_rng(2), 0
    triangles, (level, down, across) = cloth.triangles, contact.levels[0]
    assert (down, across, level) == (11, 8, 0)
    for size in (0.015, 0.02, 0.03):
        x = cloth.rest_positions + random.normal(0, size, (108, 3))
        found = windows(x, contact)
        assert not found.all()
        cells = np.divmod(triangles, 9)
        first = [part.min(axis=1) for part in cells]
        for i, j in zip(*np.nonzero(found[: down * across].reshape(down, across)), strict=True):
            inside = (first[0] >= i) & (first[0] <= i + 1) & (first[1] >= j) & (first[1] <= j + 1)
            assert not crosses(x, triangles[inside])
            smooth += 1
    assert smooth > 50
    x = cloth.rest_positions.copy()
    assert windows(x, contact).all()
    x[:, 2] = 0.5 * np.abs(x[:, 0]) ** 0.5  # steep, but over a plane
    assert windows(x, contact)[0]
    x[54:] = x[:54][::-1] + np.array([0, 0, 0.05])
    assert not windows(x, contact)[-1]


@pytest.mark.parametrize("method", [SolverDesbrun, SolverXPBD])
@pytest.mark.parametrize("shape", [(5, 9), (17, 9)])
def test_where_no_parts_are_near_contact_with_itself_changes_no_bit(
    method: Any, shape: tuple[int, int]
) -> None:
    forces = Gravity(), Wind((0.4, 0.0, 3.0))
    runs = [
        MovingCloth.begin(
            flag(shape), method(), collisions=Collisions(met, MET.thickness, apart=apart)
        ).advance(forces, 40)
        for met in ((), MET.colliders[:2])
        for apart in (None, 0.01)
    ]
    assert all(run.resolve is None for run in runs)
    for one, other in (runs[:2], runs[2:]):
        assert np.array_equal(one.state.positions, other.state.positions)
        assert np.array_equal(one.state.velocities, other.state.velocities)


def test_the_layers_of_a_stack_stay_apart_by_more_than_half_the_thickness() -> None:
    one, thickness = grid(5, 5, 0.3, 0.3, pins="none"), 0.02
    cloth, count = sew([one] * 4), 25
    flat = one.rest_positions[:, [0, 2, 1]] * (1, 1, -1)
    places = np.concatenate([flat + np.array([0.01 * n, 0.025 * (n + 1), 0]) for n in range(4)])[
        None
    ]
    moving = MovingCloth.begin(
        cloth,
        SolverXPBD(),
        start=State(places, np.zeros_like(places)),
        collisions=Collisions((GROUND,), thickness, apart=thickness),
    )
    faces = one.triangles
    for _ in range(12):
        moving = moving.advance((Gravity(),), 5)
        layers = moving.state.positions[0].astype(float).reshape(4, count, 3)
        for low, high in pairwise(layers):
            for points, surface in ((high, low), (low, high)):
                mesh = trimesh.Trimesh(surface, faces, process=False)
                gaps = trimesh.proximity.closest_point_naive(mesh, points)[1]
                assert gaps.min() > thickness / 2


def test_a_row_without_faces_has_no_blocks() -> None:
    cloth = grid(5, 5, 1.0, 1.0)
    row = replace(cloth, grid_shape=(1, 25), triangles=cloth.triangles[:0])
    assert make_self_contact(row, 0.01).columns == 0


@pytest.mark.parametrize("shape", [None, (5, 5)], ids=["loose", "torn"])
def test_grids_without_some_of_their_faces_are_stepped(shape: tuple[int, int] | None) -> None:
    whole = grid(5, 5, 1.0, 1.0)
    faces = whole.triangles[: -1 if shape == (5, 5) else 0]
    cloth = replace(whole, grid_shape=shape, triangles=faces)
    moved = []
    for apart in (None, 0.01):
        met = Collisions((), 0.01, apart=apart)
        moving = MovingCloth.begin(cloth, SolverXPBD(), 1 / 60, collisions=met)
        moved.append(moving.advance((Gravity(),), 3).state.positions)
    assert np.array_equal(moved[0], moved[1])
