"""A fine grid laid out as a plane of lanes moves as it does in a batch."""

from itertools import islice

import numpy as np
import pytest

from drapery.cloth import (
    FABRICS,
    Gravity,
    SolverDesbrun,
    SolverProvot,
    SolverVerlet,
    SolverXPBD,
    Wind,
    grid,
    max_stretch,
    rest_state,
    simulate,
)
from drapery.cloth.solvers import desbrun, provot, verlet, xpbd

SOLVERS = {
    "desbrun": SolverDesbrun(),
    "provot": SolverProvot(),
    "verlet": SolverVerlet(),
    "xpbd": SolverXPBD(),
}
each = pytest.mark.parametrize("name", SOLVERS)
FORCES = [Gravity(), Wind((1.0, 0.0, 3.0), seed=2)]


def moved(cloth, solver, steps, *, count=1, forces=FORCES, dtype=np.float64, every=None, **options):
    every = every or steps
    start = rest_state(cloth, count, dtype)
    frames = simulate(cloth, solver, forces, start=start, every=every, **options)
    return next(islice(frames, steps // every, None))


def as_a_batch(monkeypatch):
    for module in (desbrun, provot, verlet, xpbd):
        monkeypatch.setattr(module, "is_sheet", lambda cloth: False)


@each
@pytest.mark.parametrize("pins", ["top", "corners"])
def test_a_sheet_moves_like_the_same_cloth_in_a_batch(name, pins, monkeypatch):
    cloth = grid(18, 21, 0.8, 1.2, pins=pins)
    sheet = moved(cloth, SOLVERS[name], 30)
    as_a_batch(monkeypatch)
    batch = moved(cloth, SOLVERS[name], 30)
    way = np.abs(batch.positions - cloth.rest_positions).max()
    assert way > 0.1
    # Only the order of the corrections differs: along a row, and of all in provot's one sweep.
    part = 0.2 if name == "provot" else 0.1
    assert np.abs(sheet.positions - batch.positions).max() < part * way
    stretch = max_stretch(sheet.positions[0], cloth), max_stretch(batch.positions[0], cloth)
    assert stretch[0] < stretch[1] + 0.01


@each
@pytest.mark.parametrize("columns", [16, 23, 24, 40])
def test_any_width_and_kind_of_number(name, columns):
    cloth = grid(columns, 7, 0.06 * columns, 1.2, pins="four-corners")
    exact = moved(cloth, SOLVERS[name], 12)
    single = moved(cloth, SOLVERS[name], 12, dtype=np.float32)
    np.testing.assert_allclose(single.positions, exact.positions, atol=2e-3)


@pytest.mark.parametrize("pins", ["top", "corners", "none"])
def test_verlet_moves_a_sheet_by_the_same_arithmetic(pins, monkeypatch):
    """Its sums do not depend on an order, but for rounding."""
    cloth = grid(18, 21, 0.8, 1.2, pins=pins, fabric=FABRICS["leather"])
    sheet = moved(cloth, SOLVERS["verlet"], 30)
    as_a_batch(monkeypatch)
    batch = moved(cloth, SOLVERS["verlet"], 30)
    np.testing.assert_allclose(sheet.positions, batch.positions, rtol=0, atol=1e-9)
    np.testing.assert_allclose(sheet.velocities, batch.velocities, rtol=0, atol=1e-7)


def test_pins_of_a_sheet_that_follow_a_path_keep_its_velocity():
    cloth = grid(18, 5, 0.8, 0.3)
    top = cloth.rest_positions[:18]
    sheet = moved(cloth, SOLVERS["verlet"], 6, pins=lambda time: top + np.array([0.5 * time, 0, 0]))
    np.testing.assert_allclose(sheet.velocities[0, :18], [[0.5, 0, 0]] * 18, atol=1e-9)


def test_xpbd_plans_cloths_with_the_same_contents_once():
    first, second = (grid(9, 9, 1.0, 1.0) for _ in range(2))
    plan = SolverXPBD().init(first, 1 / 60).plan
    assert SolverXPBD().init(second, 1 / 60).plan is plan
    second.inv_mass[40] = 0
    assert SolverXPBD().init(second, 1 / 60).plan is not plan
    assert SolverXPBD(substeps=2).init(first, 1 / 60).plan is not plan
    listed = SolverXPBD(compliance=[0.0, None, None])  # type: ignore[arg-type]
    assert listed.init(first, 1 / 60).plan is plan
