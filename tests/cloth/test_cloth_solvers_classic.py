"""What the classic solvers promise beside `test_solver_conformance`, and the papers they are of."""

import dataclasses
import itertools
import math
import warnings

import numpy as np
import pytest

from drapery.cloth import (
    STRUCTURAL,
    Cloth,
    Drag,
    Fabric,
    Gravity,
    Wind,
    grid,
    max_stretch,
    simulate,
)
from drapery.cloth.solvers.implicit import SolverImplicit
from drapery.cloth.solvers.pbd import SolverPBD
from drapery.cloth.solvers.provot import SolverProvot
from drapery.cloth.solvers.verlet import SolverVerlet
from drapery.cloth.state import State, rest_state
from drapery.errors import OptionError

PLAIN = {
    "verlet": SolverVerlet(sweeps=0, substeps=1),
    "provot": SolverProvot(sweeps=0, substeps=1),
}
"""Without limits on stretch, one substep: the integrators alone."""
DEFAULT = {
    "verlet": SolverVerlet(),
    "provot": SolverProvot(),
    "implicit": SolverImplicit(),
    "pbd": SolverPBD(),
}
G = 9.81


def chain(places, stiffness=100.0, mass=0.5, pinned=(0,), lengths=None):
    """Particles in a row, each tied to the next."""
    rest = np.asarray(places, float)
    pairs = np.stack([np.arange(len(rest) - 1), np.arange(1, len(rest))], axis=1)
    inv_mass = np.full(len(rest), 1 / mass)
    inv_mass[list(pinned)] = 0
    if lengths is None:
        lengths = np.linalg.norm(np.diff(rest, axis=0), axis=1)
    return Cloth(
        rest_positions=rest,
        inv_mass=inv_mass,
        spring_pairs=pairs.astype(np.int32),
        spring_length=np.asarray(lengths, float),
        spring_stiffness=np.full(len(pairs), float(stiffness)),
        spring_kind=np.full(len(pairs), STRUCTURAL, np.uint8),
        triangles=np.zeros((0, 3), np.int32),
        uvs=np.zeros((len(rest), 2)),
    )


def start_of(cloth, positions=None, velocities=None, count=1):
    state = rest_state(cloth, count, np.float64)
    places = state.positions if positions is None else np.asarray(positions, float)
    speeds = state.velocities if velocities is None else np.asarray(velocities, float)
    shape = state.positions.shape
    return State(np.broadcast_to(places, shape).copy(), np.broadcast_to(speeds, shape).copy())


def run(cloth, solver, forces, dt, steps, start, pins=None):
    """The state after `steps` steps."""
    solver_state = solver.init(cloth, dt)
    return solver.step(cloth, start, solver_state, forces, dt, steps=steps, pins=pins)[0]


def energy(cloth, state):
    """Kinetic energy, height and springs, [J]."""
    mass = np.where(cloth.inv_mass > 0, 1 / np.where(cloth.inv_mass > 0, cloth.inv_mass, 1), 0)
    a, b = cloth.spring_pairs.T
    x, v = state.positions[0].astype(float), state.velocities[0].astype(float)
    strain = np.linalg.norm(x[b] - x[a], axis=1) - cloth.spring_length
    height = (mass * x[:, 1]).sum() * G
    kinetic = 0.5 * (mass * (v * v).sum(axis=1)).sum()
    return kinetic + height + 0.5 * (cloth.spring_stiffness * strain**2).sum()


@pytest.mark.parametrize("name", ["verlet", "provot"])
def test_symplectic_methods_keep_angular_momentum_to_rounding(name):
    cloth = grid(4, 5, 1.0, 1.2, pins="none")
    speeds = np.cross([0.3, 0.5, 2.0], cloth.rest_positions)[None]
    start = start_of(cloth, velocities=speeds)
    end = run(cloth, PLAIN[name], [], 1 / 240, 480, start)
    before = np.cross(start.positions, start.velocities).sum(axis=1)
    after = np.cross(end.positions, end.velocities).sum(axis=1)
    np.testing.assert_allclose(after, before, atol=1e-10)


