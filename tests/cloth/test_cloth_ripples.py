"""Waves of pressure that run along a cloth, and vortices at its sides."""

import gc
import weakref
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from drapery.cloth import Cloth, Fabric, Wind, disc, grid, rest_state, simulate, solver
from drapery.cloth.ripples import PADDING, WAVES, waves_of
from drapery.errors import OptionError

RIPPLED = Wind((0.0, 0.0, 4.0), gusts=0, sine=0, ripples=0.5, ripple_size=0.5)
CLOTH = grid(16, 31, 1.25, 2.5)


def pressure(wind: Wind, cloth: Cloth, time: float) -> np.ndarray:
    """The waves at each particle [m/s], [N]."""
    waves = waves_of(wind, cloth)
    phase = 2 * np.pi * (waves.rates * time + waves.turns)
    total = np.sin(phase) @ waves.sines + np.cos(phase) @ waves.cosines
    return np.asarray(total[:-PADDING])


def test_ripples_have_the_rms_that_is_asked() -> None:
    values = [pressure(RIPPLED, CLOTH, 1.7 * moment) for moment in range(200)]
    assert np.std(values) == pytest.approx(0.5 * 4.0, rel=0.1)
    assert abs(np.mean(values)) < 0.2


def test_ripples_run_from_the_pins_to_the_free_edge() -> None:
    """A head-on wind turns down along the cloth: what is here now is below a moment later."""
    waves = waves_of(RIPPLED, CLOTH)
    assert len(waves.rates) == WAVES and (waves.rates > 0).all()
    down = []
    for wave in range(WAVES):
        place = waves.sines[wave, :-PADDING] + 1j * waves.cosines[wave, :-PADDING]
        down.append(np.angle(place[16 * 5 + 3] / place[16 * 4 + 3]))
    assert all(angle < 0 for angle in down)  # the phase is later farther down


def test_a_side_wind_carries_ripples_along_with_it() -> None:
    waves = waves_of(replace(RIPPLED, velocity=(4.0, 0.0, 0.0)), CLOTH)
    for wave in range(WAVES):
        place = waves.sines[wave] + 1j * waves.cosines[wave]
        assert np.angle(place[16 * 4 + 4] / place[16 * 4 + 3]) < 0


def test_speeds_of_ripples_are_those_of_carried_eddies() -> None:
    """Corcos (1964): 0.45 to 0.75 of the wind's speed, along the flow."""
    waves = waves_of(replace(RIPPLED, velocity=(0.0, -4.0, 0.0)), CLOTH)
    place = waves.sines[:, :-PADDING] + 1j * waves.cosines[:, :-PADDING]
    steps = -np.angle(place[:, 16 * 5] / place[:, 16 * 4]) / (2 * np.pi) / (2.5 / 30)
    across = -np.angle(place[:, 1] / place[:, 0]) / (2 * np.pi) / (1.25 / 15)
    wavenumber = np.sqrt(steps**2 + across**2)
    speeds = waves.rates * wavenumber / steps / wavenumber
    assert ((speeds > 0.45 * 4) & (speeds < 0.75 * 4)).all()


def test_vortices_press_the_two_sides_in_turn() -> None:
    """Fage and Johansen (1927): f b / U = 0.145 behind a plate."""
    wind = Wind((0.0, 0.0, 4.0), vortices=0.5)
    waves = waves_of(wind, CLOTH)
    assert waves.rates == pytest.approx([0.145 * 4 / 1.25])
    values = pressure(wind, CLOTH, 0.4).reshape(31, 16)
    np.testing.assert_allclose(values, -values[:, ::-1], atol=1e-9)
    assert np.abs(values).max() <= 2.0 + 1e-9


def test_a_wind_with_a_period_repeats_exactly() -> None:
    wind = replace(RIPPLED, period=2.5, vortices=0.3)
    np.testing.assert_allclose(pressure(wind, CLOTH, 0.7), pressure(wind, CLOTH, 3.2), atol=1e-9)


def test_the_seed_chooses_the_ripples() -> None:
    same = pressure(replace(RIPPLED), CLOTH, 1.0)
    assert np.array_equal(pressure(RIPPLED, CLOTH, 1.0), same)
    for seed in (1, -1, 2**64 - 1):
        assert not np.array_equal(pressure(replace(RIPPLED, seed=seed), CLOTH, 1.0), same)


def test_waves_are_made_once_for_any_number_of_cloths_and_kept_no_longer() -> None:
    many = [(replace(RIPPLED), grid(3, 4, 0.5, 0.5)) for _ in range(40)]
    made = [waves_of(*each) for each in many]
    assert all(waves_of(*each) is waves for each, waves in zip(many, made, strict=True))
    wind, cloth = many.pop()
    gone = weakref.ref(wind), weakref.ref(cloth)
    del wind, cloth
    gc.collect()
    assert [each() for each in gone] == [None, None]


@pytest.mark.parametrize("name", ["xpbd", "desbrun", "verlet"])
@pytest.mark.parametrize("shape", [(6, 9), (17, 20)])
def test_the_first_step_gives_each_particle_the_force_of_the_waves(
    name: str, shape: tuple[int, int]
) -> None:
    cloth = grid(*shape, 1.0, 1.2, fabric=Fabric(0.3, 0, 0, 0))
    wind = Wind((0.0, 0.0, 2.0), gusts=0, sine=0, ripples=0.5, vortices=0.2)
    dt = 1e-4
    method = solver(name, **({"sweeps": 0} if name != "xpbd" else {"substeps": 1}))
    start = rest_state(cloth, dtype=np.float64)
    *_, after = islice(simulate(cloth, method, [wind], dt, start=start), 2)
    speed = after.velocities[0, :, 2] / dt
    free = cloth.inv_mass > 0
    rows, columns = cloth.grid_shape or (0, 0)
    inner = free.reshape(rows, columns).copy()
    inner[:, [0, -1]] = inner[[0, -1]] = False
    cell = 1.0 / (columns - 1) * 1.2 / (rows - 1)
    force = 0.25 * cell * cloth.inv_mass * (2.0 + pressure(wind, cloth, 0.0))
    np.testing.assert_allclose(speed[inner.ravel()], force[inner.ravel()], rtol=0.02, atol=0.02)


def test_ripples_blow_on_any_cloth_and_beside_other_winds() -> None:
    cloth = disc(4, 0.5, pins=[0])
    steady = Wind((0.0, 2.0, 0.0), gusts=0, sine=0)
    for winds in ([RIPPLED], [steady, RIPPLED], [RIPPLED, steady]):
        *_, state = islice(simulate(cloth, solver("xpbd"), winds, every=10), 2)
        assert np.isfinite(state.positions).all()
        assert np.abs(state.velocities).max() > 0


@pytest.mark.parametrize("name", ["ripples", "ripple_size", "vortices"])
def test_wrong_ripples_are_refused(name: str) -> None:
    for wrong in (-1.0, np.nan, "much"):
        with pytest.raises(OptionError, match=f"wind {name}"):
            Wind((0.0, 0.0, 4.0), **{name: wrong})
