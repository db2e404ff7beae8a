"""A fine grid laid out as a plane of lanes moves as it does in a batch."""

from itertools import islice

import numpy as np
import pytest

from drapery.cloth import (
    Gravity,
    SolverDesbrun,
    SolverXPBD,
    Wind,
    grid,
    rest_state,
    simulate,
)
from drapery.cloth.solvers import desbrun, xpbd

SOLVERS = {"desbrun": SolverDesbrun(), "xpbd": SolverXPBD()}
each = pytest.mark.parametrize("name", SOLVERS)
FORCES = [Gravity(), Wind((1.0, 0.0, 3.0), seed=2)]


def moved(cloth, solver, steps, *, count=1, forces=FORCES, dtype=np.float64, every=None, **options):
    every = every or steps
    start = rest_state(cloth, count, dtype)
    frames = simulate(cloth, solver, forces, start=start, every=every, **options)
    return next(islice(frames, steps // every, None))


def as_a_batch(monkeypatch):
    for module in (desbrun, xpbd):
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
    # Only the order of the corrections along a row differs.
    assert np.abs(sheet.positions - batch.positions).max() < 0.1 * way


@each
@pytest.mark.parametrize("columns", [16, 23, 24, 40])
def test_any_width_and_kind_of_number(name, columns):
    cloth = grid(columns, 7, 0.8, 1.2, pins="four-corners")
    exact = moved(cloth, SOLVERS[name], 12)
    single = moved(cloth, SOLVERS[name], 12, dtype=np.float32)
    np.testing.assert_allclose(single.positions, exact.positions, atol=2e-3)


def test_xpbd_plans_cloths_with_the_same_contents_once():
    first, second = (grid(9, 9, 1.0, 1.0) for _ in range(2))
    plan = SolverXPBD().init(first, 1 / 60).plan
    assert SolverXPBD().init(second, 1 / 60).plan is plan
    second.inv_mass[40] = 0
    assert SolverXPBD().init(second, 1 / 60).plan is not plan
    assert SolverXPBD(substeps=2).init(first, 1 / 60).plan is not plan
    listed = SolverXPBD(compliance=[0.0, None, None])  # type: ignore[arg-type]
    assert listed.init(first, 1 / 60).plan is plan
