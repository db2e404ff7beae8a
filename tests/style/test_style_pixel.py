"""Polygons become pixels exactly: every centre inside, none outside, shared edges shared once."""

import numpy as np
from hypothesis import given, strategies as st

from drapery.style.pixel import bounding_box, fill_polygon, outline


def test_the_outline_runs_around_the_grid_once() -> None:
    assert outline(3, 4).tolist() == [0, 1, 2, 3, 7, 11, 10, 9, 8, 4]
    assert outline(2, 2).tolist() == [0, 1, 3, 2]


def test_a_rectangle_fills_its_pixels() -> None:
    mask = fill_polygon(np.array([[1.0, 2], [4, 2], [4, 5], [1, 5]]), 8, 8)
    expected = np.zeros((8, 8), bool)
    expected[2:5, 1:4] = True
    assert np.array_equal(mask, expected)


def test_a_crossed_outline_follows_the_even_odd_rule() -> None:
    """A cape folded over itself has a hole where its outline encloses a pixel twice."""
    star = np.array([[5.0, 0], [8, 10], [0, 4], [10, 4], [2, 10]])
    mask = fill_polygon(star, 10, 10)
    assert mask[3, 5] and mask[3, 4]
    assert not mask[5, 5]


@given(
    st.lists(st.tuples(st.floats(-4, 20), st.floats(-4, 20)), min_size=3, max_size=9),
    st.integers(0, 7),
)
def test_a_centre_is_inside_if_it_crosses_the_outline_an_odd_number_of_times(
    corners: list[tuple[float, float]], shift: int
) -> None:
    polygon = np.array(corners)
    mask = fill_polygon(polygon, 16, 12)
    for row, column in ((shift, 15 - shift), (11 - shift, shift), (shift, shift)):
        x, y, crossings = column + 0.5, row + 0.5, 0
        for pair in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
            (x0, y0), (x1, y1) = sorted(pair, key=lambda corner: corner[1])
            if (y0 <= y) != (y1 <= y):
                crossings += bool((x - x0) * (y1 - y0) >= (y - y0) * (x1 - x0))
        assert mask[row, column] == bool(crossings % 2)


@given(st.floats(1, 15), st.floats(1, 11))
def test_halves_of_a_box_share_no_pixel_and_leave_none_out(x: float, y: float) -> None:
    box = [(0.0, 0.0), (16.0, 0.0), (16.0, 12.0), (0.0, 12.0)]
    fans = [np.array([box[i], box[(i + 1) % 4], (x, y)]) for i in range(4)]
    covered = sum(fill_polygon(fan, 16, 12).astype(int) for fan in fans)
    assert (covered == 1).all()


def test_the_box_is_the_smallest_that_holds_the_polygon() -> None:
    assert bounding_box(np.array([[1.2, 2.0], [3.9, 2.5], [2.0, 7.1]]), 10, 10) == (1, 2, 4, 8)
    assert bounding_box(np.array([[-5.0, -5], [-1, -1], [-3, -1]]), 10, 10) == (0, 0, 0, 0)
