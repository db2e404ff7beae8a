"""Cloth that is gathered on a shorter edge."""

import numpy as np
import pytest
from scene_helpers import flag_of

from drapery.cloth import grid, max_stretch
from drapery.cloth.gathering import fold_count, gathered_state
from drapery.settings import Settings
from drapery.style.cloth_spec import ClothSpec, cloth_at_rest

WIDTH, FULLNESS = 0.8, 0.08


def test_the_edge_has_its_full_length_within_the_width():
    cloth = grid(31, 11, WIDTH * (1 + FULLNESS), 1.6)
    places = gathered_state(cloth, WIDTH).positions[0].reshape(11, 31, 3)
    steps = np.diff(places[0], axis=0)
    length = np.sqrt((steps * steps).sum(axis=1)).sum()
    assert length == pytest.approx(WIDTH * (1 + FULLNESS), rel=0.01)
    assert np.ptp(places[0, :, 0]) == pytest.approx(WIDTH, rel=1e-6)
    assert abs(max_stretch(places.reshape(1, -1, 3), cloth)) < 0.01


def test_folds_lie_in_front_and_run_straight_down():
    places = gathered_state(grid(16, 31, 0.9, 1.6), 0.8).positions[0].reshape(31, 16, 3)
    assert places[..., 2].min() >= 0
    assert np.ptp(places[0, :, 2]) > 0.02
    assert (places[:, :, [0, 2]] == places[:1, :, [0, 2]]).all()


@pytest.mark.parametrize("columns, folds", [(2, 0), (5, 0), (10, 0), (11, 2), (16, 3), (129, 3)])
def test_a_fold_needs_five_cells(columns, folds):
    assert fold_count(columns) == folds


@pytest.mark.parametrize("columns, width", [(5, 0.5), (16, 0.8), (16, 1.0)])
def test_a_coarse_or_narrow_grid_starts_at_rest(columns, width):
    cloth = grid(columns, 9, 0.8, 1.6)
    state = gathered_state(cloth, width)
    assert (state.positions[0] == cloth.rest_positions.astype(np.float32)).all()


@pytest.mark.parametrize("pins, wider", [("top", True), ("corners", False), ("none", False)])
def test_only_cloth_that_is_pinned_along_the_top_is_gathered(pins, wider):
    spec = ClothSpec((16, 31), (WIDTH, 1.6), pins, "xpbd", fullness=FULLNESS)
    assert (np.ptp(cloth_at_rest(spec, 1 / 60).cloth.rest_positions[:, 0]) > WIDTH * 1.01) == wider
    assert np.ptp(cloth_at_rest(spec, 1 / 60).state.positions[0, :, 2]) > 0.02 or not wider


def test_the_flag_of_a_banner_keeps_its_bar_and_its_folds():
    settings = Settings(wind=0.0)
    moving, forces = flag_of(settings)
    top = moving.state.positions[0, :16].copy()
    now = moving.advance(forces, 30).state.positions[0].reshape(31, 16, 3)
    assert (now[0] == top).all()
    assert np.ptp(now[10, :, 2]) > 0.02


def test_a_coarse_banner_is_not_gathered():
    settings = Settings(grid=(5, 9))
    assert (flag_of(settings)[0].state.positions[..., 2] == 0).all()
