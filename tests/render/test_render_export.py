"""What is written as a 3-D file comes back as the same meshes, textures and motion."""

import base64
import io
import json
import re
import struct
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from drapery.errors import OptionError, OutputError
from drapery.file_formats import endings_of
from drapery.mesh import Mesh, vertex_normals
from drapery.render.camera import Camera
from drapery.render.export import save_scenes
from drapery.render.light import UNLIT
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene
from drapery.style.boxes import ModelBox, box_mesh

CAMERA = Camera((0.6, 0.5, 3.0), (0.0, 0.0, 0.0))


def texture(seed: int, size: int) -> np.ndarray:
    texels = np.random.default_rng(seed).integers(0, 256, (size, size, 4), dtype=np.uint8)
    texels[..., 3] = np.where(texels[..., 3] < 90, 0, 255)
    return texels


def sheet(bend: float, *offset: float) -> Mesh:
    """A square of 5 x 5 vertices, bent along a sine."""
    u, v = np.meshgrid(*[np.linspace(0, 1, 5)] * 2)
    z = bend * np.sin(3 * u)
    positions = np.stack([u - 0.5, 0.5 - v, z], axis=-1).reshape(-1, 3) + np.array(offset or 0.0)
    corner = (np.arange(4)[:, None] * 5 + np.arange(4)).ravel()
    a, b, c, d = corner, corner + 1, corner + 5, corner + 6
    triangles = np.concatenate([np.stack([a, c, d], 1), np.stack([a, d, b], 1)]).astype(np.int32)
    positions = positions.astype(np.float32)
    uvs = np.stack([u, v], axis=-1).reshape(-1, 2).astype(np.float32)
    return Mesh(positions, vertex_normals(positions, triangles), triangles, uvs)


LOOKS = (
    Material(
        (TextureLayer(texture(1, 8), (255, 90, 40)), TextureLayer(texture(2, 16), (20, 240, 90)))
    ),
    Material((TextureLayer(texture(3, 8)),), "cutout"),
    Material((TextureLayer(texture(4, 8)),), "blend", lit=False),
)


def scenes(count: int = 5) -> list[Scene]:
    """A batch of two that waves in two looks, a still one with holes, one that shines through."""
    still, clear = sheet(0.2, 0.5, 0, 0), sheet(0.1, 0, 0, 0.8)
    frames = []
    for number in range(count):
        pair = [sheet(0.4 * np.cos(number), -0.5, y, 0) for y in (-0.6, 0.6)]
        waving = Mesh(
            np.stack([mesh.positions for mesh in pair]),
            np.stack([mesh.normals for mesh in pair]),
            pair[0].triangles,
            pair[0].uvs,
        )
        models = (
            Model(waving, LOOKS[:2], np.array([0, 1], np.int32)),
            Model(still, LOOKS[1:2]),
            Model(clear, LOOKS[2:]),
        )
        frames.append(Scene(models, CAMERA, (160, 120), UNLIT))
    return frames


SCENES = scenes()
KINDS: dict[int, Any] = {
    **{5126: np.float32, 5125: np.uint32, 5123: np.uint16, 5122: np.int16, 5120: np.int8}
}


def glb(path: Path) -> tuple[dict[str, Any], bytes]:
    """The two chunks of a binary glTF."""
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON" and size % 4 == 0
    rest, kind = struct.unpack_from("<I4s", data, 20 + size)
    assert kind == b"BIN\0" and rest % 4 == 0 and len(data) == 28 + size + rest
    return json.loads(data[20 : 20 + size]), data[28 + size :]


def values(tree: dict[str, Any], binary: bytes, number: int) -> np.ndarray:
    accessor = tree["accessors"][number]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
    kind = KINDS[accessor["componentType"]]
    if "sparse" in accessor:
        found = np.zeros((accessor["count"], width), kind)
        places, numbers = (accessor["sparse"][key] for key in ("indices", "values"))
        count = accessor["sparse"]["count"]
        found[raw(tree, binary, places, np.uint32, count)] = raw(
            tree, binary, numbers, kind, count
        )[:, None]
    else:
        view = tree["bufferViews"][accessor["bufferView"]]
        stride = view.get("byteStride", width * np.dtype(kind).itemsize)
        assert stride % 4 == 0 or accessor["type"] == "SCALAR"
        count = accessor["count"] * stride // np.dtype(kind).itemsize
        found = raw(tree, binary, accessor, kind, count).reshape(accessor["count"], -1)[:, :width]
    assert np.array_equal(found.min(axis=0), np.array(accessor["min"], kind))
    assert np.array_equal(found.max(axis=0), np.array(accessor["max"], kind))
    return found / np.iinfo(kind).max if accessor.get("normalized") else found


