"""Any pack keeps to the stated limits of memory and time, whatever the sizes of its sheets."""

import tracemalloc
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from pack_maker import BANNER, CREEPER, OLD_BASE, folder_pack, mcmeta, noise, plain, png
from PIL import Image

from drapery.banner.design import Banner, Layer
from drapery.banner.packs import open_packs
from drapery.banner.packs.masks import looks_like_mask
from drapery.banner.packs.resampling import MAX_COMPOSITE, common_side, resize
from drapery.banner.packs.stack import Kind
from drapery.banner.packs.texture_cache import MAX_CACHED_TEXELS
from drapery.banner.packs.textures import from_mask
from drapery.banner.patterns import PATTERN_NAMES
from drapery.banner.sprites import FRONT, composite, face, flag_layers

MEBIBYTE = 1 << 20
LARGEST = plain(9, 9, 9, 99, side=2048)
CREEPER_BANNER = Banner("white", (Layer("creeper", "lime"),))


@pytest.fixture(autouse=True)
def traced() -> Iterator[None]:
    tracemalloc.start()
    yield
    tracemalloc.stop()


def peak(act: Callable[[], object]) -> float:
    """The most memory that arrays take while something runs [MiB]."""
    tracemalloc.reset_peak()
    before = tracemalloc.get_traced_memory()[0]
    act()
    return (tracemalloc.get_traced_memory()[1] - before) / MEBIBYTE


def mask(side: int) -> bytes:
    """A mask as packs before 1.15 had: opaque, black and white."""
    texels = np.full((side, side, 4), 255, np.uint8)
    texels[: side // 2, :, :3] = 0
    return png(texels)


def packed(path: Path, creeper: bytes, base: bytes, pack_format: int = 46) -> Path:
    files = {"pack.mcmeta": mcmeta(pack_format), CREEPER: creeper, OLD_BASE: base}
    return folder_pack(path, files)


@pytest.mark.parametrize(("side", "base"), [(1023, 64), (127, 128), (2047, 64), (2047, 2048)])
def test_a_mask_over_a_base_of_an_unrelated_size(tmp_path: Path, side: int, base: int) -> None:
    pack = packed(tmp_path, mask(side), plain(9, 9, 9, 255, side=base), pack_format=4)
    packs = open_packs([pack])
    assert peak(lambda: packs.sheet("creeper")) < 200
    assert len(packs.sheet("creeper")) <= MAX_COMPOSITE


def test_a_sheet_of_a_large_prime_side_has_a_small_face(tmp_path: Path) -> None:
    packs = open_packs([packed(tmp_path, plain(1, 1, 1, 255, side=2047), plain(9, 9, 9, 255))])
    assert peak(lambda: face(CREEPER_BANNER, packs)) < 200
    assert face(CREEPER_BANNER, packs).shape == (40 * 32, 20 * 32, 4)


def test_an_animated_mask_is_combined_with_the_base_one_frame_at_a_time(tmp_path: Path) -> None:
    strip = np.concatenate([np.full((23, 23, 4), 255, np.uint8)] * 300)
    strip[: 23 * 300 : 46, :, :3] = 0
    pack = packed(tmp_path, png(strip), plain(9, 9, 9, 255), pack_format=4)
    folder_pack(pack, {CREEPER + ".mcmeta": '{"animation": {}}'})
    packs = open_packs([pack])
    assert peak(lambda: packs.sheet("creeper")) < 100
    first, second = packs.sheet("creeper", time=0.0), packs.sheet("creeper", time=0.05)
    assert len(first) == 23 * 64 and (first != second).any()


@pytest.mark.slow
def test_sixteen_layers_of_the_largest_size(tmp_path: Path) -> None:
    names = PATTERN_NAMES[1:17]
    sheets = dict.fromkeys((BANNER + f"{name}.png" for name in names), LARGEST)
    packs = open_packs([folder_pack(tmp_path, sheets)])
    banner = Banner("white", tuple(Layer(name, "lime") for name in names))
    assert peak(lambda: composite(flag_layers(banner, packs))) < 500


@pytest.mark.slow
def test_decoded_textures_are_dropped_when_there_are_too_many(tmp_path: Path) -> None:
    names = PATTERN_NAMES
    sheets = dict.fromkeys((BANNER + f"{name}.png" for name in names), LARGEST)
    packs = open_packs([folder_pack(tmp_path, sheets)])
    limit = 4 * MAX_CACHED_TEXELS / MEBIBYTE
    assert len(names) * 16 > 2 * limit
    assert peak(lambda: [packs.sheet(name).max() for name in names]) < limit + 150
    assert packs.sheet(names[-1]) is packs.sheet(names[-1])


@pytest.mark.parametrize("sides", [(64, 2047), (509, 512), (2048, 2047, 2039), (1, 2048), (8, 8)])
def test_the_common_side_is_bounded(sides: tuple[int, ...]) -> None:
    side = common_side(sides)
    assert max(sides) <= side <= MAX_COMPOSITE and side % max(sides) == 0


def test_beyond_the_bound_texels_are_the_nearest_ones_at_texel_centres() -> None:
    sheet = noise(3, 2047)
    size = 2048
    crop = FRONT.crop(sheet)
    for row, column in [(0, 0), (7, 13), (40 * 32 - 1, 20 * 32 - 1), (600, 300)]:
        y, x = ((32 + number + 0.5) / size for number in (row, column))
        assert (crop[row, column] == sheet[int(y * 2047), int(x * 2047)]).all()
    small, base = np.full((509, 509, 4), 255, np.uint8), noise(1, 512)
    small[:100, :, 0] = 7
    made = from_mask(small, base)
    assert (made[..., :3] == resize(base, len(made))[..., :3]).all()
    assert (made[..., 3] == resize(small, len(made))[..., 0]).all()


def test_stacks_of_our_own_art_share_textures_and_each_tells_what_is_missing() -> None:
    first, second = open_packs(()), open_packs(())
    assert first.sheet("creeper") is second.sheet("creeper")
    for stack in (first, second):
        stack.sheet("mymod:heart")
        assert "mymod:heart" in " ".join(stack.warnings())
    assert open_packs(()).warnings() == ()


def test_a_pack_that_changes_is_read_anew_by_the_next_stack(tmp_path: Path) -> None:
    path = tmp_path / "assets/minecraft/textures/entity/banner/creeper.png"
    path.parent.mkdir(parents=True)
    for level in (0, 255):
        Image.new("RGBA", (64, 64), (level,) * 4).save(path)
        assert (open_packs([tmp_path]).sheet("creeper") == level).all()


def test_no_sheet_of_our_own_art_is_a_mask() -> None:
    packs = open_packs(())
    kinds: tuple[Kind, ...] = ("banner", "shield")
    sheets = [packs.sheet(name, kind) for name in PATTERN_NAMES for kind in kinds]
    assert not any(map(looks_like_mask, sheets))
