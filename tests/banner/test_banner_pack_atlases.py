"""Patterns find their textures through definitions and atlases."""

import json
from pathlib import Path
from typing import Any

import pytest
from pack_maker import (
    BANNER,
    CREEPER,
    META,
    folder_pack,
    mcmeta,
    plain,
    red,
    zip_pack,
)

from drapery.banner.packs import open_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import PackError

ATLAS = "assets/minecraft/atlases/banner_patterns.json"


def sprites(*sources: dict[str, Any]) -> str:
    return json.dumps({"sources": sources})


def test_a_data_pack_names_the_texture_of_its_patterns(tmp_path: Path) -> None:
    data = zip_pack(
        tmp_path / "data.zip",
        {
            META: mcmeta(48),
            "data/guild/banner_pattern/owl.json": '{"asset_id": "guild:birds/owl"}',
            "data/minecraft/banner_pattern/creeper.json": '{"asset_id": "skull"}',
        },
    )
    art = folder_pack(
        tmp_path / "art",
        {
            "assets/guild/textures/entity/banner/birds/owl.png": plain(9, 0, 0, 255),
            BANNER + "skull.png": plain(5, 0, 0, 255),
        },
    )
    packs = open_packs([data, art])
    assert red(packs, "guild:owl") == red(packs, "guild:birds/owl") == 9
    assert red(packs, "creeper") == 5
    assert set(packs.patterns()) - set(PATTERN_NAMES) == {"guild:owl", "guild:birds/owl"}
    assert packs.warnings() == ()


@pytest.mark.parametrize(
    "definition",
    ["{}", "[]", '{"asset_id": 3}', '{"asset_id": "../../etc/passwd"}', '{"asset_id": "A b"}'],
)
def test_broken_definitions_are_named(tmp_path: Path, definition: str) -> None:
    path = folder_pack(tmp_path, {"data/g/banner_pattern/owl.json": definition})
    with pytest.raises(PackError, match=r"data/g/banner_pattern/owl\.json"):
        open_packs([path]).sheet("g:owl")


def test_maps_and_the_base_are_not_patterns(tmp_path: Path) -> None:
    names = ("creeper", "creeper_n", "creeper_s", "banner_base", "banner_base_n", "own", "own_s")
    files = {f"{BANNER}{name}.png": plain(1, 0, 0, 255) for name in names}
    packs = open_packs([folder_pack(tmp_path, files)])
    assert set(packs.patterns()) - set(PATTERN_NAMES) == {"minecraft:own"}


def test_an_atlas_leads_sprites_to_other_folders(tmp_path: Path) -> None:
    files = {
        ATLAS: sprites(
            {"type": "single", "resource": "a:odd/place", "sprite": "a:entity/banner/odd"},
            {"type": "minecraft:directory", "source": "flags", "prefix": "entity/banner/"},
        ),
        "assets/a/textures/odd/place.png": plain(1, 0, 0, 255),
        "assets/a/textures/flags/far.png": plain(2, 0, 0, 255),
        "assets/minecraft/textures/flags/skull.png": plain(3, 0, 0, 255),
        BANNER + "skull.png": plain(4, 0, 0, 255),
        CREEPER: plain(5, 0, 0, 255),
    }
    packs = open_packs([folder_pack(tmp_path, files)])
    found = [red(packs, name) for name in ("a:odd", "a:far", "skull", "creeper")]
    assert found == [1, 2, 3, 5], "the later source wins, and what is not there is passed over"


def test_a_filter_takes_away_what_came_before_it(tmp_path: Path) -> None:
    files = {
        ATLAS: sprites(
            {"type": "filter", "pattern": {"path": "banner/(creeper|skull)$"}},
            {"type": "single", "resource": "entity/banner/skull"},
        ),
        CREEPER: plain(1, 0, 0, 255),
        BANNER + "skull.png": plain(2, 0, 0, 255),
    }
    packs = open_packs([folder_pack(tmp_path, files)])
    assert packs.level("creeper") is None
    assert red(packs, "skull") == 2


def test_unknown_sources_are_reported_once(tmp_path: Path) -> None:
    source = {"type": "paletted_permutations", "textures": []}
    path = folder_pack(tmp_path, {ATLAS: sprites(source, source), CREEPER: plain(1, 0, 0, 255)})
    packs = open_packs([path])
    packs.sheet("creeper"), packs.sheet("creeper")
    (line,) = packs.warnings()
    assert "paletted_permutations" in line and "banner_patterns.json" in line


@pytest.mark.parametrize(
    "atlas",
    [
        "{}",
        '{"sources": [3]}',
        sprites({"type": "single"}),
        sprites({"type": "directory", "source": "a"}),
    ],
)
def test_broken_atlases_are_named(tmp_path: Path, atlas: str) -> None:
    path = folder_pack(tmp_path, {ATLAS: atlas})
    with pytest.raises(PackError, match=r"atlases/banner_patterns\.json"):
        open_packs([path]).sheet("creeper")


@pytest.mark.parametrize(
    "name", ["../x", "a:../../x", "a:b:c", "Überall", "a: b", "x" * 200, "", "a:"]
)
def test_names_that_are_not_ids_are_refused(name: str) -> None:
    with pytest.raises(PackError, match="is not an id"):
        open_packs().sheet(name)
