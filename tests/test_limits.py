"""The bounds in limits.md: the table is true, and what goes over a bound is refused."""

import ast
import importlib
import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from drapery import Banner, DraperyError, Layer, read_designs
from drapery.banner.formats import registry
from drapery.batch.manifest import ManifestError, read_manifest
from drapery.cloth import builders
from drapery.errors import DesignError, OptionError, PackError
from drapery.packs import open_packs
from drapery.render import Material, TextureLayer, atlas
from drapery.render.materials import make_material_tables
from drapery.settings import Settings

ROOT = Path(__file__).parents[1]
UNITS = {"KiB": 2**10, "MiB": 2**20, "GiB": 2**30, "Mi": 2**20, "Gi": 2**30}
ROW = re.compile(r"\| ([^|]+) \| ([\d,.]+)(?: (\w+))? \| `([\w.]+)\.([A-Z_]+)` \|")
TESTS = dict(
    line.split() for line in Path(__file__).with_name("limits.txt").read_text("utf-8").splitlines()
)
"""The test that fails where a bound is gone, by the bound's name."""


def rows() -> list[tuple[str, ...]]:
    lines = (ROOT / "docs" / "reference" / "limits.md").read_text(encoding="utf-8").splitlines()
    table = [line for line in lines if line.startswith("|")]
    found = [match.groups("") for line in table if (match := ROW.fullmatch(line))]
    heads = sum(line.startswith(("| bound |", "|---")) for line in table)
    assert len(found) == len(table) - heads, "each line of the tables can be read"
    return found


def test_each_bound_has_a_test() -> None:
    assert list(TESTS) == [f"{row[3]}.{row[4]}" for row in rows()]


@pytest.mark.parametrize("row", rows(), ids=lambda row: f"{row[3]}.{row[4]}")
def test_the_table_of_limits_is_true(row: tuple[str, ...]) -> None:
    _, number, unit, module, name = row
    file, _, test = TESTS[f"{module}.{name}"].partition("::")
    if module.startswith("studio"):
        pytest.importorskip("nicegui")
    if module.startswith("serve"):
        pytest.importorskip("fastapi")
    stated = float(number.replace(",", "")) * (UNITS[unit] if unit else 1)
    assert getattr(importlib.import_module(f"drapery.{module}"), name) == stated
    (path,) = (ROOT / "tests").rglob(file)
    tree = ast.parse(path.read_text(encoding="utf-8"))
    assert test in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


def sparse(path: Path, size: int) -> Path:
    """A file of this size that takes no disk."""
    with path.open("wb") as file:
        file.truncate(size)
    return path


def value_of(module: str, name: str) -> Any:
    return getattr(importlib.import_module(f"drapery.{module}"), name)


def test_a_banner_has_a_largest_number_of_layers() -> None:
    layer = Layer("creeper", "lime")
    assert len(Banner("white", (layer,) * 16).layers) == 16
    with pytest.raises(DesignError, match="16"):
        Banner("white", (layer,) * 17)


def test_a_text_has_a_largest_length() -> None:
    with pytest.raises(DesignError, match="1048577 characters"):
        registry.parse_banners("x" * (2**20 + 1))


def test_an_address_has_a_largest_length() -> None:
    address = "https://www.planetminecraft.com/banner/?b="
    with pytest.raises(DesignError) as caught:
        Banner.parse(address + "f" * 4096)
    assert len(str(caught.value)) < 1000


def test_a_world_has_a_largest_number_of_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("drapery.banner.formats.files.MAX_FILES", 2)
    (tmp_path / "level.dat").write_bytes(b"")
    for number in range(3):
        (tmp_path / f"{number}.mca").write_bytes(b"")
    with pytest.raises(DesignError, match="over 2 files"):
        read_designs(tmp_path)


