"""What Desbrun's solver and XPBD promise beside `test_solver_conformance`: air, spin, stretch."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from drapery.cloth import (
    Drag,
    Fabric,
    Gravity,
    SolverDesbrun,
    SolverXPBD,
    State,
    Wind,
    disc,
    grid,
    max_stretch,
    rest_state,
    simulate,
)

G = 9.81
DEFAULT = {"desbrun": SolverDesbrun(), "xpbd": SolverXPBD()}
both = pytest.mark.parametrize("name", ["desbrun", "xpbd"])


def after(seconds, cloth, solver, forces, dt, start=None, **options) -> State:
    start = start or rest_state(cloth, 1, np.float64)
    steps = round(seconds / dt)
    frames = simulate(cloth, solver, forces, dt, start=start, every=steps, **options)
    return next(islice(frames, 1, None))


def shaken(cloth, seed=0, speed=1.0):
    state = rest_state(cloth, 1, np.float64)
    noise = np.random.default_rng(seed).normal(size=state.positions.shape)
    spin = np.cross([0.0, 0.0, 2.0], state.positions)
    return replace(state, velocities=speed * noise + spin)


def grid_sheet():
    return grid(5, 6, 1.2, 0.7, pins="none"), np.array([0.0, 0, 1]), 1.2 * 0.7


def disc_sheet():
    cloth = disc(5, 0.5)
    corners = cloth.rest_positions[cloth.triangles]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    return cloth, np.array([0.0, 1, 0]), areas[:, 1].sum()


@both
def test_drag_of_the_fabric_adds_to_that_of_the_forces(name):
    plain = grid(3, 3, 1, 1, pins="none")
    woolly = grid(3, 3, 1, 1, pins="none", fabric=Fabric(drag=0.5))
    gravity = Gravity((0, -G, 0))
    expected = after(1.0, plain, DEFAULT[name], [gravity, Drag(2.0)], 1 / 60)
    fallen = after(1.0, woolly, DEFAULT[name], [gravity, Drag(1.5)], 1 / 60)
    np.testing.assert_array_equal(fallen.positions, expected.positions)


@both
@pytest.mark.parametrize("make", [grid_sheet, disc_sheet])
def test_still_air_slows_a_moving_sheet_by_pressure_times_area(name, make):
    cloth, normal, area = make()
    start = rest_state(cloth, 1, np.float64)
    rng = np.random.default_rng(1)
    velocity = rng.normal(size=3)
    start = replace(start, velocities=np.broadcast_to(velocity, start.positions.shape).copy())
    air, dt = Wind((0.0, 0.0, 0.0), pressure=1.5), 1e-3
    end = after(dt, cloth, DEFAULT[name], [air], dt, start)
    gained = ((end.velocities - start.velocities)[0] / cloth.inv_mass[:, None]).sum(0)
    # Only the speed along the normal counts: cloth edge-on to the wind feels none.
    np.testing.assert_allclose(
        gained, -1.5 * area * dt * (velocity @ normal) * normal, rtol=2e-3, atol=1e-9
    )


def spin_of(cloth, state):
    mass = 1 / cloth.inv_mass[:, None]
    x = state.positions[0] - (mass * state.positions[0]).sum(0) / mass.sum()
    return (mass * np.cross(x, state.velocities[0])).sum(0)


def test_the_exact_correction_keeps_angular_momentum_better_than_the_papers_and_than_none():
    cloth = grid(6, 7, 1, 1, pins="none", fabric=Fabric(6.0))
    start = shaken(cloth)
    drift = {}
    for angular in ("none", "paper", "exact"):
        end = after(1.0, cloth, SolverDesbrun(sweeps=0, angular=angular), [], 1 / 60, start)
        drift[angular] = np.linalg.norm(spin_of(cloth, end) - spin_of(cloth, start))
    whole = np.linalg.norm(spin_of(cloth, start))
    assert drift["exact"] < 1e-12 * whole
    assert drift["exact"] < drift["paper"] < drift["none"]


@both
def test_angular_momentum_drifts_less_in_smaller_steps(name):
    cloth = grid(6, 7, 1, 1, pins="none")
    start = shaken(cloth, speed=0.2)
    drift = []
    for dt in (1 / 60, 1 / 240):
        end = after(1.0, cloth, DEFAULT[name], [], dt, start)
        drift.append(np.linalg.norm(spin_of(cloth, end) - spin_of(cloth, start)))
    whole = np.linalg.norm(spin_of(cloth, start))
    assert drift[0] < 0.1 * whole
    assert drift[1] < 0.5 * drift[0]


@both
@pytest.mark.parametrize("pins", ["top", "corners"])
def test_a_cloth_at_rest_does_not_move_without_wind(name, pins):
    cloth = grid(5, 9, 0.8333, 1.6667, pins=pins)
    settled = after(60.0, cloth, DEFAULT[name], [Gravity(), Drag(2.0)], 1 / 60)
    later = after(2.0, cloth, DEFAULT[name], [Gravity(), Drag(2.0)], 1 / 60, settled)
    assert np.abs(later.positions - settled.positions).max() < 1e-6


@pytest.mark.parametrize("speed", [0.0, 12.0])
@pytest.mark.parametrize("shape", [(5, 9), (11, 21)])
@both
def test_a_banner_stretches_less_than_five_per_cent_for_a_minute(name, shape, speed):
    cloth = grid(*shape, 0.8333, 1.6667)
    wind = speed * np.array([0.35, 0, 1]) / np.hypot(0.35, 1)
    states = simulate(cloth, DEFAULT[name], [Gravity(), Wind(tuple(wind), seed=1)], every=6)
    worst = max(max_stretch(state.positions, cloth) for state in islice(states, 20, 600))
    assert worst < 0.05


@pytest.mark.parametrize("speed", [0.0, 12.0])
@pytest.mark.parametrize("shape, seconds", [((21, 41), 10), ((41, 81), 4)])
@both
def test_fine_grids_stretch_less_than_five_per_cent(name, shape, seconds, speed):
    cloth = grid(*shape, 0.8333, 1.6667)
    wind = speed * np.array([0.35, 0, 1]) / np.hypot(0.35, 1)
    states = simulate(cloth, DEFAULT[name], [Gravity(), Wind(tuple(wind), seed=1)], every=6)
    worst = max(max_stretch(state.positions, cloth) for state in islice(states, 1, seconds * 10))
    assert worst < 0.05


def test_a_fine_banner_on_its_corners_stretches_less_than_five_per_cent():
    cloth = grid(21, 41, 0.8333, 1.6667, pins="corners")
    states = simulate(cloth, SolverDesbrun(), [Gravity(), Wind((2.6, 0.0, 7.5), seed=1)], every=6)
    worst = max(max_stretch(state.positions, cloth) for state in islice(states, 1, 100))
    assert worst < 0.05


@both
def test_cells_of_a_few_millimetres_do_not_shake_in_single_precision(name):
    cloth = grid(129, 129, 0.4167, 0.8333)
    states = simulate(cloth, DEFAULT[name], [Gravity()], every=12)
    worst = max(max_stretch(state.positions, cloth) for state in islice(states, 1, 4))
    assert worst < 0.025
