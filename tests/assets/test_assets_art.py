"""Our own art: complete, regenerated to the byte, and true to the layout of the game's sheets."""

import io
from importlib.resources import files
from itertools import combinations

import numpy as np
import pytest
from PIL import Image

from assets.drawing.banner import pattern_face
from assets.drawing.canvas import BAR, FLAG, POLE, TexelRect, TextureBox
from assets.drawing.charges import CHARGES
from assets.drawing.draw_all import all_files, all_sheets, main, write_art
from assets.drawing.shapes import HALF, SHAPES, SOFT
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import OutputError

ART = files("drapery.assets")
FILES = all_files()
SHEETS = all_sheets()
GRADIENTS = {"gradient", "gradient_up"}
EXTENTS = {
    "square_top_left": 140,
    "stripe_top": 280,
    "stripe_left": 280,
    "stripe_center": 240,
    "stripe_middle": 120,
    "stripe_downright": 256,
    "small_stripes": 480,
    "cross": 352,
    "straight_cross": 224,
    "triangle_top": 238,
    "diagonal_right": 420,
    "circle": 96,
    "rhombus": 192,
    "half_vertical": 440,
    "half_horizontal": 420,
    "border": 324,
    "bricks": 510,
    "gradient": 780,
    "creeper": 180,
}
"""Texels of the front that a pattern covers, wholly or in part."""
BOXES = [
    ("creeper", (14, 31), (1, 18)),
    ("skull", (12, 28), (2, 17)),
    ("flower", (11, 28), (1, 18)),
    ("globe", (11, 28), (2, 17)),
    ("mojang", (12, 28), (2, 17)),
    ("piglin", (16, 24), (2, 17)),
    ("flow", (13, 27), (3, 16)),
    ("guster", (12, 28), (3, 16)),
    ("stripe_center", (0, 39), (7, 12)),
    ("stripe_middle", (17, 22), (0, 19)),
    ("circle", (14, 25), (4, 15)),
    ("rhombus", (8, 31), (3, 16)),
]
"""First and last row and column that a pattern covers."""
COMPLEMENTS = [
    ("half_vertical", "half_vertical_right"),
    ("half_horizontal", "half_horizontal_bottom"),
    ("diagonal_left", "diagonal_up_right"),
    ("diagonal_right", "diagonal_up_left"),
]


def committed(name):
    return ART.joinpath(name).read_bytes()


def decoded(content):
    return np.asarray(Image.open(io.BytesIO(content)).convert("RGBA"))


def banner_sheet(pattern):
    return decoded(committed(f"minecraft/textures/entity/banner/{pattern}.png"))


def cut(sheet, region):
    return sheet[region.slices]


@pytest.mark.parametrize("name", FILES)
def test_regenerating_gives_the_committed_bytes(name):
    assert FILES[name] == committed(name), f"{name}: run python -m assets.drawing.draw_all"


@pytest.mark.parametrize("path", SHEETS)
def test_decoded_pixels_are_the_drawn_texels(path):
    np.testing.assert_array_equal(decoded(committed(f"minecraft/textures/{path}")), SHEETS[path])


def test_no_stray_picture_lies_in_the_art():
    with_art = {str(path.relative_to(ART)) for path in ART.rglob("*.png")}
    assert with_art | {"pack.mcmeta"} == set(FILES)


def test_write_art_writes_every_file_and_nothing_else(tmp_path):
    written = write_art(tmp_path)
    assert {str(path.relative_to(tmp_path)) for path in written} == set(FILES)
    assert sorted(written) == sorted(path for path in tmp_path.rglob("*") if path.is_file())


