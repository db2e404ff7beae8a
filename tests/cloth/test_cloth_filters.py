"""All forms of Desbrun's filter are the same matrix."""

import numpy as np
import pytest
from numba import njit

from drapery.cloth import Fabric, disc, filters, grid, kernels, sheet_kernels
from drapery.cloth.faces import wind_faces
from drapery.cloth.filters import (
    band_filter,
    cloth_filter,
    dense_filter,
    separable_filter,
    sheet_filter,
)
from drapery.cloth.sheets import sheet_of

DT = 1 / 60
PINS = ["none", "top", "corners", "four-corners"]


@njit
def _filtered(both, filter_, pins):
    kernels.filter_velocities(both, filter_, pins)


@njit
def _sheet_filtered(g, other, filter_, sheet):
    sheet_kernels.filter_sheet(g, other, filter_, sheet)


def velocities(cloth, lanes=8):
    values = np.random.default_rng(0).normal(size=(len(cloth.inv_mass), 3, lanes))
    values[cloth.inv_mass == 0] = 0
    return values


def by(filter_, cloth, values):
    flat = values.reshape(-1, values.shape[2])
    both = np.stack([flat, np.zeros_like(flat)])
    _filtered(both, filter_, np.flatnonzero(cloth.inv_mass == 0))
    return both[1].reshape(values.shape)


def by_matrix(cloth, values):
    return np.einsum("ij,jal->ial", dense_filter(cloth, DT), values)


@pytest.mark.parametrize("pins", PINS)
@pytest.mark.parametrize("factors", [False, True])
def test_products_along_rows_and_columns_are_the_matrix(pins, factors, monkeypatch):
    if factors:
        monkeypatch.setattr(filters, "MAX_MATRIX_NUMBERS", 0)
    # With structural springs alone no spring leaves the grid, so nothing is mirrored.
    cloth = grid(7, 12, 0.8, 1.6, pins=pins, fabric=Fabric(0.3, 5.0, 0.0, 0.0))
    values = velocities(cloth)
    found = by(separable_filter(cloth, DT), cloth, values)
    np.testing.assert_allclose(found, by_matrix(cloth, values), atol=1e-13)


@pytest.mark.parametrize("pins", PINS)
def test_a_sheets_columns_solved_are_the_columns_multiplied(pins):
    cloth = grid(17, 12, 0.8, 1.6, pins=pins)
    sheet, values = sheet_of(cloth, *wind_faces(cloth)), velocities(cloth)
    g = np.zeros((3, sheet.plane))
    lanes = np.arange(204) // 17 * sheet.width + np.arange(204) % 17
    g[:, lanes] = values[:, :, 0].T
    _sheet_filtered(g, np.zeros_like(g), sheet_filter(cloth, DT, sheet.width), sheet)
    expected = by(separable_filter(cloth, DT), cloth, values)
    np.testing.assert_allclose(g[:, lanes].T, expected[:, :, 0], atol=1e-13)


@pytest.mark.parametrize(
    "cloth", [disc(4, 0.5, pins=[0]), disc(4, 0.5), grid(6, 5, 1, 1, pins=range(0, 30, 4))]
)
def test_a_band_solve_is_the_matrix(cloth):
    values = velocities(cloth)
    found = by(band_filter(cloth, DT), cloth, values)
    np.testing.assert_allclose(found, by_matrix(cloth, values), atol=1e-13)


def test_the_mirrored_filter_is_near_the_matrix_and_damps_no_less():
    cloth = grid(7, 12, 0.8, 1.6)
    values = velocities(cloth)
    found, exact = by(separable_filter(cloth, DT), cloth, values), by_matrix(cloth, values)
    assert np.abs(found - exact).max() < 0.1 * np.abs(exact).max()
    assert (found**2).sum() <= (exact**2).sum()


@pytest.mark.parametrize("pins", PINS)
def test_rows_sum_to_one_where_nothing_is_pinned_and_pins_stay(pins):
    cloth = grid(6, 8, 1, 1, pins=pins)
    W = dense_filter(cloth, DT)
    if pins == "none":
        np.testing.assert_allclose(W.sum(axis=1), 1, atol=1e-12)
    pinned = cloth.inv_mass == 0
    np.testing.assert_array_equal(W[pinned], np.eye(len(W))[pinned])


def test_each_cloth_gets_the_cheapest_form():
    forms = [grid(5, 9, 1, 1), disc(4, 1), disc(12, 1)]
    names = [type(cloth_filter(cloth, DT)).__name__ for cloth in forms]
    assert names == ["Filter", "Filter", "BandFilter"]
