"""Banners in photos: set upright, in unknown light."""

from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from PIL import Image

from drapery import Banner
from drapery.errors import OptionError
from drapery.match import match_photo
from drapery.match.light import seen_face
from drapery.match.perspective import PhotoView, bend_count, find_corners, texel_shifts
from drapery.match.photo import WAYS, aligned
from drapery.match.smooth import grid_fit, least_squares, products
from drapery.pictures import draw_face

DESIGN = Banner.parse("white creeper:red border:black")
CORNERS = ((52.0, 21.0), (118.0, 30.0), (112.0, 171.0), (47.0, 160.0))


def photo(banner: Banner, gain: tuple[float, float, float] = (0.8, 0.75, 0.7)) -> np.ndarray:
    """A face in perspective before green, in light of this gain, uint8 [200, 160, 3]."""
    face = draw_face(banner, scale=8).pixels[..., :3] * np.array(gain)
    view = PhotoView(np.zeros((200, 160, 3), np.uint8), CORNERS)
    back = np.linalg.inv(view.to_photo)
    y, x = np.mgrid[:200, :160] + 0.5
    u, v, w = (row[0] * x + row[1] * y + row[2] for row in back)
    inside = (u > 0) & (u < w) & (v > 0) & (v < w)
    rows = (v / w * len(face)).astype(int).clip(0, len(face) - 1)
    columns = (u / w * face.shape[1]).astype(int).clip(0, face.shape[1] - 1)
    picture = np.where(inside[..., None], face[rows, columns], (90, 200, 90))
    noise = np.random.default_rng(1).normal(0, 2, picture.shape)
    return np.clip(picture + noise, 0, 255).astype(np.uint8)


def shifts_of(bend: np.ndarray) -> np.ndarray:
    """How far a bend moves texels across and down, [2, 40, 20]."""
    return (bend[:, None, None] * texel_shifts()).sum(axis=0).reshape(2, 40, 20)


def test_texels_are_read_through_the_corners() -> None:
    seen = PhotoView(photo(DESIGN, (1, 1, 1)), CORNERS).face()
    face = draw_face(DESIGN, scale=1).pixels[..., :3].reshape(-1, 3)
    assert np.median(np.abs(seen - face)) < 4


def test_corners_are_found_before_one_colour() -> None:
    found = find_corners(photo(DESIGN))
    assert np.abs(np.array(found) - CORNERS).max() < 3


@pytest.mark.slow
def test_a_design_is_found_in_unknown_light_that_changes() -> None:
    wanted = Banner.parse("white stripe_top:black triangle_top:orange circle:purple")
    y, x = np.mgrid[:200, :160]
    light = 0.85 + 0.1 * np.cos(x / 25) - 0.05 * np.sin(y / 40)
    picture = photo(wanted, (1, 0.95, 0.9)) * light[..., None]
    best = match_photo(picture.astype(np.uint8), CORNERS, layers=3)[0]
    np.testing.assert_array_equal(
        draw_face(best.banner, scale=1).pixels, draw_face(wanted, scale=1).pixels
    )


def test_polynomials_on_a_grid_are_fitted_as_any_others() -> None:
    random = np.random.default_rng(2)
    goal, weights = random.normal(size=(40, 20)), random.random((40, 20))
    v, u = np.divmod(np.arange(800), 20)
    terms, stiffness = products((u + 0.5) / 20, (v + 0.5) / 40, 4, 3), np.linspace(0.5, 2, 20)
    np.testing.assert_allclose(
        grid_fit(goal, weights, stiffness, 4, 3),
        least_squares(terms, goal.ravel(), weights.ravel(), stiffness),
        atol=1e-12,
    )


def test_light_is_estimated_from_a_design() -> None:
    face = draw_face(DESIGN, scale=1).pixels[..., :3].reshape(-1, 3).astype(float)
    v, u = np.divmod(np.arange(800), 20)
    light = (0.75 + 0.08 * np.cos(u / 4) + 0.04 * np.sin(v / 15))[:, None] * (1.05, 1, 0.95)
    seen = seen_face(face * light)
    assert np.abs(seen.light_on(face) - light).max() < 0.03
    assert seen.error(face, seen.light_on(face)) < 0.05 * seen.error(face[::-1], light)


def bulging(texels: float = 1) -> PhotoView:
    """A flag of one colour whose right edge is up to so far further right than its corners."""
    picture = np.full((200, 160, 3), 90, np.uint8)
    y = np.arange(20, 180)
    for row, out in zip(y, 4 * texels * np.sin((y - 20) / 160 * np.pi), strict=True):
        picture[row, 40 : round(120 + out)] = 220
    return PhotoView(picture, ((40, 20), (120, 20), (120, 180), (40, 180)))


def test_the_outline_says_how_cloth_bends() -> None:
    view = bulging()
    bend = view.outline_bend()
    across, down = shifts_of(bend)
    assert abs(across[20, 19] - 1) < 0.3 and abs(across[20, 0]) < 0.3
    assert np.abs(across[2, [0, 19]]).max() < 0.5 and np.abs(down).max() < 0.3
    assert view.bend_cost(bend) < view.bend_cost(np.zeros(bend_count())) / 2


