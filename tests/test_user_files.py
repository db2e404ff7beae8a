"""What a user names as a file: pipes, devices, folders, odd names and marks end in one line."""

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from drapery import Banner, draw, read_designs
from drapery.batch.keys import digest
from drapery.batch.manifest import ManifestError, read_manifest
from drapery.cloth import from_mesh, load_mesh
from drapery.comparison import read_picture
from drapery.errors import DraperyError
from drapery.garments import Garment, GarmentMesh, check_skin
from drapery.garments.meshes import read_stiff_mesh
from drapery.garments.motions import find_motion
from drapery.match import read_pixels
from drapery.packs import open_packs
from drapery.stage.wind_script import read_script
from drapery.styles import Style
from drapery.styles.palette_files import read_palette
from drapery.testing.cases import read_cases
from drapery.user_files import open_user_file, read_user_file

ROOT = Path(__file__).parents[1]


def stiff_mesh(path: Path) -> Any:
    return read_stiff_mesh(GarmentMesh(file=path), Path(), 1 / 16)


DOORS: dict[str, tuple[str, Callable[[Path], Any]]] = {
    "design": (".txt", read_designs),
    "design of a function": (".mcfunction", read_designs),
    "design of a region": (".mca", read_designs),
    "design of a schematic": (".schem", lambda path: read_designs(path, form="schem")),
    "pack": (".zip", lambda path: open_packs([path])),
    "texture": (".png", lambda path: draw(kind="cape", texture=path)),
    "style": (".toml", Style.load),
    "palette": (".gpl", read_palette),
    "garment": (".toml", Garment.load),
    "mesh of a garment": (".glb", stiff_mesh),
    "collider": (".stl", load_mesh),
    "cloth": (".ply", from_mesh),
    "skin": (".png", lambda path: check_skin(path, 64)),
    "pose": (".json", lambda path: find_motion(str(path), Path())),
    "wind": (".txt", lambda path: read_script(str(path))),
    "cases": (".toml", read_cases),
    "cases in YAML": (".yaml", read_cases),
    "manifest": (".csv", read_manifest),
    "manifest in YAML": (".yaml", read_manifest),
    "picture": (".jpg", read_pixels),
    "compared picture": (".png", read_picture),
    "digest": (".png", digest),
}


def refusal(read: Callable[[Path], Any], path: Path) -> str:
    with pytest.raises((DraperyError, ManifestError)) as caught:
        read(path)
    said = str(caught.value)
    assert "\n" not in said
    return said


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
@pytest.mark.parametrize("door", DOORS)
def test_a_named_pipe_is_refused_and_not_waited_for(door: str, tmp_path: Path) -> None:
    ending, read = DOORS[door]
    path = tmp_path / f"pipe{ending}"
    os.mkfifo(path)
    assert "pipe" in refusal(read, path)


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="this system has no such device")
@pytest.mark.parametrize("door", DOORS)
def test_a_device_is_refused(door: str, tmp_path: Path) -> None:
    ending, read = DOORS[door]
    path = tmp_path / f"zero{ending}"
    path.symlink_to("/dev/zero")
    assert refusal(read, path)


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("name", ["a\0b", "a\ud800b", "x" * 5000, "missing"])
def test_a_name_that_no_file_has_is_refused(name: str, door: str, tmp_path: Path) -> None:
    ending, read = DOORS[door]
    refusal(read, tmp_path / f"{name}{ending}")


@pytest.mark.parametrize("door", sorted({*DOORS} - {"design", "design of a function", "digest"}))
def test_a_folder_is_refused(door: str, tmp_path: Path) -> None:
    ending, read = DOORS[door]
    path = tmp_path / f"folder{ending}"
    path.mkdir()
    assert refusal(read, path)


