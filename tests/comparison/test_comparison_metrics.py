"""What counts as a difference of two pictures: channels, colours, smoothed edges, ignored parts."""

import itertools

import numpy as np
import pytest
from hypothesis import given, strategies as st
from numpy.typing import NDArray

from drapery.comparison.antialiasing import is_smoothed, perceived_difference
from drapery.comparison.ignored import ignored_pixels, painted
from drapery.comparison.metrics import BEYOND, SMOOTHED, WITHIN, difference_map, measure
from drapery.comparison.tolerance import Tolerance
from drapery.errors import OptionError

Picture = NDArray[np.uint8]


def noise(seed: int, height: int = 20, width: int = 30, colours: int = 256) -> Picture:
    random = np.random.default_rng(seed)
    palette = random.integers(0, 256, (colours, 4), np.uint8)
    palette[::3, 3] = 255
    palette[1::7, 3] = 0
    return palette[random.integers(0, colours, (height, width))]


@given(st.integers(0, 1000), st.integers(0, 40))
def test_all_figures_are_those_of_the_whole_pictures(seed: int, channel: int) -> None:
    """The picture is compared in parts, and only where some bit differs."""
    a = noise(seed, 9, 7)
    b = np.where(np.random.default_rng(seed).random(a.shape) < 0.1, noise(seed + 1, 9, 7), a)
    found = measure(a, b, Tolerance(channel, pixels=2))
    visible = [picture * (picture[..., 3:] > 0) for picture in (a, b)]
    errors = np.abs(visible[0].astype(int) - visible[1])
    worst = errors.max(axis=-1)
    assert found.changed == np.count_nonzero(worst)
    assert found.beyond == np.count_nonzero(worst > channel)
    assert found.max_error == worst.max() and found.mean_error == pytest.approx(errors.mean())
    assert found.hidden == np.count_nonzero((worst == 0) & (a != b).any(axis=-1))
    assert found.agrees == (found.beyond <= 2)
    rows, columns = np.nonzero(worst > channel if found.beyond else worst)
    if len(rows):
        left, top = columns.min(), rows.min()
        assert found.box == (left, top, columns.max() + 1 - left, rows.max() + 1 - top)
    else:
        assert found.box is None


def test_a_picture_of_many_blocks_has_the_figures_of_one() -> None:
    a, b = noise(1, 300, 400), noise(2, 300, 400)
    found = measure(a, b)
    whole = difference_map(a, b)
    assert found.beyond == np.count_nonzero(whole == BEYOND)
    assert found.box == (0, 0, 400, 300)


def test_the_verdict_follows_the_number_of_pixels_or_their_share() -> None:
    a = np.full((10, 10, 4), 255, np.uint8)
    b = a.copy()
    b[0, :5, 0] = 200
    verdicts = {
        "different": [Tolerance(), Tolerance(pixels=4), Tolerance(ratio=0.049), Tolerance(54)],
        "within": [Tolerance(pixels=5), Tolerance(ratio=0.05), Tolerance(55), Tolerance(colour=1)],
    }
    for verdict, tolerances in verdicts.items():
        for tolerance in tolerances:
            assert measure(a, b, tolerance).verdict == verdict, tolerance
    assert measure(a, a).verdict == "same" and measure(a, a).exact


def test_sixteen_bits_count_where_both_pictures_have_them() -> None:
    eight = noise(3)
    sixteen = eight.astype(np.uint16) * 257
    assert measure(eight, sixteen).exact and measure(sixteen, eight).exact
    other = sixteen.copy()
    other[..., 3] = 65535
    sixteen[..., 3] = 65535
    other[0, 0, 1] ^= 1
    found = measure(sixteen, other)
    assert (found.changed, found.box) == (1, (0, 0, 1, 1))
    assert 0 < found.max_error < 0.01
    assert measure(sixteen, other, Tolerance(channel=1)).verdict == "within"
    assert measure(sixteen, (other >> 8).astype(np.uint8)).same


def test_perceived_differences_are_weighted_as_the_eye_does() -> None:
    black, white = (np.array([[v, v, v, 255]], np.uint8) for v in (0, 255))
    place = np.array([0])
    assert perceived_difference(black, black, place)[0] == 0
    assert perceived_difference(black, white, place)[0] == pytest.approx(0.966, abs=0.001)
    blue, green = (np.array([[0, *rest, 255]], np.uint8) for rest in ((0, 40), (40, 0)))
    # The eye sees a change of green better than the same change of blue.
    assert perceived_difference(black, blue, place) < perceived_difference(black, green, place)