def test_verlet_is_the_recurrence_of_its_places():
    cloth = grid(4, 4, 0.6, 0.6)
    dt, solver = 1 / 500, PLAIN["verlet"]
    solver_state, state, places = solver.init(cloth, dt), start_of(cloth), []
    for _ in range(30):
        state, solver_state = solver.step(cloth, state, solver_state, [Gravity()], dt)
        places.append(state.positions[0])
    x = np.array(places)
    a, b = cloth.spring_pairs.T
    arms = x[:, b] - x[:, a]
    length = np.linalg.norm(arms, axis=-1, keepdims=True)
    pull = cloth.spring_stiffness[:, None] * (length - cloth.spring_length[:, None]) * arms / length
    force = np.zeros_like(x)
    np.add.at(force, (slice(None), a), pull)
    np.add.at(force, (slice(None), b), -pull)
    free = cloth.inv_mass > 0
    acceleration = force * cloth.inv_mass[:, None] + np.array([0, -9.81, 0])
    # Velocities below 1e-9 m/s count as none, which shows in the twelfth place.
    second = x[2:] - 2 * x[1:-1] + x[:-2]
    np.testing.assert_allclose(second[:, free], (acceleration * dt**2)[1:-1, free], atol=1e-11)


def reordered(cloth, seed=0):
    """The same cloth with its springs listed in another order."""
    order = np.random.default_rng(seed).permutation(len(cloth.spring_length))
    parts = {
        name: getattr(cloth, name)[order]
        for name in ("spring_pairs", "spring_length", "spring_stiffness", "spring_kind")
    }
    return dataclasses.replace(cloth, **parts)


def test_jacobi_order_forgets_how_springs_are_listed_and_provots_does_not():
    cloth = grid(4, 6, 0.6, 1.0, fabric=Fabric(0.3, 1.0, 0.2, 0.1))
    for solver, same in ((SolverVerlet(substeps=4), True), (SolverProvot(substeps=4), False)):
        ends = [
            run(c, solver, [Gravity()], 1 / 60, 20, start_of(c)).positions
            for c in (cloth, reordered(cloth))
        ]
        assert np.allclose(*ends, atol=1e-11) == same


def test_an_overlong_spring_is_pulled_back_at_once():
    cloth = chain([[0, 0, 0], [0, -1, 0], [0, -2, 0]], stiffness=1e-9, pinned=(0,))
    start = start_of(cloth, [[0, 0, 0], [0, -1, 0], [0, -2.4, 0]])
    end = run(cloth, SolverProvot(substeps=1), [], 1 / 60, 1, start)
    # Both ends of the lower spring share 0.3; then the upper one, 1.15 long, loses nothing yet: it
    # was listed first.
    np.testing.assert_allclose(end.positions[0, :, 1], [0, -1.15, -2.25], atol=1e-9)
    pinned = chain([[0, 0, 0], [0, -1, 0]], stiffness=1e-9)
    start = start_of(pinned, [[0, 0, 0], [0, -1.4, 0]])
    for solver in (SolverProvot(substeps=1), SolverVerlet(substeps=1, sweeps=1, relaxation=1.0)):
        end = run(pinned, solver, [], 1 / 60, 1, start)
        np.testing.assert_allclose(end.positions[0, 1], [0, -1.1, 0], atol=1e-9)