MARKED: dict[str, tuple[str, str, Callable[[Path], Any]]] = {
    "design": (".txt", "red creeper:black", read_designs),
    "style": (".toml", 'description = "a"', Style.load),
    "palette": (".hex", "ffffff\n000000", read_palette),
    "garment": (".toml", "wearer = {}\npiece = []", Garment.load),
    "pose": (".json", '{"head": [1, 2, 3]}', lambda path: find_motion(str(path), Path())),
    "wind": (".txt", "0 strength 6", lambda path: read_script(str(path))),
    "cases": (".toml", '[[case]]\nname = "a"\ndesign = "red"', read_cases),
    "cases in YAML": (".yml", "case: [{name: a, design: red}]", read_cases),
    "manifest": (".csv", "design,name\nred,a", read_manifest),
    "manifest in lines": (".jsonl", '{"design": "red"}', read_manifest),
    "cloth": (".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", from_mesh),
}


@pytest.mark.parametrize("door", MARKED)
def test_a_byte_order_mark_is_no_part_of_a_text(door: str, tmp_path: Path) -> None:
    ending, text, read = MARKED[door]
    path = tmp_path / f"marked{ending}"
    path.write_text(text, encoding="utf-8-sig")
    assert read(path) is not None


def test_files_that_a_garment_names_may_not_hold_odd_characters(tmp_path: Path) -> None:
    for field in (
        'mesh = [{ file = "a\\u0000.glb" }]',
        'texture = { file = "a\\u0000.png" }',
        'wearer = { skin = "a\\u0000.png" }',
        'wearer = { motion = "a\\u0000.json" }',
    ):
        path = tmp_path / "odd.toml"
        path.write_text(
            f'{field}\n[[piece]]\nname = "a"\nshape = "grid"\nsize = [9, 9]\npoints = [2, 2]\n'
        )
        refusal(lambda path: draw(Garment.load(path), size=(16, 16)), path)


def test_a_file_is_read_up_to_a_limit(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(b"12345")
    assert read_user_file(path, 5) == b"12345"
    with pytest.raises(DraperyError, match=r"a\.txt has over 4 bytes; shorten it"):
        read_user_file(path, 4)


@pytest.mark.skipif(not Path("/dev/fd").exists(), reason="this system has no /dev/fd")
def test_a_pipe_of_the_shell_is_read_as_a_design() -> None:
    end, start = os.pipe()
    os.write(start, b"red creeper:black")
    os.close(start)
    try:
        (found,) = read_designs(Path(f"/dev/fd/{end}"))
    finally:
        os.close(end)
    assert found.banner == Banner.parse("red creeper:black")
    with pytest.raises(OSError, match="pipe or a device"):
        open_user_file("/dev/null")


OPENS = re.compile(
    r"\.open\(\s*\"rb\"|\.read_bytes\(|(?<!queue)\.read_text\(|(?<![\w.])(?<!def )open\("
    r"|Image\.open\(|import tomllib|trimesh\.load"
)
OPENED_ELSEWHERE = {
    # the one place for each kind of file
    *("mesh_file.py", "picture_file.py", "toml_text.py"),
    # files of the package, and compiled kernels
    *("jit/sources.py", "jit/kernel_cache.py", "batch/keys.py", "match/perspective.py"),
    *("banner/blazon/reading.py", "banner/formats/languages.py", "banner/formats/snbt.py"),
    *("banner/letters.py", "banner/packs/folders.py", "testing/failures.py"),
    *("web/bundle.py", "web/designer_page.py", "web/package.py", "web/page.py"),
    *("web/tables.py", "web/wasm/build.py", "web/wasm/compiler.py", "web/wasm/module.py"),
    *("studio/design_catalogue.py", "studio/page.py", "studio/translation.py"),
    # files that the program itself has written
    *("batch/jobs.py", "batch/stores.py", "batch/worker.py", "serve/app.py"),
    *("studio/garment_store.py", "studio/panels/library.py", "studio/viewport.py"),
}
"""Modules that open files otherwise, none of which a user names."""


def test_files_are_opened_in_one_place() -> None:
    package = ROOT / "drapery"
    found = {
        path.relative_to(package).as_posix()
        for path in package.rglob("*.py")
        if OPENS.search(path.read_text(encoding="utf-8"))
    }
    assert found - OPENED_ELSEWHERE == set(), "use drapery.user_files"
