"""`drapery model` writes the cloth of a design as a 3-D file."""

import json
import struct
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import trimesh
from conftest import GIVE, Run

from drapery.commands import options
from drapery.settings import LOOP_OPTIONS


def tree_of(path: Path) -> dict[str, Any]:
    data = path.read_bytes()
    (size,) = struct.unpack_from("<I", data, 12)
    found: dict[str, Any] = json.loads(data[20 : 20 + size])
    return found


def test_a_banner_waves_in_a_glb(drapery: Run, tmp_path: Path) -> None:
    target = tmp_path / "a.glb"
    words = ("--seconds", "0.5", "--fps", "10")
    assert drapery("model", GIVE, "-o", target, *words)[0] == 0
    tree = tree_of(target)
    moving = [mesh for mesh in tree["meshes"] if "weights" in mesh]
    assert len(moving) == len(tree["meshes"]) - 1, "the wood stands still, the cloth moves"
    assert all(len(mesh["weights"]) == 4 for mesh in moving)
    assert [each["name"] for each in tree["animations"]] == ["wave"]
    assert [mesh["name"] for mesh in tree["meshes"]] == ["banner/pole", "banner/cloth"]
    assert [each["doubleSided"] for each in tree["materials"]] == [False, False]
    low, high = trimesh.load_scene(target).bounds
    # A standing banner: a post and a flag within a block or so, not two blocks high.
    assert low[1] == pytest.approx(0, abs=0.01) and 1.5 < high[1] < 2


def test_the_origin_is_in_the_middle_of_the_block_by_choice(drapery: Run, tmp_path: Path) -> None:
    words = ("model", "red", "--seconds", 0, "-o", tmp_path / "a.glb")
    assert drapery(*words)[0] == 0
    corner = trimesh.load_scene(tmp_path / "a.glb").geometry["banner/pole"].bounds
    assert drapery(*words, "--origin", "centre")[0] == 0
    centre = trimesh.load_scene(tmp_path / "a.glb").geometry["banner/pole"].bounds
    assert corner - centre == pytest.approx(corner * 0 + [0.5, 0, 0.5], abs=1e-6)
    assert centre.mean(axis=0)[[0, 2]] == pytest.approx([0, 0], abs=1e-6)


def test_one_pose_of_a_banner(drapery: Run, tmp_path: Path) -> None:
    for ending in (".glb", ".obj", ".ply", ".bbmodel", ".geo.json"):
        target = tmp_path / f"a{ending}"
        assert drapery("model", "red cross:white", "-o", target, "--seconds", "0")[0] == 0
        assert target.stat().st_size > 1000
    assert "animations" not in tree_of(tmp_path / "a.glb")


def test_an_option_that_is_for_animations_alone_does_not_keep_one_pose_from_being_written(
    drapery: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    alone = replace(LOOP_OPTIONS["fps"], name="of_animations", not_for=("still", "model", "page"))
    monkeypatch.setattr(options, "LOOP_OPTIONS", {**LOOP_OPTIONS, alone.name: alone})
    code, _, err = drapery("model", "red", "-o", tmp_path / "a.ply", "--seconds", "0")
    assert code == 0, err


def test_an_unknown_ending_is_refused(drapery: Run, tmp_path: Path) -> None:
    code, _, err = drapery("model", "red", "-o", tmp_path / "a.fbx")
    assert code == 2 and ".glb, .obj" in err
    assert list(tmp_path.iterdir()) == []