def julia_cloth(nx=25, ny=20, spacing=0.2):
    """The published program's particles (j down its rows, then i) and constraints, in its order."""
    i, j = np.meshgrid(np.arange(1, nx + 1), np.arange(1, ny + 1))
    rest = np.stack([i * spacing, j * spacing, 0 * i], axis=-1).reshape(-1, 3)
    number = (np.arange(ny)[:, None] * nx + np.arange(nx)).tolist()
    pairs = []
    for row in range(ny):
        for column in range(nx):
            if column + 1 < nx:
                pairs.append((number[row][column], number[row][column + 1]))
            if row + 1 < ny:
                pairs.append((number[row][column], number[row + 1][column]))
    inv_mass = np.ones(len(rest))
    inv_mass[number[ny - 1]] = 0
    return Cloth(
        rest_positions=rest,
        inv_mass=inv_mass,
        spring_pairs=np.array(pairs, np.int32),
        spring_length=np.full(len(pairs), spacing),
        spring_stiffness=np.ones(len(pairs)),
        spring_kind=np.full(len(pairs), STRUCTURAL, np.uint8),
        triangles=np.zeros((0, 3), np.int32),
        uvs=np.zeros((len(rest), 2)),
    )


def julia_loop(cloth, steps, dt=0.02, spacing=0.2):
    """The published loop, written plainly: move by Verlet, then six passes over all pairs."""
    (xs, ys), (last_xs, last_ys) = (cloth.rest_positions[:, :2].T.tolist() for _ in range(2))
    pinned = (cloth.inv_mass == 0).tolist()
    free = [p for p in range(len(xs)) if not pinned[p]]
    pairs = cloth.spring_pairs.tolist()
    for step in range(1, steps + 1):
        wind, gravity = 2 * math.sin(0.05 * step), -9.8
        for p in free:
            x, y = xs[p], ys[p]
            xs[p] = x + (x - last_xs[p]) + wind * dt**2
            ys[p] = y + (y - last_ys[p]) + gravity * dt**2
            last_xs[p], last_ys[p] = x, y
        for _ in range(6):
            for p, q in pairs:
                dx, dy = xs[q] - xs[p], ys[q] - ys[p]
                length = math.sqrt(dx * dx + dy * dy)
                part = 0.5 * (length - spacing) / length
                if not pinned[p]:
                    xs[p] += part * dx
                    ys[p] += part * dy
                if not pinned[q]:
                    xs[q] -= part * dx
                    ys[q] -= part * dy
    return np.stack([xs, ys], axis=1)


class SineWind:
    """Acceleration 2 sin(0.05 n) along x in step n of 0.02 s."""

    def acceleration(self, cloth, state):
        step = round(state.time / 0.02) + 1
        return np.broadcast_to([2 * np.sin(0.05 * step), 0, 0], state.positions.shape)


def test_pbd_runs_the_published_julia_loop_to_rounding():
    cloth = julia_cloth()
    forces = [Gravity((0, -9.8, 0)), SineWind()]
    end = run(cloth, SolverPBD.plain(passes=6), forces, 0.02, 300, start_of(cloth))
    np.testing.assert_allclose(end.positions[0, :, :2], julia_loop(cloth, 300), atol=1e-9)
    assert not end.positions[0, :, 2].any()


def test_a_cape_may_shrink_but_not_grow():
    cloth = chain([[0, 0, 0], [1, 0, 0], [2, 0, 0]], pinned=(0,))
    squeezed = start_of(cloth, [[0, 0, 0], [0.3, 0, 0], [0.9, 0, 0]])
    end = run(cloth, SolverPBD.cape(), [], 1 / 60, 10, squeezed)
    np.testing.assert_array_equal(end.positions, squeezed.positions)
    stretched = start_of(cloth, [[0, 0, 0], [1.5, 0, 0], [3, 0, 0]])
    end = run(cloth, SolverPBD.cape(passes=60), [], 1 / 60, 1, stretched)
    np.testing.assert_allclose(end.positions[0, :, 0], [0, 1, 2], atol=1e-6)


@pytest.mark.parametrize("shape", [(5, 9), (11, 21), (21, 41), (41, 81)])
@pytest.mark.parametrize("speed", [0, 12])
def test_pbd_stretches_at_most_five_per_cent(shape, speed):
    cloth = grid(*shape, 1.25, 2.5)
    forces = [Gravity(), Drag(0.1), Wind((0.3 * speed, 0.0, 0.95 * speed))]
    states = simulate(cloth, SolverPBD(), forces, every=15)
    for state in itertools.islice(states, 4, 14):
        assert max_stretch(state.positions, cloth) <= 0.05


