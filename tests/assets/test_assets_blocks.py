"""The block textures: opaque, of few colours, and repeating without a seam."""

import numpy as np
import pytest

from assets.drawing.blocks import BLOCKS
from assets.drawing.ground import DIRT, GRASS
from assets.drawing.noise import blurred, ranked, scatter, speckle
from assets.drawing.tile import paint

REPEATING = sorted(set(BLOCKS) - {"grass_block_side", "oak_log_top"})


@pytest.mark.parametrize("name", BLOCKS)
def test_a_block_is_opaque_and_of_few_colours(name):
    texels = BLOCKS[name]()
    assert texels.shape == (16, 16, 4) and texels.dtype == np.uint8
    assert (texels[..., 3] == 255).all()
    assert 3 <= len(np.unique(texels.reshape(-1, 4), axis=0)) <= 10


@pytest.mark.parametrize("name", REPEATING)
@pytest.mark.parametrize("axis", [0, 1])
def test_a_block_repeats_without_a_seam(name, axis):
    """The step from the last line to the first is no greater than those inside are at most."""
    light = BLOCKS[name]()[..., :3].astype(int).sum(axis=2)
    steps = abs(np.roll(light, -1, axis) - light).mean(axis=1 - axis)
    assert steps[-1] <= 1.3 * steps[:-1].max()


def test_no_two_blocks_are_alike():
    assert len({draw().tobytes() for draw in BLOCKS.values()}) == len(BLOCKS) == 12


def test_the_grass_side_is_turf_over_the_very_dirt():
    side, dirt = BLOCKS["grass_block_side"](), BLOCKS["dirt"]()
    assert {tuple(texel) for texel in side[:3, :, :3].reshape(-1, 3).tolist()} <= set(GRASS)
    np.testing.assert_array_equal(side[6:], dirt[6:])
    assert {tuple(texel) for texel in side[6:, :, :3].reshape(-1, 3).tolist()} <= set(DIRT)


def test_ranked_shares_are_exact_and_keep_the_order():
    values = speckle(16, 16, 5)
    tones = ranked(values, (1, 2, 1))
    assert np.bincount(tones.ravel()).tolist() == [64, 128, 64]
    assert values[tones == 0].max() <= values[tones == 1].min()


def test_blur_keeps_the_sum_and_wraps_around():
    values = np.zeros((4, 5), np.int64)
    values[3, 4] = 1
    smooth = blurred(values, 2, 3)
    assert smooth.sum() == 6
    assert smooth[0, 0] == smooth[3, 4] == 1


def test_scatter_is_the_same_forever_and_fills_its_range_evenly():
    x, y = np.arange(64)[None, :], np.arange(64)[:, None]
    values = scatter(x, y, 1)
    assert values.min() >= 0 and values.max() < 65536
    assert abs(np.bincount(values.ravel() >> 13, minlength=8) - 512).max() < 100
    alone = [int(scatter(np.int64(column), np.int64(7), 1)) for column in range(64)]
    assert alone == values[7].tolist()


def test_tones_beyond_a_palette_take_its_ends():
    painted = paint(np.array([[-3, 99]]), GRASS)
    assert painted[0, :, :3].tolist() == [list(GRASS[0]), list(GRASS[-1])]