def test_a_data_pack_has_a_largest_size(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("drapery.banner.formats.datapack.MAX_UNPACKED", 1 << 20)
    (tmp_path / "data").mkdir()
    (tmp_path / "pack.mcmeta").write_text("{}")
    for number in range(3):
        (tmp_path / "data" / f"{number}.json").write_text(" " * (1 << 19))
    with pytest.raises(DesignError, match="over 1 MiB unpacked"):
        read_designs(tmp_path)


def test_a_json_file_of_a_pack_has_a_largest_size(tmp_path: Path) -> None:
    (tmp_path / "assets").mkdir()
    (tmp_path / "pack.mcmeta").write_text(" " * 2**20 + "{}", encoding="utf-8")
    with pytest.raises(PackError, match=r"pack\.mcmeta"):
        open_packs([tmp_path])


def test_a_sheet_has_a_largest_side(tmp_path: Path) -> None:
    (tmp_path / "pack.mcmeta").write_text('{"pack": {"pack_format": 15, "description": ""}}')
    path = tmp_path / "assets/minecraft/textures/entity/banner/creeper.png"
    path.parent.mkdir(parents=True)
    Image.new("L", (2049, 2049)).save(path)
    with pytest.raises(PackError, match="2048"):
        open_packs([tmp_path]).sheet("creeper")


@pytest.mark.parametrize(
    ("name", "largest", "beyond"),
    [
        ("size", (8192, 8192), (8193, 10)),
        ("grid", (129, 129), (130, 9)),
        ("wind", 40.0, math.nextafter(40.0, 50.0)),
        ("pixel", 64, 65),
        ("block_light", 15, 16),
        ("format", 9999, 10000),
    ],
)
def test_options_are_refused_just_beyond_their_bounds(name: str, largest: Any, beyond: Any) -> None:
    size = {} if name != "pixel" else {"size": (64, 64)}
    Settings(**{**size, name: largest})
    with pytest.raises(OptionError, match=name):
        Settings(**{**size, name: beyond})


def test_a_loop_has_a_largest_number_of_frames() -> None:
    from drapery import animate

    with pytest.raises(OptionError, match="seconds"):
        animate(Banner("white"), size=(8, 8), seconds=3601 / 20, fps=20)


def test_a_wind_script_has_a_largest_size(tmp_path: Path) -> None:
    from drapery.stage.wind_script import read_script

    path = tmp_path / "script"
    path.write_text("\n" * (2**16 + 1), encoding="utf-8")
    with pytest.raises(OptionError, match="over 65536 bytes"):
        read_script(str(path))


def test_a_cloth_has_a_largest_number_of_particles() -> None:
    with pytest.raises(OptionError, match="at most 1000000"):
        builders.grid(1001, 1000, 1.0, 1.0)


def test_a_scene_has_a_largest_size() -> None:
    from drapery.render import Camera, Scene
    from drapery.render.soft import draw_scene

    with pytest.raises(OptionError, match="1 to 16384 pixels"):
        draw_scene(Scene((), Camera((0, 0, 5), (0, 0, 0)), (16385, 1)))


def test_a_texture_has_a_largest_side() -> None:
    with pytest.raises(OptionError, match="16384"):
        make_material_tables([Material((TextureLayer(np.zeros((1, 16385, 4), np.uint8)),))])


def test_an_atlas_has_a_largest_size(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(atlas, "MAX_SHEET", 1000)
    with pytest.raises(OptionError, match="at most 1000 texels"):
        atlas.make_atlas([np.zeros((40, 40, 4), np.uint8)])


def test_a_compared_picture_has_a_largest_side(tmp_path: Path) -> None:
    from drapery.comparison.picture import read_picture

    path = tmp_path / "long.png"
    Image.new("L", (16385, 1)).save(path)
    with pytest.raises(OptionError, match="16384"):
        read_picture(path)


@pytest.mark.parametrize("ending, name", [("csv", "TEXT"), ("jsonl", "TEXT"), ("yaml", "YAML")])
def test_a_manifest_has_a_largest_size(tmp_path: Path, ending: str, name: str) -> None:
    limit = value_of("batch.rows", f"MAX_{name}")
    path = sparse(tmp_path / f"jobs.{ending}", limit + 1)
    with pytest.raises(OptionError, match=f"has over {limit} bytes"):
        read_manifest(path)


def test_a_text_in_a_manifest_has_a_largest_length(tmp_path: Path) -> None:
    path = tmp_path / "jobs.csv"
    path.write_text(f"design\n{'x' * (2**20 + 1)}\n", encoding="utf-8")
    with pytest.raises(DraperyError, match="at most 1048576 characters in a cell"):
        read_manifest(path)
    with pytest.raises(ManifestError) as caught:
        read_manifest([{"design": "x" * (2**20 + 1)}])
    assert "over 1048576 characters" in caught.value.faults[0].message


def test_a_manifest_has_a_largest_number_of_jobs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("drapery.batch.manifest.MAX_JOBS", 2)
    jobs = [{"design": "white", "name": str(number)} for number in range(3)]
    assert len(read_manifest(jobs[:2])) == 2
    with pytest.raises(OptionError, match="over 2 jobs"):
        read_manifest(jobs)


def test_a_pack_that_is_sent_has_a_largest_size(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from drapery.batch import artifacts
    from drapery.batch.keys import DigestCache

    monkeypatch.setattr(artifacts, "MAX_BYTES", 1 << 20)
    with pytest.raises(PackError, match="over 1 MiB"):
        artifacts.bundle(sparse(tmp_path / "pack.zip", (1 << 20) + 1), DigestCache())


@pytest.mark.parametrize("ending", ["toml", "yaml"])
def test_a_file_of_cases_has_a_largest_size(tmp_path: Path, ending: str) -> None:
    from drapery.testing.cases import read_cases

    with pytest.raises(OptionError, match=r"has over 4194304 bytes"):
        read_cases(sparse(tmp_path / f"cases.{ending}", 1 << 40))


def test_an_import_of_designs_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("nicegui")
    from drapery.studio import records

    monkeypatch.setattr(records, "MAX_DESIGNS", 2)
    whole = {"drapery_library": records.VERSION, "designs": [{}] * 3}
    with pytest.raises(DesignError, match="over 2 designs"):
        records.read_designs(json.dumps(whole).encode())
