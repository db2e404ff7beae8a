"""Colours of dyed sprites are exact, and stacks of mixed sizes sample as each sheet would."""

from fractions import Fraction
from math import lcm
from pathlib import Path

import numpy as np
import pytest
from pack_maker import BANNER, NEW_BASE, OLD_BASE, folder_pack, noise, plain, png

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.packs import Packs, open_packs
from drapery.banner.packs.resampling import resize
from drapery.banner.patterns import PATTERN_NAMES
from drapery.banner.sprites import (
    FLAG_REGIONS,
    SHIELD_REGIONS,
    WHITE,
    composite,
    face,
    flag_layers,
    lay_over,
    tint,
)

pytestmark = pytest.mark.quick


def rounded(value: Fraction) -> int:
    assert value % 1 != Fraction(1, 2), "no tie can occur"
    return int(value + Fraction(1, 2))


def tinted(texel: list[int], rgb: tuple[int, int, int]) -> list[int]:
    return [rounded(Fraction(t * d, 255)) for t, d in zip(texel, rgb, strict=False)] + [texel[3]]


def over(below: list[int], above: list[int]) -> list[int]:
    a = above[3]
    mixed = [
        rounded(Fraction(a * s + (255 - a) * d, 255))
        for s, d in zip(above[:3], below[:3], strict=True)
    ]
    return [*mixed, 255]


@pytest.fixture(scope="module")
def random_packs(tmp_path_factory: pytest.TempPathFactory) -> Packs:
    """A pack of noise for every pattern: all texels, all alphas."""
    names = ["banner_base", *PATTERN_NAMES]
    files = {f"{BANNER}{name}.png": png(noise(n, 16)) for n, name in enumerate(names)}
    return open_packs([folder_pack(tmp_path_factory.mktemp("noise"), files)])


def test_every_tint_is_rounded_as_exact_fractions_are() -> None:
    values = np.arange(256, dtype=np.uint8)
    grid = np.broadcast_to(values[:, None, None], (256, 1, 4))
    for dye in range(256):
        got = tint(grid, (dye, 255, 0))
        assert got[:, 0, 0].tolist() == [rounded(Fraction(t * dye, 255)) for t in range(256)]
        assert (got[:, 0, 1] == values).all() and (got[:, 0, 2] == 0).all()
        assert (got[:, 0, 3] == values).all()


def test_every_blend_is_rounded_as_exact_fractions_are() -> None:
    # 2x + 255 over 510, floored, is round(x / 255): the same sum in whole numbers.
    source, below = np.meshgrid(np.arange(256), np.arange(256), indexing="ij")
    for alpha in range(256):
        above = np.stack([source] * 3 + [np.full_like(source, alpha)], -1).astype(np.uint8)
        under = np.stack([below] * 3 + [np.full_like(below, 255)], -1).astype(np.uint8)
        wanted = (2 * (alpha * source + (255 - alpha) * below) + 255) // 510
        got = lay_over(under, above)
        assert (got[..., :3] == wanted[..., None]).all()
        assert (got[..., 3] == 255).all()


@pytest.mark.parametrize("pattern", PATTERN_NAMES)
def test_all_dyes_of_a_pattern_are_exact(random_packs: Packs, pattern: str) -> None:
    base, sheet = (random_packs.base_sheet(), random_packs.sheet(pattern))
    cloth = random_packs.sheet("base")
    rows, columns = np.random.default_rng(3).integers(0, 16, (2, 24))
    for dye in DYES.values():
        banner = Banner("red", (Layer(pattern, dye.name),))
        got = composite(flag_layers(banner, random_packs))
        for r, c in zip(rows, columns, strict=True):
            texel = over(base[r, c].tolist(), tinted(cloth[r, c].tolist(), DYES["red"].rgb))
            wanted = over(texel, tinted(sheet[r, c].tolist(), dye.rgb))
            assert got[r, c].tolist() == wanted


@pytest.mark.parametrize("seed", range(6))
def test_random_stacks_are_exact(random_packs: Packs, seed: int) -> None:
    rng = np.random.default_rng(seed)
    names, dyes = list(PATTERN_NAMES), list(DYES)
    layers = tuple(Layer(str(rng.choice(names)), str(rng.choice(dyes))) for _ in range(16))
    stack = flag_layers(Banner(str(rng.choice(dyes)), layers), random_packs)
    got = composite(stack)
    assert len(stack) == 18
    for r, c in rng.integers(0, 16, (40, 2)):
        texel = [*stack[0][0][r, c].tolist()[:3], 255]
        for sheet, rgb in stack[1:]:
            texel = over(texel, tinted(sheet[r, c].tolist(), rgb))
        assert got[r, c].tolist() == texel


def test_layers_come_in_the_games_order(random_packs: Packs) -> None:
    banner = Banner("blue", (Layer("creeper", "lime"), Layer("border", "black")))
    layers = flag_layers(banner, random_packs)
    sheets = [random_packs.base_sheet(), *map(random_packs.sheet, ("base", "creeper", "border"))]
    assert [rgb for _, rgb in layers] == [WHITE, *(DYES[d].rgb for d in ("blue", "lime", "black"))]
    assert all(got is wanted for (got, _), wanted in zip(layers, sheets, strict=True))


