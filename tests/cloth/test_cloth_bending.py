"""Bending against closed forms: energies, Peirce's cantilever, a vibrating strip."""

from itertools import islice, pairwise

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from drapery.cloth import (
    Cloth,
    Drag,
    Fabric,
    Gravity,
    Solver,
    SolverDesbrun,
    SolverImplicit,
    SolverPBD,
    SolverProvot,
    SolverVerlet,
    SolverXPBD,
    State,
    disc,
    grid,
    rest_state,
    sew,
    simulate,
    solver,
    strip,
)
from drapery.cloth.bending import Bending, triangle_bending
from drapery.cloth.world import coarsen
from drapery.errors import OptionError

RIGIDITY, DENSITY, LENGTH = 0.08, 0.2, 1.0
G = 9.81


def energy(bending: Bending, positions: np.ndarray) -> float:
    vectors = (bending.weights[:, :, None] * positions[bending.particles]).sum(axis=1)
    lengths = np.linalg.norm(vectors, axis=1)
    return float(0.5 * (bending.stiffness * (lengths - bending.rest) ** 2).sum())


def rolled(flat: np.ndarray, radius: float, turn: float) -> np.ndarray:
    """Points of the plane x, y on a cylinder whose axis is turned from y by an angle."""
    along = np.array([np.cos(turn), np.sin(turn)])
    across = np.array([-np.sin(turn), np.cos(turn)])
    u, v = flat[:, :2] @ along, flat[:, :2] @ across
    bent = np.stack([radius * np.sin(u / radius), v, radius * np.cos(u / radius)], axis=1)
    return np.asarray(bent)


@pytest.mark.parametrize("turn", [0.0, np.pi / 6, np.pi / 4, np.pi / 2])
@pytest.mark.parametrize(("columns", "rows"), [(41, 61), (81, 31)])
def test_a_grid_on_a_cylinder_has_the_energy_of_a_plate(turn, columns, rows):
    cloth = grid(columns, rows, 1.0, 1.5, pins="none", fabric=Fabric(bending=1e-4))
    plate = 0.5 * 1e-4 * (1 / 2.0) ** 2 * 1.5
    assert energy(cloth.bending, rolled(cloth.rest_positions, 2.0, turn)) == pytest.approx(
        plate, rel=0.07
    )


@pytest.mark.parametrize("turn", [0.0, np.pi / 6, np.pi / 4, np.pi / 2])
def test_equilateral_triangles_on_a_cylinder_have_the_energy_of_a_plate(turn):
    side, count = 0.03, 40
    row, column = np.divmod(np.arange(count * count), count)
    flat = np.stack([side * (column + row / 2), side * row * np.sqrt(0.75), 0 * row], axis=1)
    a = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    faces = np.concatenate(
        [np.stack([a, a + 1, a + count], 1), np.stack([a + 1, a + count + 1, a + count], 1)]
    )
    bending = triangle_bending(flat, faces, 1e-4, 0.0)
    area = (count - 1) ** 2 * side**2 * np.sqrt(0.75)
    plate = 0.5 * 1e-4 * (1 / 3.0) ** 2 * area
    assert energy(bending, rolled(flat, 3.0, turn)) == pytest.approx(plate, rel=0.05)


def test_a_cloth_that_is_curved_at_rest_has_no_energy_there():
    from drapery.cloth import from_triangles

    flat = disc(5, 0.3, pins=[0])
    x, _, z = flat.rest_positions.T
    dome = np.stack([x, -(x * x + z * z), z], axis=1)
    cloth = from_triangles(dome, flat.triangles, fabric=Fabric(bending=1e-3))
    assert cloth.bending.rest.max() > 0
    assert energy(cloth.bending, cloth.rest_positions) == 0
    assert energy(cloth.bending, flat.rest_positions) > 0
    *_, later = islice(simulate(cloth, SolverVerlet(), [], 1 / 60), 20)
    assert np.abs(later.positions[0] - cloth.rest_positions).max() < 1e-5


def clamped(count: int, stretch: float = 2000.0) -> Cloth:
    fabric = Fabric(DENSITY, stretch, 0, 0, bending=RIGIDITY, damping=0.02)
    return strip(count, LENGTH, width=0.2, pins=(0, 1), fabric=fabric)