def test_one_implicit_step_solves_the_linear_system():
    cloth = grid(3, 4, 0.6, 0.9, pins="corners", fabric=Fabric(0.3, 40.0, 10.0, 5.0))
    random = np.random.default_rng(8)
    free = cloth.inv_mass > 0
    # All springs are stretched, so no part of a Jacobian is left out.
    x = cloth.rest_positions * 1.2 + random.normal(size=(12, 3)) * 0.01
    v = random.normal(size=(12, 3)) * free[:, None]
    dt, gravity = 1 / 30, np.array([0, -9.81, 0])
    solver = SolverImplicit(sweeps=0, tolerance=1e-12, damping=0.02)
    end = run(cloth, solver, [Gravity()], dt, 1, start_of(cloth, x, v))

    count = len(x)
    K, D, f = np.zeros((count, 3, count, 3)), np.zeros((count, 3, count, 3)), np.zeros((count, 3))
    for (i, j), rest, k in zip(
        cloth.spring_pairs, cloth.spring_length, cloth.spring_stiffness, strict=True
    ):
        arm = x[j] - x[i]
        length = np.linalg.norm(arm)
        n = np.outer(arm, arm) / length**2
        assert length > rest
        pull = k * (length - rest) * arm / length + 0.02 * k * n @ (v[j] - v[i])
        f[i] += pull
        f[j] -= pull
        for block, matrix in (
            (k * (n + (1 - rest / length) * (np.eye(3) - n)), K),
            (0.02 * k * n, D),
        ):
            for a, b in ((i, j), (j, i)):
                matrix[a, :, b] += block
                matrix[a, :, a] -= block
    mass = 1 / cloth.inv_mass[free]
    f[free] += mass[:, None] * gravity
    K, D = (m[free][:, :, free].reshape(3 * free.sum(), -1) for m in (K, D))
    M = np.diag(np.repeat(mass, 3))
    change = np.linalg.solve(
        M - dt * D - dt**2 * K, dt * (f[free].ravel() + dt * K @ v[free].ravel())
    )
    np.testing.assert_allclose(end.velocities[0, free].ravel(), v[free].ravel() + change, atol=1e-9)


def test_implicit_stands_any_stiffness_and_step():
    cloth = grid(5, 5, 1.0, 1.0, fabric=Fabric(0.3, 1e8, 1e7, 1e6))
    solver = SolverImplicit(sweeps=0, iterations=2000)
    end = run(cloth, solver, [Gravity(), Wind((0.0, 0.0, 30.0))], 0.1, 50, start_of(cloth))
    assert np.isfinite(end.positions).all() and np.abs(end.positions).max() < 2


def test_implicit_warns_once_a_call_that_it_has_not_converged():
    cloth, dt = grid(5, 5, 1.0, 1.0, fabric=Fabric(0.3, 1e6, 1e5, 1e4)), 0.1
    solver = SolverImplicit(iterations=2, threads=2)
    start = rest_state(cloth, 600)
    message = r"after 2 iterations with a residual of .*; use"
    with pytest.warns(UserWarning, match=message) as warned:
        solver.step(cloth, start, solver.init(cloth, dt), [Gravity()], dt, steps=3)
    assert len(warned) == 1 and warned[0].filename == __file__


def test_implicit_does_not_warn_where_it_converges():
    cloth = grid(5, 9, 0.8, 1.6)
    forces = [Gravity(), Wind((1.0, 0.0, 5.0))]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run(cloth, SolverImplicit(), forces, 1 / 60, 60, rest_state(cloth))


