"""Packs override our own art as in the game: order, containers, and missing files."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pack_maker import (
    BANNER,
    CREEPER,
    META,
    folder_pack,
    mcmeta,
    noise,
    plain,
    png,
    red,
    zip_pack,
)

from drapery.banner.packs import open_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import PackError

pytestmark = pytest.mark.quick


def test_without_packs_all_is_our_own_art() -> None:
    packs = open_packs()
    for pattern in PATTERN_NAMES:
        sheet = packs.sheet(pattern)
        assert sheet.shape == (64, 64, 4) and sheet.dtype == np.uint8
        assert sheet[..., 3].any(), pattern
    assert packs.base_sheet().shape == (64, 64, 4)
    assert packs.warnings() == ()
    assert packs.patterns() == PATTERN_NAMES


@pytest.mark.parametrize("make", [folder_pack, zip_pack])
@pytest.mark.parametrize("top", ["", "Pack v2 (1)/"])
def test_a_folder_and_a_zip_are_alike_also_in_one_top_folder(
    tmp_path: Path, make: Any, top: str
) -> None:
    files = {top + META: mcmeta(), top + CREEPER: plain(1, 0, 0, 255)}
    packs = open_packs([make(tmp_path / "pack.zip", files)])
    assert red(packs) == 1


def test_a_client_jar_says_its_format_in_version_json(tmp_path: Path) -> None:
    files = {
        "version.json": '{"name": "1.14.4", "pack_version": 4}',
        "net/minecraft/a.class": b"\xca\xfe",
        CREEPER: plain(1, 0, 0, 255),
    }
    (pack,) = open_packs([zip_pack(tmp_path / "1.14.4.jar", files)]).packs[1:]
    assert pack.format == 4 and pack.meta.description == "Minecraft 1.14.4"


def test_backslashes_of_old_tools_are_slashes(tmp_path: Path) -> None:
    path = zip_pack(tmp_path / "a.zip", {CREEPER.replace("/", "\\"): plain(7, 0, 0, 255)})
    assert red(open_packs([path])) == 7


def test_the_later_pack_wins_file_by_file(tmp_path: Path) -> None:
    a = folder_pack(
        tmp_path / "a", {CREEPER: plain(1, 0, 0, 255), BANNER + "skull.png": plain(2, 0, 0, 255)}
    )
    b = zip_pack(tmp_path / "b.zip", {CREEPER: plain(3, 0, 0, 255)})
    packs = open_packs([a, b])
    assert (red(packs), red(packs, "skull")) == (3, 2)
    assert red(open_packs([b, a])) == 1
    assert red(open_packs(str(b))) == 3


def test_files_are_read_once_and_only_when_asked_for(tmp_path: Path) -> None:
    path = folder_pack(tmp_path, {CREEPER: plain(1, 0, 0, 255), BANNER + "skull.png": b"broken"})
    packs = open_packs([path])
    assert packs.sheet("creeper") is packs.sheet("creeper")
    (tmp_path / CREEPER).unlink()
    assert red(packs) == 1
    with pytest.raises(PackError, match=r"skull\.png is not a PNG file"):
        packs.sheet("skull")


def test_any_texture_by_id(tmp_path: Path) -> None:
    stone = png(noise(1, 16))
    path = folder_pack(tmp_path, {"assets/minecraft/textures/block/stone.png": stone})
    packs = open_packs([path])
    assert (packs.texture("minecraft:block/stone") == noise(1, 16)).all()
    assert packs.texture("block/stone") is packs.texture("minecraft:block/stone")


def test_a_missing_sprite_is_the_games_checker_with_a_warning(tmp_path: Path) -> None:
    packs = open_packs()
    sheet = packs.sheet("guild:owl")
    assert sheet[0, 0].tolist() == sheet[15, 15].tolist() == [0, 0, 0, 255]
    assert sheet[0, 15].tolist() == sheet[15, 0].tolist() == [0xF8, 0, 0xF8, 255]
    packs.texture("block/nothing"), packs.sheet("guild:owl")
    (line,) = packs.warnings()
    assert "guild:owl" in line and "minecraft:block/nothing" in line and line.count("owl") == 1


def test_fallbacks_to_our_art_are_reported_in_one_line(tmp_path: Path) -> None:
    packs = open_packs([folder_pack(tmp_path, {CREEPER: plain(1, 0, 0, 255)})])
    for pattern in ("creeper", "flow", "guster", "flow"):
        packs.sheet(pattern)
    (line,) = packs.warnings()
    assert line.endswith("flow, guster")
    assert (packs.sheet("flow") == open_packs().sheet("flow")).all()


def test_a_pack_without_used_textures_is_reported(tmp_path: Path) -> None:
    path = folder_pack(
        tmp_path / "blocks", {"assets/minecraft/textures/block/dirt.png": plain(1, 1, 1, 1)}
    )
    packs = open_packs([path])
    assert packs.warnings() == ()
    packs.sheet("creeper")
    (line,) = packs.warnings()
    assert "blocks" in line