def settled(cloth: Cloth, method: Solver) -> State:
    """At rest under gravity: fast with much drag, then with little, which biases less."""
    state = rest_state(cloth, dtype=np.float64)
    for rate, seconds in ((5.0, 2), (1.0, 5)):
        states = simulate(cloth, method, [Gravity(), Drag(rate)], 1 / 120, start=state, every=60)
        *_, state = islice(states, 2 * seconds + 1)
    return state


def elastica(cloth: Cloth) -> float:
    """Angle of the chord below the horizontal [degrees] of an inextensible heavy strip.

    B θ'' = -w (L - s) cos θ with θ(0) = 0 and θ'(L) = 0 (Bickley, Phil. Mag. 17, 1934). The clamp
    is half a spacing before the first free particle's neighbour, where its stencil's area ends.
    """
    count = len(cloth.inv_mass)
    spacing = LENGTH / (count - 1)
    length, weight = LENGTH - spacing / 2, G * DENSITY * (count - 1) / count
    s = np.linspace(0, length, 400)

    def slopes(s, y):
        return np.vstack([y[1], -weight * (length - s) * np.cos(y[0]) / RIGIDITY])

    bent = solve_bvp(slopes, lambda a, b: np.array([a[0], b[1]]), s, np.zeros((2, s.size)))
    angle = bent.sol(s)[0]
    x = sum((s[1] - s[0]) * (np.cos(a) + np.cos(b)) / 2 for a, b in pairwise(angle))
    y = sum((s[1] - s[0]) * (np.sin(a) + np.sin(b)) / 2 for a, b in pairwise(angle))
    return float(np.degrees(np.arctan2(y, x)))


def droop(cloth: Cloth, state: State) -> float:
    """The same angle of a simulated strip, from half a spacing before its clamped particle."""
    x, y, _ = state.positions[0, -1] - state.positions[0, :2].mean(axis=0)
    return float(np.degrees(np.arctan2(-y, x)))


@pytest.mark.parametrize("count", [11, 21])
@pytest.mark.parametrize("name", ["xpbd", "implicit"])
def test_a_cantilever_droops_as_the_elastica(name, count):
    cloth = clamped(count)
    assert droop(cloth, settled(cloth, solver(name))) == pytest.approx(elastica(cloth), abs=2.5)


@pytest.mark.parametrize(
    "method",
    [
        SolverDesbrun(),
        SolverXPBD(),
        SolverPBD(substeps=8),
        SolverVerlet(),
        SolverProvot(sweeps=0),
        SolverImplicit(),
    ],
    ids=lambda method: type(method).__name__,
)
def test_every_solver_carries_bending(method):
    cloth = clamped(9, stretch=200.0)
    assert droop(cloth, settled(cloth, method)) == pytest.approx(elastica(cloth), abs=5)


def test_peirces_formula_gives_the_rigidity_of_a_short_strip():
    """Peirce, J. Text. Inst. 21 (1930): B = w L³ cos(φ/2) / (8 tan φ)."""
    fabric = Fabric(0.05, 2000.0, 0, 0, bending=RIGIDITY, damping=0.02)
    cloth = strip(21, LENGTH, width=0.2, pins=(0, 1), fabric=fabric)
    angle = np.radians(droop(cloth, settled(cloth, SolverImplicit())))
    length = LENGTH - LENGTH / 40
    rigidity = 0.05 * G * length**3 * np.cos(angle / 2) / (8 * np.tan(angle))
    assert rigidity == pytest.approx(RIGIDITY, rel=0.1)


