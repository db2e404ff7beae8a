"""Desbrun's solver and XPBD conserve what mechanics conserves, in double precision."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from drapery.cloth import (
    STRUCTURAL,
    Cloth,
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
    strip,
)

G = 9.81
SPRINGY = {
    "desbrun": SolverDesbrun(sweeps=0),
    "xpbd": SolverXPBD(substeps=1, compliance=(None, None, None), attach=False),
}
"""Without limits on stretch: the integrators alone."""
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


def spring(length=1.0, stiffness=20.0, mass=0.5):
    """One particle on a spring from a pin, both on the x axis."""
    return Cloth(
        rest_positions=np.array([[0.0, 0, 0], [length, 0, 0]]),
        inv_mass=np.array([0.0, 1 / mass]),
        spring_pairs=np.array([[0, 1]], np.int32),
        spring_length=np.array([length]),
        spring_stiffness=np.array([stiffness]),
        spring_kind=np.array([STRUCTURAL], np.uint8),
        triangles=np.zeros((0, 3), np.int32),
        uvs=np.zeros((2, 2)),
    )


def grid_sheet():
    return grid(5, 6, 1.2, 0.7, pins="none"), np.array([0.0, 0, 1]), 1.2 * 0.7


def disc_sheet():
    cloth = disc(5, 0.5)
    corners = cloth.rest_positions[cloth.triangles]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    return cloth, np.array([0.0, 1, 0]), areas[:, 1].sum()


@both
def test_free_fall_is_a_parabola(name):
    cloth, dt, seconds = grid(4, 5, 1, 1, pins="none"), 1 / 240, 1.0
    fallen = after(seconds, cloth, DEFAULT[name], [Gravity((0, -G, 0))], dt)
    drop = fallen.positions[0, :, 1] - cloth.rest_positions[:, 1]
    # First order: the sum of n steps is g t² / 2 + g t dt / 2.
    assert np.abs(drop + G * seconds**2 / 2).max() <= 0.51 * G * seconds * dt
    assert np.ptp(drop) < 1e-12
    np.testing.assert_allclose(fallen.velocities[0, :, 1], -G * seconds, rtol=1e-9)


@pytest.mark.quick
@both
def test_drag_ends_a_fall_at_g_over_its_rate(name):
    cloth = grid(3, 3, 1, 1, pins="none")
    fallen = after(8.0, cloth, DEFAULT[name], [Gravity((0, -G, 0)), Drag(2.0)], 1 / 60)
    np.testing.assert_allclose(fallen.velocities[0, :, 1], -G / 2.0, rtol=0.02)


@pytest.mark.quick
@both
def test_drag_of_the_fabric_adds_to_that_of_the_forces(name):
    plain = grid(3, 3, 1, 1, pins="none")
    woolly = grid(3, 3, 1, 1, pins="none", fabric=Fabric(drag=0.5))
    gravity = Gravity((0, -G, 0))
    expected = after(1.0, plain, DEFAULT[name], [gravity, Drag(2.0)], 1 / 60)
    fallen = after(1.0, woolly, DEFAULT[name], [gravity, Drag(1.5)], 1 / 60)
    np.testing.assert_array_equal(fallen.positions, expected.positions)


@pytest.mark.quick
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


@pytest.mark.quick
@both
def test_the_error_of_an_oscillator_is_of_first_order(name):
    cloth, seconds = spring(), 1.0
    start = rest_state(cloth, 1, np.float64)
    pulled = start.positions.copy()
    pulled[0, 1, 0] += 1e-4
    exact = 1e-4 * np.cos(np.sqrt(20.0 / 0.5) * seconds)
    errors = [
        abs(
            after(
                seconds, cloth, SPRINGY[name], [], dt, replace(start, positions=pulled)
            ).positions[0, 1, 0]
            - 1.0
            - exact
        )
        for dt in (1 / 400, 1 / 800, 1 / 1600)
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.abs(orders - 1) < 0.2), orders


@both
def test_a_spring_swings_at_its_frequency(name):
    cloth, dt = spring(), 1 / 4000
    start = rest_state(cloth, 1, np.float64)
    pulled = start.positions.copy()
    pulled[0, 1, 0] += 1e-3
    states = islice(
        simulate(cloth, SPRINGY[name], [], dt, start=replace(start, positions=pulled)), 12000
    )
    offsets = np.array([state.positions[0, 1, 0] - 1.0 for state in states])
    crossings = np.flatnonzero((offsets[:-1] > 0) & (offsets[1:] <= 0))
    period = (crossings[-1] - crossings[0]) / (len(crossings) - 1) * dt
    assert period == pytest.approx(2 * np.pi * np.sqrt(0.5 / 20.0), rel=2e-3)


@both
def test_a_hanging_chain_swings_at_the_period_of_bessels_zero(name):
    length, count, dt = 1.0, 21, 1 / 480
    cloth = strip(count, length, fabric=Fabric(0.1, 5.0, 1.0, 0.0))
    start = rest_state(cloth, 1, np.float64)
    # Its slowest shape is J0(2.405 sqrt(1 - s)); a straight line is near enough.
    places = np.zeros((1, count, 3))
    places[0, :, 1] = -cloth.rest_positions[:, 0]
    places[0, :, 0] = 0.05 * cloth.rest_positions[:, 0]
    start = replace(start, positions=places)
    states = islice(simulate(cloth, DEFAULT[name], [Gravity((0, -G, 0))], dt, start=start), 3840)
    sway = np.array([state.positions[0, count // 2, 0] for state in states])
    crossings = np.flatnonzero((sway[:-1] > 0) & (sway[1:] <= 0))
    period = (crossings[-1] - crossings[0]) / (len(crossings) - 1) * dt
    # The masses at the links' ends, the last one whole, make it half a link longer.
    longer = length * (1 + 0.5 / count)
    assert period == pytest.approx(2 * np.pi / (2.4048 / 2 * np.sqrt(G / longer)), rel=0.03)


@pytest.mark.quick
@pytest.mark.parametrize("solver", [SolverDesbrun(sweeps=40), SolverXPBD(substeps=40)])
def test_a_chain_between_two_pins_hangs_as_a_catenary(solver):
    count, length, span = 41, 1.0, 0.7
    cloth = strip(count, length, pins=[0, count - 1], fabric=Fabric(0.2, 50.0, 1.0, 0.0))
    start = rest_state(cloth, 1, np.float64)
    places = start.positions.copy()
    places[..., 0] *= span / length
    places[0, 1:-1, 1] = -1e-3
    start = replace(start, positions=places)
    hung = after(20.0, cloth, solver, [Gravity((0, -G, 0)), Drag(2.0)], 1 / 120, start)
    x, y = hung.positions[0, :, 0] - span / 2, hung.positions[0, :, 1]
    assert max_stretch(hung.positions, cloth) < 0.02
    # The catenary of the chain's own length: 2 a sinh(span / 2a), by bisection.
    own = np.hypot(np.diff(x), np.diff(y)).sum()
    low, high = 0.05, 5.0
    for _ in range(80):
        a = (low + high) / 2
        low, high = (a, high) if 2 * a * np.sinh(span / 2 / a) > own else (low, a)
    exact = a * np.cosh(x / a) - a * np.cosh(span / 2 / a)
    assert np.abs(y - exact).max() < 0.01 * span


@pytest.mark.quick
@both
def test_a_free_cloth_keeps_its_linear_momentum(name):
    cloth = grid(6, 7, 1, 1, pins="none")
    start = shaken(cloth)
    end = after(2.0, cloth, DEFAULT[name], [], 1 / 60, start)
    mass = 1 / cloth.inv_mass[:, None]
    before, now = ((mass * state.velocities[0]).sum(0) for state in (start, end))
    np.testing.assert_allclose(now, before, atol=1e-13 * (mass * abs(start.velocities[0])).sum())


def spin_of(cloth, state):
    mass = 1 / cloth.inv_mass[:, None]
    x = state.positions[0] - (mass * state.positions[0]).sum(0) / mass.sum()
    return (mass * np.cross(x, state.velocities[0])).sum(0)


@pytest.mark.quick
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


@pytest.mark.quick
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


@pytest.mark.quick
@both
@pytest.mark.parametrize("pins", ["top", "corners"])
def test_a_cloth_at_rest_does_not_move_without_wind(name, pins):
    cloth = grid(5, 9, 0.8333, 1.6667, pins=pins)
    settled = after(60.0, cloth, DEFAULT[name], [Gravity(), Drag(2.0)], 1 / 60)
    later = after(2.0, cloth, DEFAULT[name], [Gravity(), Drag(2.0)], 1 / 60, settled)
    assert np.abs(later.positions - settled.positions).max() < 1e-6


@pytest.mark.parametrize("speed", [0.0, 4.0, 8.0, 12.0])
@pytest.mark.parametrize("shape", [(5, 9), (11, 21)])
@both
def test_a_banner_stretches_less_than_five_per_cent_for_a_minute(name, shape, speed):
    cloth = grid(*shape, 0.8333, 1.6667)
    wind = speed * np.array([0.35, 0, 1]) / np.hypot(0.35, 1)
    states = simulate(cloth, DEFAULT[name], [Gravity(), Wind(tuple(wind), seed=1)], every=6)
    worst = max(max_stretch(state.positions, cloth) for state in islice(states, 20, 600))
    assert worst < 0.05


@pytest.mark.parametrize("speed", [0.0, 4.0, 8.0, 12.0])
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
    cloth = grid(257, 257, 0.8333, 1.6667)
    states = simulate(cloth, DEFAULT[name], [Gravity()], every=12)
    worst = max(max_stretch(state.positions, cloth) for state in islice(states, 1, 4))
    assert worst < 0.025
