"""`python -m drapery.banner.check_game`: what a version of the game has that is not known."""

import json
import zipfile
from pathlib import Path
from typing import Any

import pytest

from drapery.banner.check_game import main
from drapery.banner.dyes import DYES
from drapery.banner.packs.equipment import LAYERS
from drapery.banner.packs.versions import NEWEST_DATA_FORMAT, PACK_FORMATS
from drapery.banner.patterns import PATTERNS

NEWEST = PACK_FORMATS[-1]
VERSION = {
    "id": NEWEST.game,
    "pack_version": {
        "resource_major": NEWEST.number,
        "resource_minor": NEWEST.minor,
        "data_major": NEWEST_DATA_FORMAT,
        "data_minor": 0,
    },
}
TEXTURES = "assets/minecraft/textures"
FILES: dict[str, Any] = {
    "version.json": VERSION,
    "assets/minecraft/equipment/iron.json": {"layers": {"humanoid": []}},
    "assets/minecraft/blockstates/red_banner.json": {},
    "net/minecraft/client/Main.class": {},
    **{f"data/minecraft/banner_pattern/{name}.json": {} for name in PATTERNS},
    **{f"{TEXTURES}/block/{dye}_wool.png": {} for dye in DYES},
    **{f"{TEXTURES}/item/{dye}_dye.png": {} for dye in DYES},
    **{f"{TEXTURES}/entity/equipment/{layer}/a.png": {} for layer in LAYERS},
}


def jar(folder: Path, files: dict[str, Any]) -> str:
    path = folder / "client.jar"
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content if isinstance(content, str) else json.dumps(content))
    return str(path)


def data(folder: Path, more: dict[str, Any]) -> str:
    blocks = [{"name": "red_banner", "states": [{"name": "rotation"}]}, {"name": "stone"}]
    files = {
        "dataPaths.json": {"pc": {"1.8": {}, "26.3": {"blocks": "pc/26.3", "items": "pc/26.3"}}},
        "pc/26.3/blocks.json": blocks,
        "pc/26.3/items.json": [{"name": f"{dye}_dye"} for dye in DYES],
    }
    for name, content in (files | more).items():
        path = folder / "data" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content if isinstance(content, str) else json.dumps(content), "utf-8")
    return str(folder)


def test_a_known_version_has_nothing_new(tmp_path: Path, capsys: Any) -> None:
    assert main([jar(tmp_path, FILES), data(tmp_path, {})]) == 0
    assert capsys.readouterr().out == "all is known\n"


@pytest.mark.parametrize(
    ("more", "line"),
    [
        ({"data/minecraft/banner_pattern/cow.json": {}}, "unknown pattern: 'cow'"),
        ({f"{TEXTURES}/block/teal_wool.png": {}}, "unknown dye: 'teal'"),
        ({f"{TEXTURES}/item/teal_dye.png": {}}, "unknown dye: 'teal'"),
        (
            {f"{TEXTURES}/entity/equipment/cow_body/a.png": {}},
            "unknown equipment layer: 'cow_body'",
        ),
        (
            {"assets/minecraft/equipment/a.json": {"layers": {"cow_body": []}}},
            "unknown equipment layer: 'cow_body'",
        ),
        ({"assets/minecraft/blockstates/teal_banner.json": {}}, "unknown block: 'teal_banner'"),
        ({"version.json": VERSION | {"id": "99.1"}}, "unknown version: '99.1'"),
        (
            {"version.json": VERSION | {"pack_version": {"resource": 999, "data": 1}}},
            "unknown format of resource packs: 999.0",
        ),
        (
            {"version.json": VERSION | {"pack_version": {"resource": 97, "data": 999}}},
            "unknown format of data packs: 999",
        ),
    ],
)
def test_what_a_jar_has_new_is_named(
    tmp_path: Path, capsys: Any, more: dict[str, Any], line: str
) -> None:
    assert main([jar(tmp_path, FILES | more)]) == 1
    assert capsys.readouterr().out == f"{line}\n"


@pytest.mark.parametrize(
    ("more", "line"),
    [
        (
            {"pc/26.3/blocks.json": [{"name": "red_banner", "states": [{"name": "tilt"}]}]},
            "unknown state of red_banner: 'tilt'",
        ),
        ({"pc/26.3/blocks.json": [{"name": "teal_banner"}]}, "unknown block: 'teal_banner'"),
        ({"pc/26.3/items.json": [{"name": "teal_dye"}]}, "unknown dye: 'teal'"),
        (
            {"dataPaths.json": {"pc": {"99.1": {"blocks": "pc/26.3", "items": "pc/26.3"}}}},
            "unknown version: '99.1'",
        ),
    ],
)
def test_what_the_data_has_new_is_named(
    tmp_path: Path, capsys: Any, more: dict[str, Any], line: str
) -> None:
    assert main([data(tmp_path, more)]) == 1
    assert capsys.readouterr().out == f"{line}\n"


def test_bad_input_ends_in_one_line(tmp_path: Path, capsys: Any) -> None:
    (tmp_path / "no.jar").write_bytes(b"PK\3\4 broken")
    (tmp_path / "empty").mkdir()
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    bad = [
        [],
        ["a", "b", "c"],
        [str(tmp_path / "missing.jar")],
        [str(tmp_path / "no.jar")],
        [str(tmp_path / "empty")],
        [jar(tmp_path, {"version.json": VERSION})],
        [data(tmp_path / "a", {"pc/26.3/blocks.json": "{}"})],
        [data(tmp_path / "b", {"dataPaths.json": "[" * 100_000})],
    ]
    for arguments in bad:
        assert main(arguments) == 2, arguments
        captured = capsys.readouterr()
        assert captured.err.count("\n") == 1 and not captured.out


def test_a_json_file_has_a_largest_size(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("drapery.banner.check_game.MAX_JSON", 1000)
    assert main([data(tmp_path, {"pc/26.3/items.json": " " * 1001})]) == 2
    assert "items.json" in capsys.readouterr().err