def raw(tree: dict[str, Any], binary: bytes, part: dict[str, Any], kind: Any, count: int) -> Any:
    """The first numbers of a buffer view."""
    return np.frombuffer(binary, kind, count, tree["bufferViews"][part["bufferView"]]["byteOffset"])


def test_the_reopened_glb_draws_the_same_picture(tmp_path: Path) -> None:
    save_scenes(SCENES[0], tmp_path / "a.glb")
    opened = trimesh.load_scene(tmp_path / "a.glb")
    models = []
    for name, geometry in opened.geometry.items():
        material = geometry.visual.material
        texels = np.asarray(material.baseColorTexture.convert("RGBA"))
        alpha = {None: "opaque", "OPAQUE": "opaque", "MASK": "cutout", "BLEND": "blend"}
        uvs = np.asarray(geometry.visual.uv, np.float32) * [1, -1] + [0, 1]
        mesh = Mesh(
            np.asarray(geometry.vertices, np.float32),
            np.asarray(geometry.vertex_normals, np.float32),
            np.asarray(geometry.faces, np.int32),
            uvs.astype(np.float32),
        )
        assert material.doubleSided
        lit = "unlit" not in name
        drawn = Material((TextureLayer(texels),), alpha[material.alphaMode], lit=lit)
        models.append(Model(mesh, (drawn,)))
    ours = draw_scene(SCENES[0]).pixels
    theirs = draw_scene(replace(SCENES[0], models=tuple(models))).pixels
    assert (ours[..., 3] > 0).mean() > 0.2
    assert (ours != theirs).any(axis=-1).mean() < 0.005


def test_morph_targets_are_the_frames(tmp_path: Path) -> None:
    save_scenes(iter(SCENES), tmp_path / "a.glb", fps=10)
    tree, binary = glb(tmp_path / "a.glb")
    moving = [mesh for mesh in tree["meshes"] if "weights" in mesh]
    assert [mesh["name"] for mesh in moving] == ["part_0", "part_0_cutout"]
    assert "KHR_mesh_quantization" in tree["extensionsRequired"]
    for mesh, member in zip(moving, (0, 1), strict=True):
        (primitive,) = mesh["primitives"]
        base = values(tree, binary, primitive["attributes"]["POSITION"])
        assert len(mesh["weights"]) == len(primitive["targets"]) == len(SCENES) - 1
        for scene, target in zip(SCENES[1:], primitive["targets"], strict=True):
            moved = base + 2 * values(tree, binary, target["POSITION"])
            wanted = scene.models[0].mesh.positions[member]
            assert np.abs(moved - wanted).max() < 1 / 32767
            normals = values(tree, binary, primitive["attributes"]["NORMAL"])
            turned = normals + 2 * values(tree, binary, target["NORMAL"])
            assert np.abs(turned - scene.models[0].mesh.normals[member]).max() < 0.6 / 63


def test_the_animation_shows_one_frame_at_a_time_and_loops(tmp_path: Path) -> None:
    save_scenes(SCENES, tmp_path / "a.glb", fps=10)
    tree, binary = glb(tmp_path / "a.glb")
    (animation,) = tree["animations"]
    (sampler,) = animation["samplers"]
    times = values(tree, binary, sampler["input"])[:, 0]
    weights = values(tree, binary, sampler["output"]).reshape(len(times), -1)
    assert np.allclose(times, np.arange(6) / 10)
    assert not weights[0].any() and not weights[-1].any()
    assert np.array_equal(weights[1:-1], 2 * np.eye(4))
    assert animation["name"] == "wave"
    assert animation["extras"]["keyPoseError"] == 0
    nodes = [channel["target"]["node"] for channel in animation["channels"]]
    assert all("weights" in tree["meshes"][tree["nodes"][node]["mesh"]] for node in nodes)


def waving(count: int, waves: float) -> list[Scene]:
    """A sheet that bends to and fro."""
    bends = np.sin(2 * np.pi * waves * np.arange(count) / count)
    return [replace(SCENES[0], models=(Model(sheet(0.3 * b), LOOKS[:1]),)) for b in bends]


