"""A world of cloths: the same bits as a batch, stable ids, a cap, and no jump between levels."""

import gc
import weakref

import numpy as np
import pytest

from drapery.cloth import Gravity, SolverXPBD, State, Wind, grid, strip
from drapery.cloth.world import FULL, HALF, STIFF, Detail, World, coarsen, refine, thin
from drapery.errors import OptionError

CLOTH = grid(5, 9, 0.8333, 1.6667)
EYE = np.zeros(3)


def breeze(places):
    return (Gravity(), Wind((1.0, 0.0, 4.0), origins=places))


def row(count: int, spacing: float = 1.0) -> np.ndarray:
    return np.arange(count)[:, None] * np.array([spacing, 0.0, 0.0])


def positions(world: World) -> dict[int, np.ndarray]:
    return {
        int(number): one
        for _, ids, _, shown, _ in world.shown()
        for number, one in zip(ids, shown, strict=True)
    }


def levels(world: World) -> list[int]:
    return [int(level) for *_, shown in world.shown() for level in shown]


def test_near_cloths_are_a_batch_to_the_last_bit() -> None:
    world = World(forces=breeze)
    world.add(CLOTH, row(4))
    rest = np.broadcast_to(CLOTH.rest_positions, (4, 45, 3)).copy()
    state, solver = State(rest, np.zeros_like(rest)), SolverXPBD()
    solver_state = solver.init(CLOTH, world.dt)
    for _ in range(20):
        world.step(EYE)
        state, solver_state = solver.step(CLOTH, state, solver_state, breeze(row(4)), world.dt)
    assert all(np.array_equal(positions(world)[i], state.positions[i]) for i in range(4))


def test_ids_stay_when_others_come_and_go() -> None:
    world = World(forces=breeze)
    first = world.add(CLOTH, row(5))
    world.step(EYE)
    world.remove(first[1:3])
    tail = world.add(strip(6, 0.5), row(2))
    before = positions(world)
    assert sorted(before) == [0, 3, 4, 5, 6] == sorted(world.ids())
    assert list(tail) == [5, 6]
    world.step(EYE)
    assert sorted(positions(world)) == [0, 3, 4, 5, 6]
    with pytest.raises(OptionError, match="cloth 1 is not in the world"):
        world.remove([1])


def test_removing_a_cloth_does_not_disturb_the_others() -> None:
    worlds = [World(forces=breeze), World(forces=breeze)]
    for world in worlds:
        world.add(CLOTH, row(3))
    for n in range(12):
        if n == 5:
            worlds[1].remove([1])
        for world in worlds:
            world.step(EYE)
    both = [positions(world) for world in worlds]
    assert all(np.array_equal(both[0][i], both[1][i]) for i in (0, 2))


def test_a_world_without_cloths_steps_on() -> None:
    world = World()
    world.step(EYE)
    assert world.time == world.dt and not list(world.shown())
    world.remove(world.add(CLOTH, row(2)))
    world.step(EYE)
    assert not world.ids().size


def test_a_topology_goes_with_its_last_cloth() -> None:
    world, cloth = World(), strip(4, 0.5)
    ids = world.add(cloth, row(2))
    seen = weakref.ref(cloth)
    world.remove(ids[:1])
    assert [view.cloth is cloth for view in world.shown()] == [True]
    world.remove(ids[1:])
    assert not list(world.shown())
    del cloth
    gc.collect()
    assert seen() is None


def test_a_cloth_is_prepared_once() -> None:
    class Counting(SolverXPBD):
        def init(self, cloth, dt):
            prepared.append(cloth)
            return super().init(cloth, dt)

    prepared: list[object] = []
    world = World(solver=Counting())
    world.add(CLOTH, row(2))
    first = len(prepared)
    world.add(CLOTH, row(3))
    assert len(prepared) == first and len(world.ids()) == 5


