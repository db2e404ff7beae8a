"""Sheets of all sizes, animations, masks of old packs, material maps, shields."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pack_maker import (
    BANNER,
    CREEPER,
    META,
    NEW_BASE,
    OLD_BASE,
    SHIELD,
    folder_pack,
    mcmeta,
    noise,
    plain,
    png,
    red,
    strip,
)

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.packs import open_packs
from drapery.banner.sprites import composite, face, flag_layers, shield_layers
from drapery.errors import PackError


def test_sizes_from_8_to_512_mix_in_one_design(tmp_path: Path) -> None:
    sides = {"base": 8, "creeper": 16, "skull": 32, "flower": 128, "globe": 256, "cross": 512}
    files = {f"{BANNER}{name}.png": png(noise(n, n)) for name, n in sides.items()}
    packs = open_packs([folder_pack(tmp_path, files)])
    banner = Banner("white", tuple(Layer(name, "red") for name in list(sides)[1:]))
    assert composite(flag_layers(banner, packs)).shape == (512, 512, 4)
    assert face(banner, packs).shape == (320, 160, 4)


def test_sheets_that_are_too_large_are_refused(tmp_path: Path) -> None:
    wrong = png(np.zeros((16, 2049, 4), np.uint8))
    packs = open_packs([folder_pack(tmp_path, {CREEPER: wrong, NEW_BASE: wrong})])
    for ask in (lambda: packs.sheet("creeper"), packs.base_sheet):
        with pytest.raises(PackError, match="is 2049 x 16 px; a sheet has at most 2048"):
            ask()


@pytest.mark.parametrize(
    ("animation", "seen", "period"),
    [
        ({}, [1, 2, 3, 1], 3),
        ({"frametime": 2}, [1, 1, 2, 2, 3, 3, 1], 6),
        ({"frames": [2, 0]}, [3, 1, 3, 1], 2),
        ({"frames": [0, {"index": 2, "time": 3}], "frametime": 1}, [1, 3, 3, 3, 1], 4),
        ({"width": 8, "height": 8, "interpolate": True}, [1, 2, 3], 3),
    ],
)
def test_animations_show_the_frame_of_the_time(
    tmp_path: Path, animation: dict[str, Any], seen: list[int], period: int
) -> None:
    meta = json.dumps({"animation": animation})
    files = {CREEPER: strip(1, 2, 3), CREEPER + ".mcmeta": meta}
    packs = open_packs([folder_pack(tmp_path, files)])
    assert [red(packs, time=tick / 20) for tick in range(len(seen))] == seen
    assert packs.period("creeper") == pytest.approx(period / 20)
    assert packs.period("skull") == 0
    assert packs.sheet("creeper").shape == (8, 8, 4)


def test_frames_may_lie_side_by_side(tmp_path: Path) -> None:
    quarters = np.arange(4, dtype=np.uint8).reshape(2, 2).repeat(8, 0).repeat(8, 1)
    texels = np.stack([quarters, quarters, quarters, np.full_like(quarters, 255)], -1)
    meta = '{"animation": {"width": 8, "height": 8}}'
    packs = open_packs([folder_pack(tmp_path, {CREEPER: png(texels), CREEPER + ".mcmeta": meta})])
    assert [red(packs, time=tick / 20) for tick in range(4)] == [0, 1, 2, 3]


@pytest.mark.parametrize(
    "meta",
    [
        '{"animation": 3}',
        '{"animation": {"frames": [3]}}',
        '{"animation": {"frametime": 0}}',
        '{"animation": {"frametime": 1, "frames": [{"index": 1, "time": -2}]}}',
        '{"animation": {"height": 7}}',
        '{"animation": {"frames": [true]}}',
        "{",
    ],
)
def test_broken_animations_are_named_and_drawn_as_stills(tmp_path: Path, meta: str) -> None:
    files = {CREEPER: strip(1, 2, 3), CREEPER + ".mcmeta": meta}
    packs = open_packs([folder_pack(tmp_path, files)])
    assert red(packs, time=1.0) == 1 and packs.sheet("creeper").shape == (8, 8, 4)
    assert packs.period("creeper") == 0
    (note,) = packs.notes()
    assert "creeper.png.mcmeta" in note and note.endswith("it is drawn as a still")


def test_a_picture_that_is_no_strip_is_a_still_as_a_whole(tmp_path: Path) -> None:
    texels = np.full((12, 8, 4), (9, 9, 9, 255), np.uint8)
    files = {CREEPER: png(texels), CREEPER + ".mcmeta": '{"animation": {"frametime": 0}}'}
    assert open_packs([folder_pack(tmp_path, files)]).sheet("creeper").shape == (24, 24, 4)


def test_masks_of_old_packs_show_the_base_in_the_dye(tmp_path: Path) -> None:
    mask = np.zeros((64, 64, 4), np.uint8)
    mask[..., 3] = 255
    mask[1:21, :, :3] = 255
    mask[21:41, :, :3] = 100
    base = noise(1)
    base[..., 3] = 255
    files = {META: mcmeta(4), CREEPER: png(mask), OLD_BASE: png(base)}
    path = folder_pack(tmp_path, files)
    sheet = open_packs([path]).sheet("creeper")
    assert (sheet[..., :3] == base[..., :3]).all()
    assert (sheet[..., 3] == mask[..., 0]).all()
    assert (open_packs([path], format=46).sheet("creeper") == mask).all()


def test_a_mask_and_a_base_of_other_sizes_meet(tmp_path: Path) -> None:
    files = {
        META: mcmeta(3),
        CREEPER: plain(255, 255, 255, 255, side=16),
        OLD_BASE: png(noise(1, 24)),
    }
    sheet = open_packs([folder_pack(tmp_path, files)]).sheet("creeper")
    assert (sheet[..., :3] == noise(1, 24).repeat(2, 0).repeat(2, 1)[..., :3]).all()


def test_our_art_is_never_a_mask() -> None:
    assert (open_packs(format=4).sheet("creeper") == open_packs().sheet("creeper")).all()


def test_maps_come_from_the_pack_of_the_sheet_or_above(tmp_path: Path) -> None:
    a = folder_pack(
        tmp_path / "a",
        {
            CREEPER: plain(1, 0, 0, 255),
            BANNER + "creeper_n.png": plain(128, 128, 255, 10),
            BANNER + "creeper_s.png": plain(200, 4, 0, 255, side=16),
            OLD_BASE: plain(1, 1, 1, 255),
            OLD_BASE.replace(".png", "_n.png"): plain(3, 3, 3, 3),
        },
    )
    b = folder_pack(tmp_path / "b", {CREEPER: plain(2, 0, 0, 255)})
    c = folder_pack(tmp_path / "c", {BANNER + "creeper_n.png": plain(9, 9, 9, 9)})
    packs = open_packs([a])
    normal, specular, base = (
        packs.normal_map("creeper"),
        packs.specular_map("creeper"),
        packs.base_normal_map(),
    )
    assert normal is not None and normal[0, 0].tolist() == [128, 128, 255, 10]
    assert specular is not None and specular.shape == (16, 16, 4)
    assert base is not None and base[0, 0].tolist() == [3, 3, 3, 3]
    assert packs.base_specular_map() is None and packs.normal_map("skull") is None
    assert open_packs([a, b]).normal_map("creeper") is None
    above = open_packs([a, b, c]).normal_map("creeper")
    assert above is not None and above[0, 0].tolist() == [9, 9, 9, 9]


def test_shields_have_sheets_of_their_own(tmp_path: Path) -> None:
    shield = "assets/minecraft/textures/entity/"
    files = {
        SHIELD + "base.png": plain(255, 255, 255, 0),
        SHIELD + "creeper.png": plain(255, 0, 0, 255),
        shield + "shield_base.png": plain(40, 50, 60, 255),
        shield + "shield_base_nopattern.png": plain(70, 80, 90, 255),
    }
    packs = open_packs([folder_pack(tmp_path, files)])
    bare = composite(shield_layers(Banner("red"), packs))
    assert (bare == (40, 50, 60, 255)).all()
    charged = composite(shield_layers(Banner("red", (Layer("creeper", "lime"),)), packs))
    assert (charged == (DYES["lime"].rgb[0], 0, 0, 255)).all(), charged[0, 0]
    assert (composite(shield_layers(None, packs)) == (70, 80, 90, 255)).all()


def test_stacks_share_the_texels_of_our_own_art_which_nobody_can_change() -> None:
    one, other = open_packs(()), open_packs(())
    for sheets in (
        (one.base_sheet(), other.base_sheet()),
        (one.sheet("creeper"), other.sheet("creeper")),
    ):
        assert np.shares_memory(*sheets)
        assert not any(sheet.flags.writeable for sheet in sheets)
