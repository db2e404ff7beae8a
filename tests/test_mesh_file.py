"""3-D files: what is read, and what is refused by its header in one line that names the file."""

import base64
import io
import json
import logging
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from cost import limited_cost
from PIL import Image

from drapery import draw
from drapery.cloth import from_mesh, load_mesh
from drapery.errors import OptionError
from drapery.garments import Garment, GarmentMesh
from drapery.garments.meshes import read_stiff_mesh
from drapery.mesh_file import read_mesh_file
from drapery.mesh_headers import MAX_NODE_DEPTH, MAX_NODES, MAX_TEXTURES

BOX = trimesh.creation.box()


def written(folder: Path, name: str, data: bytes | str) -> Path:
    path = folder / name
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    return path


def glb(change: Callable[[dict[str, Any]], object] = lambda tree: None, more: bytes = b"") -> bytes:
    """A box with a changed description. more: bytes behind its own, as the last buffer view."""
    data = trimesh.Scene({"box": BOX}).export(file_type="glb")
    size = int.from_bytes(data[12:16], "little")
    tree, blob = json.loads(data[20 : 20 + size]), data[28 + size :]
    if more:
        view = {"buffer": 0, "byteOffset": len(blob), "byteLength": len(more)}
        tree["bufferViews"].append(view)
        blob += more
        tree["buffers"][0]["byteLength"] = len(blob)
    change(tree)
    text = json.dumps(tree).encode()
    parts = struct.pack("<I4s", len(text), b"JSON") + text
    parts += struct.pack("<I4s", len(blob), b"BIN\0") + blob
    return struct.pack("<4sII", b"glTF", 2, 12 + len(parts)) + parts


def chain(count: int) -> Callable[[dict[str, Any]], None]:
    def change(tree: dict[str, Any]) -> None:
        nodes: list[dict[str, Any]] = [{"children": [n + 1]} for n in range(count)]
        tree["nodes"] = [*nodes, {"mesh": 0}]
        tree["scenes"] = [{"nodes": [0]}]

    return change


def picture(side: int = 4) -> bytes:
    buffer = io.BytesIO()
    Image.new("RGB", (side, side), (200, 10, 10)).save(buffer, "PNG")
    return buffer.getvalue()