@pytest.mark.parametrize("count", [11, 21])
@pytest.mark.parametrize("name", ["xpbd", "verlet"])
def test_a_clamped_strip_vibrates_with_its_period(name, count):
    """ω² = 3 B b / (L³ (0.2427 M + m)), so 3.516² B / (ρ L⁴) without a mass m at the tip: Rayleigh,
    "The Theory of Sound" (1894), § 172. The last particle has half a spacing more than its part."""
    fabric = Fabric(DENSITY, 300.0, 0, 0, bending=RIGIDITY)
    cloth = strip(count, LENGTH, width=0.2, pins=(0, 1), fabric=fabric)
    length = LENGTH * (1 - 0.5 / (count - 1))
    density = DENSITY * (count - 1) / count
    s = np.maximum(0, cloth.rest_positions[:, 0] - (LENGTH - length)) / length
    start = rest_state(cloth, dtype=np.float64)
    positions = start.positions.copy()
    positions[0, :, 1] = 0.01 * s**2 * (6 - 4 * s + s * s)  # near the first mode's shape
    positions[0, cloth.inv_mass == 0] = cloth.rest_positions[cloth.inv_mass == 0]
    states = simulate(cloth, solver(name), [], 1 / 120, start=State(positions, start.velocities))
    heights = np.array([state.positions[0, -1, 1] for state in islice(states, 200)])
    crossing = int(np.flatnonzero(heights <= 0)[0])
    part = heights[crossing - 1] / (heights[crossing - 1] - heights[crossing])
    quarter = (crossing - 1 + part) / 120
    mass = 0.2427 * density * length + density * LENGTH / (count - 1) / 2
    expected = np.pi / 2 / np.sqrt(3 * RIGIDITY / (length**3 * mass))
    assert quarter == pytest.approx(expected, rel=0.03)


def test_bending_does_not_move_or_turn_a_free_cloth():
    cloth = grid(7, 9, 0.6, 0.8, pins="none", fabric=Fabric(0.2, 5, 1, 0, bending=1e-2))
    rng = np.random.default_rng(1)
    start = rest_state(cloth, dtype=np.float64)
    positions = start.positions + 0.01 * rng.normal(size=start.positions.shape)
    *_, end = islice(
        simulate(
            cloth, SolverVerlet(sweeps=0), [], 1 / 60, start=State(positions, start.velocities)
        ),
        60,
    )
    mass = 1 / cloth.inv_mass[None, :, None]
    assert np.abs((mass * end.velocities).sum(axis=1)).max() < 1e-12
    spin = (mass * np.cross(end.positions, end.velocities)).sum(axis=1)
    assert np.abs(spin).max() < 1e-10


@pytest.mark.parametrize("name", ["desbrun", "xpbd"])
def test_a_fine_sheet_and_a_batch_bend_alike(name):
    """The plane of lanes and the general path differ only in the order of corrections."""
    fabric = Fabric(0.3, 20, 5, 0, bending=2e-3, damping=0.02)
    sheet = grid(16, 12, 1.0, 0.8, pins="corners", fabric=fabric)
    narrow = grid(15, 12, 1.0, 0.8, pins="corners", fabric=fabric)
    low = [
        [*islice(simulate(cloth, solver(name), every=60), 4)][-1].positions[0, :, 1].min()
        for cloth in (sheet, narrow)
    ]
    assert low[0] == pytest.approx(low[1], abs=0.02)


def test_a_coarser_cloth_keeps_the_rigidity():
    fine = grid(9, 17, 1.0, 2.0, fabric=Fabric(bending=1e-3, damping=0.1))
    coarse = coarsen(fine)
    again = grid(5, 9, 1.0, 2.0, fabric=Fabric(bending=1e-3, damping=0.1))
    assert coarse is not None
    np.testing.assert_allclose(coarse.bending.stiffness, again.bending.stiffness)
    assert coarse.bending.damping == 0.1


def test_sewn_cloths_bend_apart_from_the_seam():
    fabric = Fabric(bending=1e-3, damping=0.1)
    left, right = (grid(3, 4, 0.5, 0.5, fabric=fabric) for _ in range(2))
    sewn = sew([left, right])
    assert len(sewn.bending.stiffness) == 2 * len(left.bending.stiffness)
    assert sewn.bending.particles.max() == len(sewn.inv_mass) - 1
    with pytest.raises(OptionError, match="damping of 0 and"):
        sew([left, grid(3, 4, 0.5, 0.5, fabric=Fabric(bending=1e-3))])


def test_wrong_bending_is_refused():
    one = np.ones((1, 4))
    for values in (
        (np.zeros((1, 3), np.int32), one, np.ones(1), np.zeros(1)),
        (np.zeros((1, 4), np.int32), one * np.nan, np.ones(1), np.zeros(1)),
        (np.zeros((1, 4), np.int32), one, -np.ones(1), np.zeros(1)),
        (np.zeros((1, 4), np.int32), one, np.ones(1), np.zeros(1), -1.0),
    ):
        with pytest.raises(OptionError, match="bending"):
            Bending(*values)
