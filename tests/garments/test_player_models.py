"""3-D files of players: a skeleton moves the body, morph targets the cloth."""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from drapery import iter_frames, save_model
from drapery.cloth.colliders import rotation_about
from drapery.garments import dressed_player, make_wearer
from drapery.packs import open_packs
from drapery.render.export import save_scenes
from drapery.render.export.gltf import quaternions
from drapery.scenes import Dressed, loop, moments

TYPES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
KINDS = {5126: np.float32, 5125: np.uint32, 5121: np.uint8}
LOOP = {"seconds": 0.5, "fps": 8.0}


class Glb:
    """A binary glTF, opened."""

    def __init__(self, path: Path) -> None:
        data = path.read_bytes()
        size = struct.unpack_from("<I", data, 12)[0]
        self.json: dict[str, Any] = json.loads(data[20 : 20 + size])
        self.binary = data[28 + size :]

    def values(self, number: int) -> np.ndarray:
        accessor = self.json["accessors"][number]
        if "bufferView" not in accessor:
            return np.zeros((accessor["count"], 1))  # sparse: the weights of targets
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind, width = KINDS[accessor["componentType"]], TYPES[accessor["type"]]
        flat = np.frombuffer(self.binary, kind, accessor["count"] * width, view["byteOffset"])
        return flat.reshape(-1, width)

    def skinned(self, key: int) -> list[np.ndarray]:
        """The vertices of each mesh with bones at a key of the animation."""
        samplers = self.json["animations"][0]["samplers"]
        moved: dict[int, dict[str, np.ndarray]] = {}
        for channel in self.json["animations"][0]["channels"]:
            target = channel["target"]
            output = self.values(samplers[channel["sampler"]]["output"])
            if target["path"] != "weights":
                moved.setdefault(target["node"], {})[target["path"]] = output[key]
        found = []
        for node in self.json["nodes"]:
            if "skin" not in node:
                continue
            skin = self.json["skins"][node["skin"]]
            (primitive,) = self.json["meshes"][node["mesh"]]["primitives"]
            names = ("POSITION", "JOINTS_0", "WEIGHTS_0")
            rest, joints, weights = (self.values(primitive["attributes"][n]) for n in names)
            undone = self.values(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
            assert (weights == [1, 0, 0, 0]).all() and joints.max() < len(skin["joints"])
            points = np.concatenate([rest, np.ones((len(rest), 1))], axis=1)
            placed = np.empty((len(rest), 3))
            for number, joint in enumerate(skin["joints"]):
                bone = np.eye(4)
                bone[:3, :3] = matrix(moved[joint]["rotation"])
                bone[:3, 3] = moved[joint]["translation"]
                own = joints[:, 0] == number
                placed[own] = (points[own] @ (bone @ undone[number]).T)[:, :3]
            found.append(placed)
        return found


def matrix(q: np.ndarray) -> np.ndarray:
    x, y, z, w = map(float, q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def test_a_skeleton_moves_the_body_as_the_frames_do(tmp_path: Path) -> None:
    player = dressed_player(
        make_wearer(motion="run", speed=3.0, shield="red creeper:lime"), wear=("cape",)
    )
    settings = player.settings(rotation=3, ground="none")
    times = (0.0, 0.05, 0.1, 0.15)
    scenes = list(moments(player, open_packs(()), settings, times))
    save_scenes(scenes, tmp_path / "p.glb")
    glb = Glb(tmp_path / "p.glb")
    body = [number for number, m in enumerate(scenes[0].models) if hasattr(m, "rig")]
    assert len(body) == 3  # the skin, and the plate and handle of the shield
    for key in (0, 1, 3, 4):
        drawn = [scenes[key % 4].models[number].mesh.positions for number in body]
        for found, wanted in zip(glb.skinned(key), drawn, strict=True):
            np.testing.assert_allclose(found, wanted, atol=2e-6)
    names = {node["name"] for node in glb.json["nodes"]}
    assert {"skeleton", "head", "body", "right_arm", "left_leg"} <= names
    cloth = [mesh for mesh in glb.json["meshes"] if "weights" in mesh]
    assert len(cloth) == 1 and len(cloth[0]["weights"]) == 3
    assert all("targets" not in m["primitives"][0] for m in glb.json["meshes"] if m not in cloth)


def test_each_node_has_one_parent_and_trimesh_opens_the_file(tmp_path: Path) -> None:
    player = dressed_player(make_wearer(motion="wave"))
    save_model(player, tmp_path / "p.glb", **LOOP)
    glb = Glb(tmp_path / "p.glb")
    children = [child for node in glb.json["nodes"] for child in node.get("children", ())]
    roots = glb.json["scenes"][0]["nodes"]
    assert sorted([*children, *roots]) == list(range(len(glb.json["nodes"])))
    opened = trimesh.load_scene(tmp_path / "p.glb")
    (mesh,) = opened.geometry.values()
    assert len(mesh.faces) == 6 * 12
    height = mesh.bounds[1, 1] - mesh.bounds[0, 1]
    assert height == pytest.approx(1.875, abs=1e-5)


def test_a_still_has_a_skeleton_in_its_pose(tmp_path: Path) -> None:
    player = dressed_player(make_wearer(motion="sit"))
    save_model(player, tmp_path / "p.glb", seconds=0, time=1.0)
    glb = Glb(tmp_path / "p.glb")
    assert "animations" not in glb.json
    (leg,) = [node for node in glb.json["nodes"] if node["name"] == "right_leg"]
    bones = Dressed(player, open_packs(()), player.settings()).wearer.poses(1.0)  # type: ignore[union-attr]
    np.testing.assert_allclose(matrix(np.array(leg["rotation"])), bones["right_leg"][1], atol=1e-6)


def test_quaternions_of_rotations_are_unit_and_continuous() -> None:
    axes = np.random.default_rng(1).normal(size=(12, 3))
    turns = [rotation_about(tuple(axis), angle) for axis in axes for angle in range(0, 720, 30)]
    found = quaternions(np.array(turns))
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1, atol=1e-6)
    for turn, quaternion in zip(turns, found, strict=True):
        np.testing.assert_allclose(matrix(quaternion), turn, atol=1e-6)
    one = found[:24]
    assert ((one[1:] * one[:-1]).sum(axis=1) > 0.9).all()


def test_frames_of_a_loop_share_what_does_not_change() -> None:
    player = dressed_player(make_wearer(motion="wave"))
    packs = open_packs(())
    first, second = loop(player, packs, player.settings(ground="none"), 2, 4.0)
    for name in ("triangles", "uvs"):
        one, other = (getattr(scene.models[0].mesh, name) for scene in (first, second))
        assert one is other
    assert len(list(iter_frames(player, size=(8, 8), seconds=0.5, fps=4))) == 2