def textured(**image: Any) -> Callable[[dict[str, Any]], None]:
    def change(tree: dict[str, Any]) -> None:
        tree["images"] = [image or {"bufferView": len(tree["bufferViews"]) - 1}]
        tree["textures"] = [{"source": 0}]
        tree["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
        tree["meshes"][0]["primitives"][0]["material"] = 0

    return change


PLY = "ply\nformat ascii 1.0\n{}element vertex {}\nproperty float x\nproperty float y\n" + (
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
)
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
STL = bytes(80) + struct.pack("<I", 1) + struct.pack("<12fH", *[0] * 3, *range(9), 0)

HOSTILE: dict[str, tuple[str, Callable[[], bytes | str], str]] = {
    "array without bytes": (
        ".glb",
        lambda: glb(lambda tree: tree["accessors"].append({
            "count": 10**8, "type": "VEC3", "componentType": 5126,
        })),
        "states arrays of 1200000",
    ),
    "arrays over the same bytes": (
        ".glb",
        lambda: glb(lambda tree: tree["accessors"].extend(tree["accessors"] * 5000)),
        "at most 4 may share",
    ),
    "chain of nodes": (".glb", lambda: glb(chain(50_000)), f"over {MAX_NODES} nodes"),
    "deep nodes": (".glb", lambda: glb(chain(MAX_NODE_DEPTH)), "64 nodes below one another"),
    "ring of nodes": (
        ".glb",
        lambda: glb(lambda tree: tree.update(nodes=[{"children": [1]}, {"children": [0]}])),
        "a node that lies below itself",
    ),
    "shared node": (
        ".glb",
        lambda: glb(lambda tree: tree.update(nodes=[{"children": [1, 1]}, {"mesh": 0}])),
        "a node that lies below two others",
    ),
    "many copies": (
        ".glb",
        lambda: glb(lambda tree: tree.update(nodes=[{"mesh": 0}] * 1500)),
        "over 1000 parts",
    ),
    "bytes of another file": (
        ".glb",
        lambda: glb(lambda tree: tree["buffers"][0].update(uri="file:///etc/passwd")),
        "its places in another file",
    ),
    "texture of another file": (
        ".glb", lambda: glb(textured(uri="http://a/b.png")), "texture in another file",
    ),
    "large texture": (".glb", lambda: glb(textured(), picture(1025)), "a texture over 1024 px"),
    "cut texture": (".glb", lambda: glb(textured(), picture()[:50]), "is a broken picture"),
    "texture of another format": (".glb", lambda: glb(textured(), b"%!PS" * 9), "save it as PNG"),
    "many textures": (
        ".glb",
        lambda: glb(lambda tree: tree.update(images=[{"uri": "a"}] * (MAX_TEXTURES + 1))),
        "over 64 textures",
    ),
    "packed": (
        ".glb",
        lambda: glb(lambda tree: tree.update(extensionsRequired=["KHR_draco_mesh_compression"])),
        "export it without compression",
    ),
    "nested description": (
        ".glb",
        lambda: struct.pack("<4sIII4s", b"glTF", 2, 90_020, 90_000, b"JSON") + b"[" * 90_000,
        "broken description",
    ),
    "negative count": (
        ".glb", lambda: glb(lambda tree: tree["accessors"][0].update(count=-5)), "broken desc",
    ),
    "cut file": (".glb", lambda: glb()[:-40], "copy it again"),
    "glTF 1": (".glb", lambda: b"glTF" + struct.pack("<II", 1, 20) + bytes(8), "glTF 2.0"),
    "many vertices": (".obj", lambda: OBJ * 60_000, "over 150000 vertices"),
    "many faces": (".obj", lambda: OBJ + "f 1 2 3\n" * 60_000, "over 50000 triangles"),
    "face of many corners": (".obj", lambda: OBJ + "f" + " 1 2 3" * 20_000, "over 50000 triangles"),
    "place 0": (".obj", lambda: OBJ + "f 0 1 2", "line 4: a face has the corner '0'"),
    "place 4": (".obj", lambda: OBJ + "f 2 3 4", "line 4: a face names place 4 of 3"),
    "place before the first": (".obj", lambda: OBJ + "f -4 1 2", "line 4: a face has the corner"),
    "no number": (".obj", lambda: "v 0 0 x\n", "line 1: v is followed by no place"),
    "not finite": (".obj", lambda: OBJ + "v nan 0 0\nf 1 2 3\nf 1 2 4", "4 vertices.*vertex 3"),
    "no text": (".obj", lambda: b"v 0 0 0\xff", "no text in UTF-8"),
    "no faces": (".obj", lambda: OBJ, "with faces"),
    "texture of a PLY file": (
        ".ply", lambda: PLY.format("comment TextureFile a b.png\n", 3), "another file, 'a b.png'",
    ),
    "stated vertices": (".ply", lambda: PLY.format("", 10**8), "over 150000 vertices"),
    "more vertices than bytes": (".ply", lambda: PLY.format("", 9000), "cannot be read"),
    "no header": (".ply", lambda: "ply\nformat ascii 1.0\n", "no whole header"),
    "damaged STL": (".stl", lambda: STL[:84] + b"\xff\xfe" * 30, "neither a whole binary STL"),
    "cut STL": (".stl", lambda: STL[:-1], "neither a whole binary STL|no whole STL"),
    "many triangles": (
        ".stl", lambda: bytes(80) + struct.pack("<I", 60_000) + bytes(3_000_000), "over 50000 tri",
    ),
    "many solids": (".stl", lambda: "solid a\nendsolid\n" * 60_000, "over 1000 parts"),
}  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_is_refused_soon(name: str, tmp_path: Path) -> None:
    ending, make, said = HOSTILE[name]
    path = written(tmp_path, f"bad{ending}", make())
    mesh = GarmentMesh(file=Path(path.name))
    with limited_cost(5), pytest.raises(OptionError, match=rf"bad\{ending}.*({said})") as caught:
        read_stiff_mesh(mesh, tmp_path, 1 / 16)
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 500


def test_triangles_at_one_place_are_bounded(tmp_path: Path) -> None:
    """Cloth near 49,000 triangles at one place was compared with each of them, for minutes."""
    written(tmp_path, "many.obj", OBJ + "f 1 2 3\n" * 49_000)
    said = "many.obj' has 49000 triangles, of which 49000 lie at one place on average; at most 1000"
    with limited_cost(20), pytest.raises(OptionError, match=said):
        read_stiff_mesh(GarmentMesh(file=Path("many.obj")), tmp_path, 1 / 16)
    written(tmp_path, "few.obj", OBJ + "f 1 2 3\n" * 1000)
    assert read_stiff_mesh(GarmentMesh(file=Path("few.obj")), tmp_path, 1 / 16).models
    ball = trimesh.creation.icosphere(5)  # 20,480 triangles
    written(tmp_path, "ball.stl", ball.export(file_type="stl"))
    assert read_stiff_mesh(GarmentMesh(file=Path("ball.stl")), tmp_path, 1 / 16).models


def test_the_library_sees_only_what_is_within_the_bounds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """60,000 materials and the names of other files are not for it."""
    seen: list[bytes] = []
    load = trimesh.load
    monkeypatch.setattr(
        trimesh, "load", lambda file, **rest: seen.append(file.getvalue()) or load(file, **rest)
    )
    text = "mtllib /etc/passwd\n" + OBJ + "".join(f"usemtl {n}\nf 1 2 3\n" for n in range(40_000))
    with limited_cost(10):
        (part,) = read_mesh_file(written(tmp_path, "a.obj", text))
    assert len(part.triangles) == 40_000
    assert b"usemtl" not in seen[0] and b"mtllib" not in seen[0]
    read_mesh_file(written(tmp_path, "a.glb", glb(lambda tree: tree.update(animations=[{}] * 9))))
    assert b"animations" not in seen[1]


@pytest.mark.parametrize("file_type", ["glb", "obj", "ply", "stl"])
def test_each_format_gives_the_same_surface(file_type: str, tmp_path: Path) -> None:
    path = written(tmp_path, f"box.{file_type}", BOX.export(file_type=file_type))
    cloth, solid = from_mesh(path), load_mesh(str(path), scale=2)
    assert len(cloth.rest_positions) == 8 and len(cloth.triangles) == 12
    assert np.ptp(solid.vertices, axis=0).tolist() == [2, 2, 2]


def test_texts_of_meshes_are_read_as_well(tmp_path: Path) -> None:
    text = trimesh.exchange.stl.export_stl_ascii(BOX)
    assert len(from_mesh(written(tmp_path, "box.stl", text)).rest_positions) == 8
    ply = trimesh.exchange.ply.export_ply(BOX, encoding="ascii")
    assert len(from_mesh(written(tmp_path, "box.ply", ply)).rest_positions) == 8
    commented = PLY.format("comment made by hand\n", 3)
    assert len(from_mesh(written(tmp_path, "one.ply", commented)).rest_positions) == 3


def test_relative_places_count_back_from_their_own_line(tmp_path: Path) -> None:
    """Each triangle of a box follows its three corners, as a program writes that keeps no list."""
    blocks = [
        "".join(f"v {x} {y} {z}\n" for x, y, z in BOX.vertices[face].tolist()) + "f -3 -2 -1\n"
        for face in BOX.faces
    ]
    path = written(tmp_path, "blocks.obj", "".join(blocks))
    cloth, solid = from_mesh(path), load_mesh(path)
    assert len(cloth.rest_positions) == 8 and len(cloth.triangles) == 12
    assert solid.solid.all() and len(solid.vertices) == 8
    with_uvs = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
    text = with_uvs + "f -3/-3/-1 2/2/1 \\\n -1/-1/-1\n"
    (part,) = read_mesh_file(written(tmp_path, "uv.obj", text))
    assert part.uvs is not None and part.uvs.tolist() == [[0, 0], [1, 0], [0, 1]]


def test_what_trimesh_logs_is_not_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def logging_load(*_: object, **__: object) -> None:
        logging.getLogger("trimesh.util").warning("failed to extract")
        raise ValueError

    monkeypatch.setattr(trimesh, "load", logging_load)
    monkeypatch.setattr(logging.getLogger(), "handlers", [])
    with pytest.raises(OptionError, match="cannot be read"):
        read_mesh_file(written(tmp_path, "a.obj", OBJ + "f 1 2 3\n"))
    assert capfd.readouterr().err == ""


def test_a_texture_within_the_file_is_drawn(tmp_path: Path) -> None:
    address = "data:image/png;base64," + base64.b64encode(picture()).decode()
    for change, more in ((textured(), picture()), (textured(uri=address), b"")):
        written(tmp_path, "red.glb", glb(change, more))
        (model,) = read_stiff_mesh(GarmentMesh(file=Path("red.glb")), tmp_path, 1 / 16).models
        assert model.materials[0].layers[0].texels[0, 0].tolist() == [200, 10, 10, 255]


def test_a_texture_of_16_bits_keeps_its_upper_eight(tmp_path: Path) -> None:
    buffer = io.BytesIO()
    Image.fromarray(np.full((4, 4), 200 * 256 + 99, np.uint16)).save(buffer, "PNG")
    written(tmp_path, "grey.glb", glb(textured(), buffer.getvalue()))
    (model,) = read_stiff_mesh(GarmentMesh(file=Path("grey.glb")), tmp_path, 1 / 16).models
    assert model.materials[0].layers[0].texels[0, 0].tolist() == [200, 200, 200, 255]


def test_parts_with_one_texture_share_its_texels(tmp_path: Path) -> None:
    def change(tree: dict[str, Any]) -> None:
        textured()(tree)
        tree["nodes"] = [{"mesh": 0}, {"mesh": 0, "translation": [2, 0, 0]}]
        tree["scenes"] = [{"nodes": [0, 1]}]

    written(tmp_path, "two.glb", glb(change, picture()))
    found = read_stiff_mesh(GarmentMesh(file=Path("two.glb")), tmp_path, 1 / 16)
    one, other = (model.materials[0].layers[0].texels for model in found.models)
    assert one is other
    left = sorted(model.mesh.positions[:, 0].min() for model in found.models)
    assert left == [-0.5, 1.5]


@pytest.mark.parametrize(
    ("faces", "said"),
    [
        (
            BOX.faces + 1,
            "has 8 vertices, and its triangles name 1 to 8; they count from 0: sub",
        ),
        (BOX.faces - 1, "has 8 vertices, and its triangles name -1 to 6; they count from 0, and"),
        (BOX.faces + 9, "has 8 vertices, and its triangles name 9 to 16; they count from 0"),
        (BOX.faces[:0], "has no triangles"),
    ],
)
def test_faces_of_a_mesh_are_checked(faces: Any, said: str) -> None:
    with pytest.raises(OptionError, match=f"^mesh {said}"):
        from_mesh(trimesh.Trimesh(BOX.vertices, faces, process=False))


def test_positions_of_a_mesh_are_finite_and_have_an_extent() -> None:
    wrong = BOX.vertices.copy()
    wrong[3, 1] = np.nan
    with pytest.raises(OptionError, match=r"^mesh has 8 vertices.* of 1 are .* vertex 3; .*finite"):
        from_mesh(trimesh.Trimesh(wrong, BOX.faces, process=False))
    with pytest.raises(OptionError, match=r"^mesh of 0 x 0 x 0 has no triangle with an area"):
        from_mesh(trimesh.Trimesh(BOX.vertices * 0, BOX.faces, process=False))
    with pytest.raises(OptionError, match="is no mesh; give a trimesh"):
        from_mesh(5)


def test_a_file_in_millimetres_names_its_size_and_the_scale(tmp_path: Path) -> None:
    points = "".join(f"v {x} {y} {z}\n" for x, y, z in (BOX.vertices * 850).tolist())
    faces = "".join(f"f {a} {b} {c}\n" for a, b, c in (BOX.faces + 1).tolist())
    written(tmp_path, "mm.obj", points + faces)
    path = written(
        tmp_path,
        "mm.toml",
        'mesh = [{ file = "mm.obj" }]\n[[piece]]\nname = "a"\nshape = "grid"\nsize = [9, 9]\n'
        "points = [2, 2]\n",
    )
    said = r"mm\.obj' is 850 x 850 x 850 units large .* give a smaller scale, such as 0\.016 for"
    with pytest.raises(OptionError, match=said):
        draw(Garment.load(path), size=(16, 16))
    path.write_text(path.read_text().replace('"mm.obj" }', '"mm.obj", scale = 0.016 }'))
    assert draw(Garment.load(path), size=(16, 16)).pixels[..., 3].any()


def test_other_formats_of_the_library_are_not_read(tmp_path: Path) -> None:
    for name in ("a.gltf", "a.off", "a.zip", "a.json", "a"):
        with pytest.raises(OptionError, match=r"no 3-D file that is read; use \.glb, \.obj"):
            load_mesh(written(tmp_path, name, "OFF"))


def test_texture_coordinates_are_bounded(tmp_path: Path) -> None:
    text = OBJ + "vt 0 0\nvt 1 0\nvt {} 0\nf 1/1 2/2 3/3\n"
    for number in ("nan", "1e30", "-10001"):
        with pytest.raises(
            OptionError, match=r"a\.obj has texture coordinates that are no numbers"
        ):
            read_mesh_file(written(tmp_path, "a.obj", text.format(number)))
    assert read_mesh_file(written(tmp_path, "a.obj", text.format(-9)))