def test_frames_on_a_line_are_left_out_at_a_stated_error(tmp_path: Path) -> None:
    frames = waving(400, 2)
    save_scenes(frames, tmp_path / "a.glb", fps=100)
    tree, binary = glb(tmp_path / "a.glb")
    (animation,), (mesh,) = tree["animations"], tree["meshes"]
    times = values(tree, binary, animation["samplers"][0]["input"])[:, 0]
    assert 30 < len(mesh["weights"]) < 100 and len(times) == len(mesh["weights"]) + 2
    base = frames[0].models[0].mesh.positions
    targets = mesh["primitives"][0]["targets"]
    moved = [base + 2 * values(tree, binary, target["POSITION"]) for target in targets]
    shown = np.array([base, *moved, base])
    error = max(
        np.abs(
            np.stack(
                [
                    np.interp(number / 100, times, shown[:, vertex, axis])
                    for vertex in range(len(base))
                    for axis in range(3)
                ]
            ).reshape(-1, 3)
            - frame.models[0].mesh.positions
        ).max()
        for number, frame in enumerate(frames)
    )
    stated = animation["extras"]["keyPoseError"]
    assert stated <= 0.001 and stated / 2 < error < stated + 1 / 32767


def test_a_loop_of_too_many_poses_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match=r"takes 281 poses, and a GLB has .* use seconds 25.6"):
        save_scenes(waving(300, 140), tmp_path / "a.glb", fps=10)
    assert list(tmp_path.iterdir()) == []


def test_models_without_a_scene_are_refused(tmp_path: Path) -> None:
    model, *_ = SCENES[0].models
    wrong: Any
    for wrong in ([model], [SCENES[0], model.mesh], model):
        with pytest.raises(OptionError, match=r"writes scenes, .* `Scene\(\(model,\), camera\)`$"):
            save_scenes(wrong, tmp_path / "a.glb")
    assert list(tmp_path.iterdir()) == []