@pytest.mark.parametrize("name", DEFAULT)
def test_a_damped_curtain_loses_energy_and_comes_to_rest(name):
    cloth = grid(6, 7, 1.0, 1.2)
    tilted = cloth.rest_positions.copy()
    tilted[:, 1:] = tilted[:, 1:] @ np.array([[0.5, -0.866], [0.866, 0.5]])
    energies, state = [], None
    forces = [Gravity((0, -G, 0)), Drag(1.5)]
    for state in itertools.islice(
        simulate(cloth, DEFAULT[name], forces, every=30, start=start_of(cloth, tilted)), 40
    ):
        energies.append(energy(cloth, state))
    scale = energies[0] - min(energies)
    assert (np.diff(energies) <= 0.02 * scale).all()
    assert energies[-1] < energies[0] and np.abs(state.velocities).max() < 0.02


@pytest.mark.parametrize("name", DEFAULT)
def test_four_three_and_two_corners_hang_as_they_should(name):
    heights = {}
    for pins in ("four-corners", "three-corners", "corners"):
        cloth = grid(10, 10, 1.0, 1.0, pins=pins)
        # Laid level, with a little slack between the corners.
        level = cloth.rest_positions[:, [0, 2, 1]] * 0.95
        start = start_of(cloth, level)
        end = run(cloth, DEFAULT[name], [Gravity(), Drag(2.0)], 1 / 60, 600, start)
        held = cloth.inv_mass == 0
        np.testing.assert_array_equal(end.positions[0, held], level[held])
        assert np.abs(end.velocities).max() < 0.1
        heights[pins] = end.positions[0, :, 1].reshape(10, 10)
    # A hammock: the middle lies lowest or nearly so, the same from both sides.
    hammock = heights["four-corners"]
    assert hammock[4:6, 4:6].mean() < 0.9 * hammock.min() < -0.05
    np.testing.assert_allclose(hammock, hammock[:, ::-1], atol=0.03)
    # The free corner droops lowest.
    assert heights["three-corners"].argmin() == 99 and heights["three-corners"][9, 9] < -0.4
    # A curtain: each row hangs lower than the one before, the free edge a cloth's height down.
    assert (np.diff(heights["corners"].mean(axis=1)) < 0).all()
    assert heights["corners"][9].max() < -0.8


@pytest.mark.parametrize("name", DEFAULT)
def test_nothing_breaks_in_a_gale(name):
    cloth = grid(7, 9, 1.0, 1.4)
    gale = Wind((20.0, 5.0, 20.0), gusts=1.0)
    end = run(cloth, DEFAULT[name], [Gravity(), gale], 1 / 60, 3000, rest_state(cloth))
    assert np.isfinite(end.positions).all() and np.abs(end.positions).max() < 3


@pytest.mark.parametrize(
    "make",
    [
        lambda: SolverVerlet(limit=0.9),
        lambda: SolverVerlet(sweeps=-1),
        lambda: SolverVerlet(relaxation=2),
        lambda: SolverProvot(limit=np.nan),
        lambda: SolverProvot(substeps=0),
        lambda: SolverPBD(passes=-1),
        lambda: SolverPBD(constraint="elastic"),
        lambda: SolverPBD(order="random"),
        lambda: SolverPBD(shares="all"),
        lambda: SolverPBD(stiffness=(1, 2, 0)),
        lambda: SolverPBD(stiffness=(1, 0)),
        lambda: SolverPBD(damping=-1),
        lambda: SolverImplicit(tolerance=0),
        lambda: SolverImplicit(iterations=0),
        lambda: SolverImplicit(damping=np.inf),
        lambda: SolverVerlet().init(grid(3, 3, 1, 1, fabric=Fabric(0.3, 1e12, 1, 1)), 1 / 60),
        lambda: SolverPBD().init(grid(3, 3, 1, 1), 0.0),
        lambda: SolverImplicit().init(grid(3, 3, 1, 1), np.nan),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(make):
    with pytest.raises(OptionError) as fault:
        make()
    assert "\n" not in str(fault.value)
