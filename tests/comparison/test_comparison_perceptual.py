"""SSIM, FLIP and CIEDE2000 are those of their papers, whatever the tiles and threads."""

import numpy as np
import pytest

from drapery.comparison.colours import lab_difference
from drapery.comparison.perceptual import over_matte, perceptual_measures

PUBLISHED = (
    ((50, 2.6772, -79.7751), (50, 0, -82.7485), 2.0425),
    ((50, -1.3802, -84.2814), (50, 0, -82.7485), 1.0),
    ((50, 0, 0), (50, -1, 2), 2.3669),
    ((50, 2.49, -0.001), (50, -2.49, 0.0009), 7.1792),
    ((50, 2.49, -0.001), (50, -2.49, 0.0011), 7.2195),
    ((50, 2.5, 0), (50, 0, -2.5), 4.3065),
    ((50, 2.5, 0), (73, 25, -18), 27.1492),
    ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
    ((2.0776, 0.0795, -1.135), (0.9033, -0.0636, -0.5514), 0.9082),
)
"""Colours and their differences, from table 1 of Sharma, Wu and Dalal (2005)."""


def pictures(height: int, width: int, share: float) -> tuple[np.ndarray, np.ndarray]:
    """Two random pictures of which this share of the rows may differ."""
    rng = np.random.default_rng(height)
    old = rng.integers(0, 256, (height, width, 4), np.uint8)
    old[::2, ::3, 3] = 255
    new = old.copy()
    rows = slice(height // 3, height // 3 + max(1, int(share * height)))
    new[rows] = rng.integers(0, 256, new[rows].shape, np.uint8)
    return old, new


@pytest.mark.parametrize(("first", "other", "expected"), PUBLISHED)
def test_colours_differ_as_in_the_published_table(
    first: tuple[float, ...], other: tuple[float, ...], expected: float
) -> None:
    one, two = (tuple(np.array([part], float) for part in lab) for lab in (first, other))
    assert float(lab_difference(one, two)[0]) == pytest.approx(expected, abs=6e-5)  # type: ignore[arg-type]


@pytest.mark.parametrize("share", [0.1, 1])
@pytest.mark.parametrize("size", [(61, 47), (5, 60), (2, 3), (90, 7)])
def test_tiles_and_threads_do_not_matter(size: tuple[int, int], share: float) -> None:
    both = pictures(*size, share)
    whole = perceptual_measures(*both, tile=size, threads=1)
    for tile in ((16, 16), (7, 31), (1000, 9)):
        for threads in (1, 2):
            found = perceptual_measures(*both, tile=tile, threads=threads)
            assert found == pytest.approx(whole, rel=1e-6)
    assert perceptual_measures(*both, threads=2) == perceptual_measures(*both, threads=1)


@pytest.mark.parametrize(("size", "share"), [((70, 50), 0.1), ((5, 60), 1), ((64, 64), 1)])
def test_measures_are_those_of_other_programs(size: tuple[int, int], share: float) -> None:
    metrics = pytest.importorskip("skimage.metrics")
    color = pytest.importorskip("skimage.color")
    evaluator = pytest.importorskip("flip_evaluator")  # which has no wheels for Python 3.14
    both = pictures(*size, share)
    found = perceptual_measures(*both, tile=(24, 24))
    shown = [over_matte(picture) for picture in both]
    side = min(7, *size)
    similarity = metrics.structural_similarity(*shown, channel_axis=-1, win_size=side)
    assert found["ssim"] == pytest.approx(similarity, rel=1e-8)
    difference = color.deltaE_ciede2000(*map(color.rgb2lab, shown)).mean()
    assert found["ciede2000"] == pytest.approx(difference, rel=1e-8)
    floats = [picture.astype(np.float32) / 255 for picture in shown]
    assert found["flip"] == pytest.approx(evaluator.evaluate(*floats, "LDR")[1], rel=1e-4)


def test_pictures_that_look_alike_have_no_difference() -> None:
    old, new = pictures(20, 30, 1)
    old[..., 3] = new[..., 3] = 0
    for pair in ((old, old), (old, new)):
        assert perceptual_measures(*pair) == {"ssim": 1, "flip": 0, "ciede2000": 0}