@pytest.mark.parametrize("sides", [(64, 32), (64, 128, 32), (48, 64), (64, 96, 8), (1, 64)])
def test_mixed_sizes_sample_as_each_sheet_at_its_own_size(sides: tuple[int, ...]) -> None:
    layers = [(noise(side, side), (200, 99, 31 + side)) for side in sides]
    whole = composite(layers)
    assert len(whole) == lcm(*sides)
    u, v = np.random.default_rng(5).random((2, 4000))

    def sample(sheet: np.ndarray) -> np.ndarray:
        side = len(sheet)
        return sheet[(v * side).astype(int), (u * side).astype(int)]

    wanted = sample(tint(*layers[0]))
    wanted[:, 3] = 255
    for sheet, rgb in layers[1:]:
        wanted = lay_over(wanted, tint(sample(sheet), rgb))
    assert (sample(whole) == wanted).all()


def test_sizes_without_a_small_common_multiple_are_capped() -> None:
    whole = composite([(noise(1, 509), WHITE), (noise(2, 512), WHITE)])
    assert whole.shape == (2048, 2048, 4)


def test_resizing_by_whole_numbers_repeats_texels() -> None:
    small = noise(4, 8)
    assert (resize(small, 24) == small.repeat(3, 0).repeat(3, 1)).all()
    assert (resize(resize(small, 24), 8) == small).all()


@pytest.mark.parametrize(
    ("name", "rows", "columns"),
    [
        ("front", (1, 41), (1, 21)),
        ("back", (1, 41), (22, 42)),
        ("left", (1, 41), (0, 1)),
        ("right", (1, 41), (21, 22)),
        ("top", (0, 1), (1, 21)),
        ("bottom", (0, 1), (21, 41)),
    ],
)
def test_regions_of_the_flag(name: str, rows: tuple[int, int], columns: tuple[int, int]) -> None:
    region = FLAG_REGIONS[name]
    for factor in (1, 2, 8):
        sheet = noise(factor, 64 * factor)
        wanted = sheet[
            rows[0] * factor : rows[1] * factor, columns[0] * factor : columns[1] * factor
        ]
        assert (region.crop(sheet) == wanted).all()
    assert region.uv() == (columns[0] / 64, rows[0] / 64, columns[1] / 64, rows[1] / 64)


@pytest.mark.parametrize("regions", [FLAG_REGIONS, SHIELD_REGIONS])
def test_regions_unfold_a_box_without_overlap(regions: dict[str, object]) -> None:
    painted = np.zeros((64, 64), int)
    for region in regions.values():
        painted[region.top : region.bottom, region.left : region.right] += 1
    assert painted.max() == 1
    front = regions["front"]
    width, height = front.right - front.left, front.bottom - front.top
    assert painted.sum() == 2 * (width * height + width + height)


@pytest.mark.parametrize("side", [8, 32, 48, 96])
def test_small_sheets_are_cropped_at_the_nearest_texel(side: int) -> None:
    sheet = noise(side, side)
    crop = FLAG_REGIONS["front"].crop(sheet)
    unit = lcm(side, 64) // 64
    assert crop.shape == (40 * unit, 20 * unit, 4)
    for row, column in [(0, 0), (7, 13), (40 * unit - 1, 20 * unit - 1)]:
        y, x = (1 + (row + 0.5) / unit) / 64, (1 + (column + 0.5) / unit) / 64
        assert (crop[row, column] == sheet[int(y * side), int(x * side)]).all()


def test_a_face_is_opaque_and_its_back_is_the_back_region(tmp_path: Path) -> None:
    two = np.zeros((64, 64, 4), np.uint8)
    two[1:41, 1:21] = (255, 0, 0, 255)
    two[1:41, 22:42] = (0, 0, 255, 255)
    files = {
        OLD_BASE: plain(10, 20, 30, 0),
        BANNER + "base.png": plain(0, 0, 0, 0),
        BANNER + "cross.png": png(two),
    }
    packs = open_packs([folder_pack(tmp_path, files)])
    banner = Banner("white", (Layer("cross", "white"),))
    r, _, b = DYES["white"].rgb
    assert (face(banner, packs) == (r, 0, 0, 255)).all()
    assert (face(banner, packs, "back") == (0, 0, b, 255)).all()
    assert (face(Banner("red"), packs) == (10, 20, 30, 255)).all()
    assert face(banner, packs).shape == (40, 20, 4)


def test_the_new_place_of_the_base_wins_in_new_formats(tmp_path: Path) -> None:
    files = {OLD_BASE: plain(1, 1, 1, 255), NEW_BASE: plain(2, 2, 2, 255)}
    path = folder_pack(tmp_path, files)
    assert open_packs([path]).base_sheet()[0, 0, 0] == 2
    assert open_packs([path], format=84).base_sheet()[0, 0, 0] == 2
    assert open_packs([path], format=46).base_sheet()[0, 0, 0] == 1


@pytest.mark.parametrize("side", [64, 96, 128])
def test_a_stack_at_a_given_side_is_that_of_its_layers_resized(side: int) -> None:
    layers = ((noise(1, 64), WHITE), (noise(2, 128), DYES["lime"].rgb), (noise(3, 32), WHITE))
    resized = [(resize(texels, side), rgb) for texels, rgb in layers]
    assert (composite(layers, side) == composite(resized)).all()
    assert composite(layers, side).shape == (side, side, 4)


@pytest.mark.parametrize("side", [16, 64, 100, 256])
def test_a_region_is_sampled_at_the_centres_of_its_pixels(side: int) -> None:
    sheet, region = noise(4, side), FLAG_REGIONS["front"]
    texels = region.crop(sheet)
    picture = region.sample(sheet, 3)
    assert picture.shape == (120, 60, 4)
    for row, column in ((0, 0), (7, 11), (119, 59)):
        down = int((row + 0.5) * texels.shape[0] / 120)
        across = int((column + 0.5) * texels.shape[1] / 60)
        assert (picture[row, column] == texels[down, across]).all()
