"""The shield's art: on its own box, painted on the front alone, from the banner's shapes."""

from itertools import combinations

import numpy as np
import pytest

from assets.drawing.canvas import HANDLE, PLATE
from assets.drawing.charges import CHARGES
from assets.drawing.shapes import BANNER_FACE, SHAPES, SHIELD_FACE
from assets.drawing.shield import FIELD, base_sheet, field_face, plain_sheet, shield_sheet
from assets.drawing.shield_charges import SHIELD_CHARGES
from drapery.banner.patterns import PATTERN_NAMES

EXTENTS = {
    "square_top_left": 35,
    "stripe_top": 80,
    "stripe_left": 80,
    "stripe_center": 80,
    "stripe_middle": 40,
    "stripe_downright": 56,
    "small_stripes": 100,
    "cross": 40,
    "straight_cross": 56,
    "triangle_top": 68,
    "triangles_top": 32,
    "diagonal_right": 110,
    "circle": 32,
    "rhombus": 60,
    "half_vertical": 100,
    "border": 56,
    "curly_border": 92,
    "bricks": 97,
    "creeper": 20,
}
"""Texels of the field that a pattern covers, wholly or in part."""


def test_the_field_is_the_plate_within_its_rim():
    assert (FIELD.x, FIELD.y, FIELD.width, FIELD.height) == (2, 2, 10, 20)
    assert set(SHIELD_CHARGES) == set(CHARGES)


@pytest.mark.parametrize("pattern", PATTERN_NAMES)
def test_a_pattern_is_grey_and_on_the_field_only(pattern):
    sheet = shield_sheet(pattern)
    assert sheet.shape == (64, 64, 4)
    assert (sheet[..., :1] == sheet[..., :3]).all()
    assert sheet[FIELD.slices].any()
    sheet[FIELD.slices] = 0
    assert not sheet.any()


def test_no_two_patterns_have_the_same_face():
    faces = {name: field_face(name)[..., 3] for name in PATTERN_NAMES}
    for first, second in combinations(PATTERN_NAMES, 2):
        assert (faces[first] != faces[second]).any(), (first, second)


@pytest.mark.parametrize("pattern", sorted(SHAPES))
def test_a_shape_covers_as_much_of_the_shield_as_of_the_banner(pattern):
    # On the shield the game draws these two with limbs and joints of a single texel.
    tolerance = 0.21 if pattern in ("bricks", "cross") else 0.1
    banner = SHAPES[pattern](BANNER_FACE).mean() / 255
    shield = SHAPES[pattern](SHIELD_FACE).mean() / 255
    assert abs(banner - shield) < tolerance


@pytest.mark.parametrize("kind", [BANNER_FACE, SHIELD_FACE], ids=["banner", "shield"])
@pytest.mark.parametrize(
    "pattern",
    [
        "cross",
        "straight_cross",
        "circle",
        "rhombus",
        "border",
        "curly_border",
        "triangle_bottom",
        "triangles_bottom",
        "stripe_center",
    ],
)
def test_symmetric_shapes_are_symmetric_at_both_sizes(pattern, kind):
    face = SHAPES[pattern](kind)
    np.testing.assert_array_equal(face, face[:, ::-1])
    if not pattern.startswith("triangle"):
        np.testing.assert_array_equal(face, face[::-1])


def test_small_stripes_are_four_on_the_banner_and_five_on_the_shield():
    for kind, stripes in ((BANNER_FACE, 4), (SHIELD_FACE, 5)):
        row = SHAPES["small_stripes"](kind)[0] > 0
        assert np.count_nonzero(np.diff(row, prepend=False) & row) == stripes


@pytest.mark.parametrize("pattern, texels", EXTENTS.items())
def test_shapes_are_as_large_as_in_the_game(pattern, texels):
    assert np.count_nonzero(field_face(pattern)[..., 3]) == texels


@pytest.mark.parametrize("draw", [base_sheet, plain_sheet])
def test_a_base_is_opaque_over_plate_and_handle_and_nowhere_else(draw):
    drawn = np.zeros((64, 64), bool)
    for box in (PLATE, HANDLE):
        for region in (box.sides, box.top, box.bottom):
            drawn[region.slices] = True
    np.testing.assert_array_equal(draw()[..., 3], np.where(drawn, 255, 0))


def test_the_painted_field_is_white_and_the_two_bases_share_the_rest():
    painted, plain = base_sheet(), plain_sheet()
    assert painted[FIELD.slices][..., :3].min() >= 220
    painted[FIELD.slices] = plain[FIELD.slices] = 0
    np.testing.assert_array_equal(painted, plain)