WRONG = {
    "places two": lambda: World().add(CLOTH, np.zeros((4, 2))),
    "places nan": lambda: World().add(CLOTH, np.full((1, 3), np.nan)),
    "places text": lambda: World().add(CLOTH, "here"),
    "eye": lambda: World().step(np.zeros(2)),
    "dt": lambda: World(dt=-1),
    "half before full": lambda: Detail(full=5, half=4),
    "maximum": lambda: Detail(maximum=0.5),
    "fade": lambda: Detail(fade=-1),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_be_is_refused_in_one_line(name: str) -> None:
    with pytest.raises(OptionError) as refusal:
        WRONG[name]()
    assert "\n" not in str(refusal.value)


def test_levels_follow_distance_and_the_cap_keeps_the_nearest() -> None:
    detail = Detail(full=2.5, half=4.5, maximum=4)
    world = World(forces=breeze, detail=detail)
    world.add(CLOTH, row(8))
    world.step(EYE)
    assert levels(world) == [FULL, FULL, FULL, HALF, STIFF, STIFF, STIFF, STIFF]
    world.step(np.array([7.0, 0, 0]))
    assert levels(world) == [STIFF, STIFF, STIFF, STIFF, HALF, FULL, FULL, FULL]


def test_a_cloth_at_the_limit_does_not_flicker() -> None:
    world = World(forces=breeze, detail=Detail(full=5.0, half=9.0))
    world.add(CLOTH, row(1))
    seen = []
    for n in range(40):
        world.step(np.array([5.0 + 0.2 * np.sin(n), 0, 0]))
        seen.append(levels(world)[0])
    assert np.count_nonzero(np.diff(seen)) <= 1


def sway(cloth, places, time):
    lean = np.sin(time + places[:, 0])[:, None] * 0.05 * -cloth.rest_positions[:, 1]
    moved = np.broadcast_to(cloth.rest_positions, (len(places), *cloth.rest_positions.shape)).copy()
    moved[..., 2] += lean
    return moved


def test_no_jump_shows_when_a_level_changes() -> None:
    """The eye goes away and comes back through all levels; no frame moves much more than others."""
    world = World(forces=breeze, stiff=sway, detail=Detail(full=10, half=20, fade=0.5))
    world.add(CLOTH, row(3))
    shown, seen = [], set()
    for n in range(600):
        world.step(np.array([0, 0, 30 * np.sin(np.pi * n / 600)]))
        seen.update(levels(world))
        shown.append(np.stack(list(positions(world).values())))
    assert seen == {FULL, HALF, STIFF}
    moves = np.linalg.norm(np.diff(np.stack(shown), axis=0), axis=-1).max(axis=(1, 2))
    # At 60 steps/s a fade of half a second moves a point by 1/20 of the distance to its new place.
    assert moves[60:].max() < 0.05 + 1.5 * np.quantile(moves[60:180], 0.95)
    assert np.isfinite(shown).all()


def test_half_a_grid_has_the_same_size_mass_and_pins() -> None:
    coarse = coarsen(CLOTH)
    assert coarse is not None and coarse.grid_shape == (5, 3)
    assert np.array_equal(coarse.rest_positions, thin(CLOTH.rest_positions[None], CLOTH)[0])
    assert np.array_equal(coarse.inv_mass == 0, np.arange(15) < 3)
    masses = [len(c.inv_mass) / c.inv_mass[c.inv_mass > 0].mean() for c in (CLOTH, coarse)]
    assert masses[0] == pytest.approx(masses[1])
    assert coarsen(grid(4, 9, 1, 1)) is None and coarsen(strip(6, 0.5)) is None


def test_refining_is_exact_for_flat_cloth_and_undone_by_thinning() -> None:
    flat = CLOTH.rest_positions[None]
    assert np.allclose(refine(thin(flat, CLOTH), CLOTH), flat)
    noise = np.random.default_rng(0).normal(size=(2, 15, 3))
    assert np.array_equal(thin(refine(noise, CLOTH), CLOTH), noise)