def smoothed_one_by_one(a: Picture, b: Picture, y: int, x: int) -> bool:
    """The rule for one pixel in plain loops."""
    height, width = a.shape[:2]

    def around(y: int, x: int) -> list[tuple[int, int]]:
        steps = itertools.product((-1, 0, 1), (-1, 0, 1))
        places = [(y + dy, x + dx) for dx, dy in steps if (dx, dy) != (0, 0)]
        return [(r, c) for r, c in places if 0 <= r < height and 0 <= c < width]

    def change(picture: Picture, at: tuple[int, int], other: tuple[int, int]) -> float:
        colours = [picture[place].astype(float) for place in (at, other)]
        step = colours[0][:3] - colours[1][:3]
        alphas = [colour[3] for colour in colours]
        if min(alphas) < 255:
            k = (at[0] * width + at[1]) * 4
            behind = np.array(
                [48 + 159 * (int(k / n) % 2) for n in (1, 1.618033988749895, 2.618033988749895)]
            )
            over = colours[0][:3] * alphas[0] - colours[1][:3] * alphas[1]
            step = (over - behind * (alphas[0] - alphas[1])) / 255
        return step[0] * 0.29889531 + step[1] * 0.58662247 + step[2] * 0.11448223

    def in_one_colour(picture: Picture, at: tuple[int, int]) -> bool:
        near = around(*at)
        same = sum(bool((picture[at] == picture[place]).all()) for place in near)
        return same + (len(near) < 8) > 2

    def in_one(picture: Picture) -> bool:
        near = around(y, x)
        changes = [change(picture, (y, x), place) for place in near]
        if sum(step == 0 for step in changes) + (len(near) < 8) > 2:
            return False
        if min(changes, default=0) >= 0 or max(changes) <= 0:
            return False
        ends = near[int(np.argmin(changes))], near[int(np.argmax(changes))]
        return any(in_one_colour(a, end) and in_one_colour(b, end) for end in ends)

    return in_one(a) or in_one(b)


@given(st.integers(0, 10_000))
def test_smoothed_edges_are_found_pixel_by_pixel(seed: int) -> None:
    random = np.random.default_rng(seed)
    height, width = random.integers(1, 9, 2)
    a, b = (noise(seed % 97, height, width, colours=4).copy() for _ in range(2))
    b[random.integers(height), random.integers(width)] = random.integers(0, 256, 4)
    b[random.integers(height), random.integers(width)] = a[0, 0]
    places = np.arange(height * width)
    found = is_smoothed(a, b, places).reshape(height, width)
    for y, x in np.ndindex(height, width):
        assert found[y, x] == smoothed_one_by_one(a, b, y, x), (y, x)


def test_an_edge_that_moves_by_less_than_a_pixel_is_smoothed() -> None:
    """A slanted edge between two areas, as a renderer with samples draws it."""
    y, x = np.mgrid[0:40, 0:40].astype(float)
    pictures = []
    for shift in (0.0, 0.4):
        share = np.clip(x - 0.3 * y - 10 - shift, 0, 1)[..., None]
        pixels = np.full((40, 40, 4), 255, np.uint8)
        pixels[..., :3] = np.rint(share * (230, 220, 40) + (1 - share) * (20, 30, 90))
        pictures.append(pixels)
    exact = measure(*pictures)
    loose = measure(*pictures, Tolerance(antialiasing=False))
    assert exact.beyond > 20 and loose.beyond == 0 and loose.smoothed == exact.beyond
    assert set(np.unique(difference_map(*pictures, Tolerance(antialiasing=False)))) == {0, SMOOTHED}
    other = pictures[1].copy()
    other[5:8, 30:33, :3] = 0
    assert measure(pictures[0], other, Tolerance(antialiasing=False)).beyond == 9


def test_ignored_boxes_and_painted_masks_leave_pixels_out() -> None:
    a, b = noise(1), noise(1)
    b[2:4, 5:9] = 255 - b[2:4, 5:9]
    b[10, 10] = 255 - b[10, 10]
    size = a.shape[:2]
    boxes = ((5, 2, 4, 2), (10, 10, 100, 1))
    inside = ignored_pixels(size, boxes)
    found = measure(a, b, ignored=inside)
    assert found.same and not found.exact and found.ignored == 8 + 20
    assert measure(a, b, ignored=ignored_pixels(size, boxes[:1])).box == (10, 10, 1, 1)
    mask = np.zeros((*size, 4), np.uint8)
    mask[2:4, 5:9] = (255, 0, 0, 255)
    mask[0, 0] = (255, 255, 255, 0)
    mask[0, 1] = (0, 0, 0, 255)
    assert np.count_nonzero(painted(mask)) == 8
    assert measure(a, b, ignored=ignored_pixels(size, boxes[1:], painted(mask))).same
    with pytest.raises(OptionError, match="the mask is 30x20 and the picture 9x9"):
        ignored_pixels((9, 9), (), painted(mask))
    with pytest.raises(OptionError, match="lies outside the picture of 30x20"):
        ignored_pixels(size, ((30, 0, 1, 1),))


def test_limits_out_of_range_are_refused() -> None:
    for wrong in (
        {"channel": 256},
        {"pixels": -1},
        {"ratio": 1.1},
        {"colour": float("nan")},
        {"flip": -0.1},
        {"ignore": ((0, 0, 0, 1),)},
        {"ignore": ((-1, 0, 2, 1),)},
    ):
        with pytest.raises(OptionError):
            Tolerance(**wrong)
    assert Tolerance(5, ratio=0.1).limits() == {"tolerance": 5, "ratio": 0.1}


def test_a_map_tells_what_is_within_and_what_is_beyond() -> None:
    a = np.full((3, 3, 4), 200, np.uint8)
    b = a.copy()
    b[0, 0, 0], b[2, 2, 0] = 205, 220
    found = difference_map(a, b, Tolerance(channel=5))
    assert (found[0, 0], found[2, 2], found.sum()) == (WITHIN, BEYOND, WITHIN + BEYOND)
