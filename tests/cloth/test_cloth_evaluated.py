"""What forces do to cloths can be had alone, for solvers of one's own."""

from itertools import islice

import numpy as np
import pytest

from drapery.cloth import (
    Drag,
    Fabric,
    Gravity,
    State,
    Wind,
    accelerations,
    disc,
    grid,
    rest_state,
    simulate,
)
from drapery.errors import OptionError

CLOTH = grid(5, 9, width=1.0, height=2.0, fabric=Fabric(density=0.5, drag=0.0))
FREE = CLOTH.inv_mass > 0
STEADY = Wind((0.0, 0.0, 4.0), gusts=0, sine=0, pressure=0.3)


def moving(count: int = 1, dtype: type = np.float64) -> State:
    state = rest_state(CLOTH, count)
    velocities = np.random.default_rng(1).normal(size=state.positions.shape)
    return State(state.positions.astype(dtype), velocities.astype(dtype), 1.25)


def test_gravity_and_drag_are_what_they_say() -> None:
    state = moving()
    found = accelerations([Gravity((1.0, -2.0, 3.0)), Drag(0.5)], CLOTH, state)
    wanted = np.array([1.0, -2.0, 3.0]) - 0.5 * state.velocities
    np.testing.assert_allclose(found[:, FREE], wanted[:, FREE], atol=1e-12)
    assert not found[:, ~FREE].any()


def test_the_drag_of_the_fabric_counts() -> None:
    draggy = grid(5, 9, width=1.0, height=2.0, fabric=Fabric(density=0.5, drag=2.0))
    found = accelerations([], draggy, moving())
    np.testing.assert_allclose(found[:, FREE], -2.0 * moving().velocities[:, FREE])


def test_a_wind_presses_on_a_sheet_by_its_area() -> None:
    free = grid(5, 9, width=1.0, height=2.0, pins="none", fabric=Fabric(density=0.5, drag=0.0))
    found = accelerations([STEADY], free, rest_state(free))
    force = (found / free.inv_mass[:, None]).sum(axis=1)[0]
    np.testing.assert_allclose(force, [0.0, 0.0, 0.3 * 2.0 * 4.0], rtol=1e-5, atol=1e-9)


def test_forces_of_ones_own_are_added() -> None:
    class Push:
        def acceleration(self, cloth: object, state: State) -> np.ndarray:
            return np.full_like(state.positions, 2.0)

    alone = accelerations([STEADY], CLOTH, moving())
    both = accelerations([STEADY, Push()], CLOTH, moving())
    np.testing.assert_allclose((both - alone)[:, FREE], 2.0)


def test_cloths_of_a_batch_have_the_numbers_of_one_alone() -> None:
    gusty = Wind((1.0, 0.0, 4.0), ripples=1.0, vortices=0.5)
    both = accelerations([gusty], CLOTH, moving(3))
    for number in range(3):
        state, only = moving(3), slice(number, number + 1)
        one = State(state.positions[only], state.velocities[only], state.time)
        np.testing.assert_allclose(accelerations([gusty], CLOTH, one)[0], both[number], rtol=1e-9)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_the_result_has_the_type_of_the_state(dtype: type) -> None:
    found = accelerations([Gravity(), STEADY], CLOTH, moving(dtype=dtype))
    assert found.dtype == dtype and found.shape == (1, 45, 3)


def test_meshes_have_wind_too() -> None:
    sheet = disc(4, 0.5)
    found = accelerations([Wind((0.0, 3.0, 0.0), gusts=0, sine=0)], sheet, rest_state(sheet))
    assert (found[..., 1] > 0).all()


def test_what_is_no_force_or_state_is_refused() -> None:
    with pytest.raises(OptionError, match="no method acceleration"):
        accelerations([3], CLOTH, moving())  # type: ignore[list-item]
    with pytest.raises(OptionError, match="NaN or infinity"):
        accelerations([], CLOTH, State(np.full((1, 45, 3), np.nan), np.zeros((1, 45, 3)), 0.0))


class Exploding:
    """A solver whose positions leave all bounds in its third step."""

    def init(self, cloth: object, dt: float) -> None:
        return None

    def step(self, cloth, state, solver_state, forces, dt, *, steps=1, pins=None):  # type: ignore[no-untyped-def]
        grown = state.positions * (np.inf if state.time > 1.5 * dt else 1.0)
        return State(grown, state.velocities, state.time + steps * dt), None


def test_a_solver_of_ones_own_that_gives_no_numbers_is_an_error() -> None:
    with (
        np.errstate(invalid="ignore"),
        pytest.raises(OptionError, match=r"became infinite before 0\.05 s; use a smaller"),
    ):
        list(islice(simulate(CLOTH, Exploding()), 5))  # type: ignore[arg-type]


def test_a_solver_of_ones_own_that_gives_no_state_is_an_error() -> None:
    class Wrong(Exploding):
        def step(self, *given: object, **named: object) -> tuple[object, object]:
            return State(np.zeros((1, 3, 3)), np.zeros((1, 3, 3)), 0.0), None

    with pytest.raises(OptionError, match=r"Wrong gave a wrong state: .* shape \(1, 3, 3\)"):
        list(islice(simulate(CLOTH, Wrong()), 5))  # type: ignore[arg-type]