def test_weights_do_not_grow_with_the_square_of_the_targets(tmp_path: Path) -> None:
    sizes = []
    for count in (60, 120, 240):
        save_scenes(waving(count, count // 3), tmp_path / "a.glb", fps=20)
        sizes.append((tmp_path / "a.glb").stat().st_size)
    assert sizes[2] - sizes[1] < 2.1 * (sizes[1] - sizes[0])


def test_only_a_closed_opaque_mesh_is_single_sided_and_names_are_kept(tmp_path: Path) -> None:
    box = box_mesh(ModelBox((-1, -1, -1), (2, 2, 2), (0, 0)))
    inside_out = replace(box, triangles=np.ascontiguousarray(box.triangles[:, ::-1]))
    models = (
        Model(box, LOOKS[:1], name="box"),
        Model(box, LOOKS[1:2], name="box"),
        Model(inside_out, LOOKS[:1]),
        Model(sheet(0.2), LOOKS[:1], name="sheet"),
    )
    save_scenes(replace(SCENES[0], models=models), tmp_path / "a.glb")
    tree, _ = glb(tmp_path / "a.glb")
    both = {each["name"]: each["doubleSided"] for each in tree["materials"]}
    assert both == {"box": False, "box_cutout": True, "part_2": True, "sheet": True}
    assert [each["name"] for each in tree["meshes"]] == list(both)
    assert (tree["images"][0]["name"], tree["textures"][0]["name"]) == ("texture", "texture")


def test_the_origin_is_moved_with_the_camera(tmp_path: Path) -> None:
    save_scenes(SCENES, tmp_path / "a.glb")
    save_scenes(SCENES, tmp_path / "b.glb", origin=(0.5, 0.0, 0.5))
    bounds = [trimesh.load_scene(tmp_path / f"{name}.glb").bounds for name in "ab"]
    assert np.allclose(bounds[0] - bounds[1], [0.5, 0, 0.5], atol=1e-6)
    poses = []
    for name in "ab":
        nodes = glb(tmp_path / f"{name}.glb")[0]["nodes"]
        poses += [np.array(node["matrix"]).reshape(4, 4) for node in nodes if "camera" in node]
    assert np.allclose(poses[0][3, :3] - poses[1][3, :3], [0.5, 0, 0.5])


def test_pixel_art_is_not_blurred_and_the_camera_is_ours(tmp_path: Path) -> None:
    save_scenes(SCENES[0], tmp_path / "a.glb")
    tree, _ = glb(tmp_path / "a.glb")
    (sampler,) = tree["samplers"]
    assert sampler["magFilter"] == sampler["minFilter"] == 9728
    assert tree["cameras"][0]["perspective"]["yfov"] == pytest.approx(np.radians(CAMERA.fov))
    (node,) = [node for node in tree["nodes"] if "camera" in node]
    pose = np.array(node["matrix"]).reshape(4, 4).T
    assert np.allclose(pose[:3, 3], CAMERA.position)
    towards = np.subtract(CAMERA.target, CAMERA.position)
    assert np.allclose(-pose[:3, 2], towards / np.linalg.norm(towards))
    assert tree["extensionsUsed"] == ["KHR_materials_unlit"]


def all_positions(scene: Scene) -> np.ndarray:
    return np.concatenate([model.mesh.positions.reshape(-1, 3) for model in scene.models])


def test_obj_opens_again_with_its_texture(tmp_path: Path) -> None:
    save_scenes(SCENES, tmp_path / "a.obj")
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"a.obj", "a.mtl", "a_texture.png"}
    mesh = trimesh.load_mesh(tmp_path / "a.obj", process=False, maintain_order=True)
    wanted = all_positions(SCENES[0])
    assert len(mesh.faces) == 4 * 32
    assert np.allclose(mesh.bounds, [wanted.min(axis=0), wanted.max(axis=0)], atol=1e-6)
    image = np.asarray(mesh.visual.material.image.convert("RGBA"))
    assert np.array_equal(image, np.asarray(Image.open(tmp_path / "a_texture.png")))
    assert len(mesh.visual.uv) == len(mesh.vertices)


def test_obj_is_written_to_the_letter(tmp_path: Path) -> None:
    """The bytes differed with trimesh's version, and its normals were not those of the meshes."""
    save_scenes(SCENES, tmp_path / "a.obj")
    text = (tmp_path / "a.obj").read_text("utf-8")
    assert text.startswith("# drapery\nmtllib a.mtl\n\no ") and "\nusemtl a_texture\nv " in text
    corners = re.findall(r"(\d+)/(\d+)/(\d+)", text)
    assert all(len({*corner}) == 1 for corner in corners)
    assert max(int(corner[0]) for corner in corners) == text.count("\nv ")
    rows = [line.split()[1:] for line in text.split("\n") if line.startswith("vn ")]
    normals = np.concatenate([model.mesh.normals.reshape(-1, 3) for model in SCENES[0].models])
    assert np.allclose(np.array(rows, float), normals, atol=1e-7)
    assert (tmp_path / "a.mtl").read_text("utf-8") == (
        "# drapery\n\nnewmtl a_texture\nKa 1.00000000 1.00000000 1.00000000\n"
        "Kd 1.00000000 1.00000000 1.00000000\nKs 0.00000000 0.00000000 0.00000000\n"
        "Ns 1.00000000\nmap_Kd a_texture.png\n"
    )


def test_ply_has_the_texels_at_its_vertices(tmp_path: Path) -> None:
    plain = np.full((4, 4, 4), (10, 200, 30, 255), np.uint8)
    scene = replace(SCENES[0], models=(Model(sheet(0.2), (Material((TextureLayer(plain),)),)),))
    save_scenes(scene, tmp_path / "a.ply")
    mesh = trimesh.load_mesh(tmp_path / "a.ply", process=False)
    assert np.array_equal(np.asarray(mesh.vertices, np.float32), scene.models[0].mesh.positions)
    assert np.array_equal(mesh.faces, scene.models[0].mesh.triangles)
    assert (mesh.visual.vertex_colors == (10, 200, 30, 255)).all()
    body = (tmp_path / "a.ply").read_bytes().partition(b"end_header\n")[2]
    vertices = np.frombuffer(body, [("p", "<f4", 3), ("n", "<f4", 3), ("c", "u1", 4)], 25)
    assert np.array_equal(vertices["n"], scene.models[0].mesh.normals)


def test_bedrock_geometry_is_mirrored_in_sixteenths(tmp_path: Path) -> None:
    mesh = sheet(0.3, 0.1, 0.2, 0.3)
    scene = replace(SCENES[0], models=(Model(mesh, LOOKS[:1]),))
    save_scenes(scene, tmp_path / "My Flag.geo.json")
    (geometry,) = json.loads((tmp_path / "My Flag.geo.json").read_text())["minecraft:geometry"]
    assert geometry["description"]["identifier"] == "geometry.my_flag"
    (bone,) = geometry["bones"]
    shape = bone["poly_mesh"]
    positions = np.array(shape["positions"]) * [-1, 1, 1] / 16
    assert np.allclose(positions, mesh.positions, atol=1e-6)
    assert np.allclose(np.array(shape["normals"]) * [-1, 1, 1], mesh.normals, atol=1e-5)
    polys = np.array(shape["polys"])
    assert polys.shape == (len(mesh.triangles), 4, 3)
    assert np.array_equal(polys[:, :3, 0], mesh.triangles)
    assert np.array_equal(polys[:, 3], polys[:, 2])
    width = geometry["description"]["texture_width"]
    with Image.open(tmp_path / "My Flag_texture.png") as image:
        assert image.size == (width, geometry["description"]["texture_height"])
        u, v = np.array(shape["uvs"]).T
        # The sprite lies in the sheet within a border of one texel.
        assert np.allclose(u * image.width, 1 + 16 * mesh.uvs[:, 0], atol=1e-4)
        assert np.allclose((1 - v) * image.height, 1 + 16 * mesh.uvs[:, 1], atol=1e-4)


def test_blockbench_models_hold_mesh_and_texture(tmp_path: Path) -> None:
    save_scenes(SCENES[0], tmp_path / "a.bbmodel")
    model = json.loads((tmp_path / "a.bbmodel").read_text())
    assert model["outliner"] == [element["uuid"] for element in model["elements"]]
    assert len(set(model["outliner"])) == len(model["elements"]) == 4
    head, _, data = model["textures"][0]["source"].partition(",")
    assert head == "data:image/png;base64"
    with Image.open(io.BytesIO(base64.b64decode(data))) as image:
        assert image.size == (model["resolution"]["width"], model["resolution"]["height"])
    still = model["elements"][2]
    assert np.allclose(
        np.array(list(still["vertices"].values())) / 16,
        SCENES[0].models[1].mesh.positions,
        atol=1e-6,
    )
    assert len(still["faces"]) == 32
    for face in still["faces"].values():
        assert set(face["uv"]) == set(face["vertices"]) <= set(still["vertices"])


@pytest.mark.parametrize("ending", endings_of("model"))
def test_same_scenes_same_bytes(tmp_path: Path, ending: str) -> None:
    for run in ("one", "two"):
        (tmp_path / run).mkdir()
        save_scenes(scenes(), tmp_path / run / f"a{ending}")
    for file in (tmp_path / "one").iterdir():
        assert file.read_bytes() == (tmp_path / "two" / file.name).read_bytes()


def test_bad_input_is_refused_and_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match=r"\.stl.*\.glb, \.obj"):
        save_scenes(SCENES, tmp_path / "a.stl")
    with pytest.raises(OptionError, match="without an ending it holds no 3-D file"):
        save_scenes(SCENES, tmp_path / ".glb")
    with pytest.raises(OutputError, match="does not exist"):
        save_scenes(SCENES, tmp_path / "no" / "a.glb")
    with pytest.raises(OptionError, match="no scene"):
        save_scenes([], tmp_path / "a.glb")
    with pytest.raises(OptionError, match="no mesh"):
        save_scenes(replace(SCENES[0], models=()), tmp_path / "a.glb")
    with pytest.raises(OptionError, match="frame 1 has other meshes"):
        save_scenes(
            [SCENES[0], replace(SCENES[0], models=SCENES[0].models[:1])], tmp_path / "a.glb"
        )
    broken = replace(sheet(0.1), positions=np.full((25, 3), np.nan, np.float32))
    with pytest.raises(OptionError, match="not finite"):
        save_scenes(replace(SCENES[0], models=(Model(broken, LOOKS[:1]),)), tmp_path / "a.glb")
    odd = Material((TextureLayer(texture(1, 8)), TextureLayer(texture(1, 12))))
    with pytest.raises(OptionError, match="do not divide"):
        save_scenes(replace(SCENES[0], models=(Model(sheet(0), (odd,)),)), tmp_path / "a.glb")
    (tmp_path / "b.mtl").mkdir()
    with pytest.raises(OutputError, match=r"b\.mtl: it is a folder"):
        save_scenes(SCENES, tmp_path / "b.obj")
    assert [path.name for path in tmp_path.iterdir()] == ["b.mtl"]


def test_only_glb_asks_for_later_scenes(tmp_path: Path) -> None:
    def made() -> Any:
        yield SCENES[0]
        raise AssertionError("made")

    save_scenes(made(), tmp_path / "a.bbmodel")
    with pytest.raises(AssertionError):
        save_scenes(made(), tmp_path / "a.glb")