def test_a_folder_that_cannot_be_made_is_reported_in_one_line(tmp_path, capsys):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(OutputError, match="choose a folder"):
        write_art(tmp_path / "file")
    assert main([str(tmp_path / "file")]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_every_pattern_is_either_a_shape_or_a_charge():
    assert sorted([*SHAPES, *CHARGES]) == sorted(PATTERN_NAMES)
    assert len(PATTERN_NAMES) == 43


@pytest.mark.parametrize("pattern", PATTERN_NAMES)
def test_a_pattern_sheet_is_grey_and_drawn_on_the_flag_only(pattern):
    sheet = banner_sheet(pattern)
    assert sheet.shape == (64, 64, 4)
    assert (sheet[..., :1] == sheet[..., :3]).all()
    outside = sheet.copy()
    for region in (FLAG.sides, FLAG.top, FLAG.bottom):
        cut(outside, region)[:] = 0
    assert not outside.any()


@pytest.mark.parametrize("pattern", PATTERN_NAMES)
def test_cloth_stays_bright_enough_for_its_dye(pattern):
    sheet = banner_sheet(pattern)
    shades = sheet[..., 0][sheet[..., 3] > 0]
    assert shades.min() >= 170
    assert np.median(shades) >= 215


@pytest.mark.parametrize("pattern", PATTERN_NAMES)
def test_the_back_shows_the_front_through_the_cloth(pattern):
    sheet = banner_sheet(pattern)
    np.testing.assert_array_equal(cut(sheet, FLAG.back), cut(sheet, FLAG.front)[:, ::-1])


@pytest.mark.parametrize("pattern", PATTERN_NAMES)
def test_the_edges_continue_the_face(pattern):
    sheet = banner_sheet(pattern)
    front = cut(sheet, FLAG.front)
    np.testing.assert_array_equal(cut(sheet, FLAG.left), front[:, :1])
    np.testing.assert_array_equal(cut(sheet, FLAG.right), front[:, -1:])
    np.testing.assert_array_equal(cut(sheet, FLAG.top), front[:1])
    np.testing.assert_array_equal(cut(sheet, FLAG.bottom), front[-1:])


@pytest.mark.parametrize("pattern", sorted(set(PATTERN_NAMES) - GRADIENTS))
def test_edges_are_soft_by_a_few_fixed_steps(pattern):
    alpha = pattern_face(pattern)[..., 3]
    steps = {HALF} if pattern.startswith("half") else {SOFT}
    assert set(np.unique(alpha)) <= {0, 255, *steps} | ({64} if pattern in CHARGES else set())
    assert steps <= set(np.unique(alpha)) or pattern == "base"


@pytest.mark.parametrize("pattern, texels", EXTENTS.items())
def test_shapes_are_as_large_as_in_the_game(pattern, texels):
    assert np.count_nonzero(pattern_face(pattern)[..., 3]) == texels


@pytest.mark.parametrize("pattern, rows, columns", BOXES)
def test_patterns_lie_where_they_lie_in_the_game(pattern, rows, columns):
    alpha = pattern_face(pattern)[..., 3]
    for axis, extent in ((1, rows), (0, columns)):
        seen = np.flatnonzero(alpha.any(axis))
        assert (seen[0], seen[-1]) == extent


def test_plain_cloth_has_no_folds_or_streaks():
    inside = pattern_face("base")[1:-1, 1:-1, 0].astype(int)
    assert np.ptp(inside) <= 8
    assert np.ptp(inside.mean(axis=0)) < 1.5
    assert np.ptp(inside.reshape(19, 2, 18).mean(axis=(1, 2))) < 1.5


def test_gradients_fade_evenly_and_are_each_other_upside_down():
    alpha = pattern_face("gradient")[..., 3].astype(int)
    steps = np.diff(alpha[:, 0])
    assert alpha[0, 0] >= 250 and alpha[-1, 0] <= 5
    assert set(steps) <= {-7, -6}
    assert (alpha == alpha[:, :1]).all()
    np.testing.assert_array_equal(pattern_face("gradient_up")[::-1, :, 3], alpha)


def test_no_two_patterns_have_the_same_face():
    alphas = {pattern: pattern_face(pattern)[..., 3] for pattern in PATTERN_NAMES}
    for first, second in combinations(PATTERN_NAMES, 2):
        assert (alphas[first] != alphas[second]).any(), (first, second)


@pytest.mark.parametrize("first, second", COMPLEMENTS)
def test_complementary_halves_cover_the_face_and_overlap_only_softly(first, second):
    cover = [pattern_face(name)[..., 3] for name in (first, second)]
    assert (cover[0].astype(int) + cover[1] >= 255).all()
    assert not ((cover[0] == 255) & (cover[1] == 255)).any()
    assert cover[0].sum() == cover[1].sum()


def test_shapes_stand_where_their_names_say():
    def middle_of(pattern):
        rows, columns = np.nonzero(pattern_face(pattern)[..., 3])
        return columns.mean() - 9.5, rows.mean() - 19.5

    for name in ("stripe", "triangle", "triangles"):
        assert middle_of(f"{name}_top")[1] < 0 < middle_of(f"{name}_bottom")[1]
    assert middle_of("stripe_left")[0] < 0 < middle_of("stripe_right")[0]
    corners = {
        "square_top_left": (-1, -1),
        "square_top_right": (1, -1),
        "square_bottom_left": (-1, 1),
        "square_bottom_right": (1, 1),
        "diagonal_left": (-1, -1),
        "diagonal_right": (1, -1),
        "diagonal_up_left": (-1, 1),
        "diagonal_up_right": (1, 1),
    }
    for name, signs in corners.items():
        assert tuple(np.sign(middle_of(name))) == signs, name


def test_bends_run_from_the_corners_they_are_named_for():
    down_right = pattern_face("stripe_downright")[..., 3] > 0
    assert down_right[0, 0] and down_right[-1, -1] and not down_right[0, -1]
    down_left = pattern_face("stripe_downleft")[..., 3] > 0
    np.testing.assert_array_equal(down_left, down_right[:, ::-1])


def test_the_straight_cross_has_limbs_in_the_middle():
    seen = pattern_face("straight_cross")[..., 3] > 0
    upright, level = np.zeros((2, 40, 20), bool)
    upright[:, 8:12] = level[18:22] = True
    np.testing.assert_array_equal(seen, upright | level)


def test_the_base_sheet_is_opaque_wood_and_cloth():
    sheet = decoded(committed("minecraft/textures/entity/banner_base.png"))
    drawn = np.zeros((64, 64), bool)
    for box in (FLAG, POLE, BAR):
        for region in (box.sides, box.top, box.bottom):
            cut(drawn, region)[:] = True
    np.testing.assert_array_equal(sheet[..., 3], np.where(drawn, 255, 0))
    flag = cut(sheet, FLAG.front)
    assert (flag[..., :1] == flag[..., :3]).all()
    wood = cut(sheet, POLE.sides)[..., :3].astype(int)
    assert (wood[..., 0] > wood[..., 1]).all() and (wood[..., 1] > wood[..., 2]).all()


def test_boxes_unfold_to_the_published_texels():
    assert FLAG.front == TexelRect(1, 1, 20, 40) and FLAG.back == TexelRect(22, 1, 20, 40)
    assert FLAG.top == TexelRect(1, 0, 20, 1) and FLAG.bottom == TexelRect(21, 0, 20, 1)
    assert FLAG.left == TexelRect(0, 1, 1, 40) and FLAG.right == TexelRect(21, 1, 1, 40)
    assert POLE.sides == TexelRect(44, 2, 8, 42) and POLE.top == TexelRect(46, 0, 2, 2)
    assert BAR.sides == TexelRect(0, 44, 44, 2) and BAR.bottom == TexelRect(22, 42, 20, 2)
    assert TextureBox(26, 0, 2, 6, 6).sides == TexelRect(26, 6, 16, 6)