def test_the_part_of_a_flag_that_is_not_read_is_measured() -> None:
    view, flat = bulging(3), np.zeros(bend_count())
    # The integral of 3 sin x - 1 where that is positive, times 40 texels for pi.
    assert abs(view.left_out(flat) - 40.8) < 4
    assert view.left_out(view.outline_bend()) < 3
    assert bulging().left_out(flat) < 1


def test_a_face_that_says_nothing_is_aligned_with_the_outline() -> None:
    view = bulging()
    flat = np.zeros(bend_count())
    across, _ = shifts_of(aligned(view, flat, view.face(flat)))
    assert abs(across[20, 19] - 1) < 0.3 and abs(across[20, 0]) < 0.3


def test_the_middle_may_be_lower_than_the_outline_says() -> None:
    view = bulging()
    across, down = shifts_of(view.outline_bend(2.5))
    assert np.abs(down[19:21, 9:11] - 2.5).max() < 0.3
    assert np.abs(down[[0, 39]]).max() < 1 and abs(across[20, 19] - 1) < 0.6


def test_a_photo_is_aligned_with_a_design() -> None:
    face = draw_face(Banner.parse("white flower:red triangle_top:blue"), scale=8).pixels[..., :3]
    moved = np.roll(face, (16, 12), axis=(0, 1))
    view = PhotoView(moved, ((0, 0), (160, 0), (160, 320), (0, 320)))
    wanted = face.reshape(40, 8, 20, 8, 3).mean(axis=(1, 3)).reshape(-1, 3)
    bend = aligned(view, np.zeros(bend_count()), wanted)
    across, down = shifts_of(bend)[:, 5:-5, 4:-4]
    # Within a quarter of a texel nothing changes: the outermost samples do not count.
    assert np.abs(across - 12 / 8).max() < 0.5 and np.abs(down - 16 / 8).max() < 0.5


@pytest.mark.parametrize(("steps", "stiffness"), WAYS)
def test_bricks_are_aligned_though_they_repeat(
    steps: tuple[tuple[int, int], ...], stiffness: float
) -> None:
    face = draw_face(Banner.parse("yellow bricks:gray"), scale=8).pixels[..., :3]
    rows = np.arange(320) / 320
    # The lower edge is 4 texels too high: as far as the bricks are apart.
    moved = face[np.rint((rows + 0.1 * rows**2) * 320).astype(int).clip(0, 319)]
    view = PhotoView(moved, ((0, 0), (160, 0), (160, 320), (0, 320)))
    wanted = face.reshape(40, 8, 20, 8, 3).mean(axis=(1, 3)).reshape(-1, 3)
    seen = view.face(aligned(view, np.zeros(bend_count()), wanted, steps, stiffness))
    assert np.abs(seen - wanted).reshape(40, -1)[:34].mean() < 1


@pytest.mark.slow
def test_the_same_photo_gives_the_same_designs() -> None:
    picture = photo(Banner.parse("red cross:white"))
    found = [match_photo(picture, layers=1) for _ in range(2)]
    assert found[0] == found[1] and found[0][0].banner == Banner.parse("red cross:white")


@pytest.mark.parametrize(
    ("corners", "line"),
    [
        (((0, 0), (50, 0), (50, 90)), "four corners"),
        (((0, 0), (0, 90), (50, 90), (50, 0)), "do not span a flag"),
        (((0, 0), (3, 0), (3, 90), (0, 90)), "at least 8 pixels apart"),
    ],
)
def test_bad_corners_are_refused(corners: tuple[tuple[float, float], ...], line: str) -> None:
    with pytest.raises(OptionError, match=line):
        match_photo(photo(DESIGN), corners)


def test_pictures_without_a_flag_are_refused() -> None:
    with pytest.raises(OptionError, match="no flag was found"):
        match_photo(np.full((90, 90, 3), 80, np.uint8))
    with pytest.raises(OptionError, match="no flag was found"):
        match_photo(np.full((180, 90, 3), 80, np.uint8))
    with pytest.raises(OptionError, match="the photo is float64"):
        match_photo(np.zeros((90, 90, 3)))


def test_the_command_takes_corners(drapery: Run, tmp_path: Path) -> None:
    path = tmp_path / "photo.png"
    Image.fromarray(photo(Banner.parse("red cross:white"))).save(path)
    corners = [f"{x},{y}" for x, y in CORNERS]
    code, out, _ = drapery("match", path, "--corners", *corners, "--layers", 1)
    assert code == 0 and out.splitlines()[0].endswith("red cross:white")
    code, _, err = drapery("match", path, "--corners", "1,2", "3", "4,5", "6,7")
    assert code == 2 and "'3' is not two numbers" in err
    code, _, err = drapery("match", path, "--photo", "--crop", "0,0,9,9")
    assert code == 2 and "--crop does not apply to a photo" in err
