"""Readers of the files that pictures, garments and styles are made of, for the fuzzing."""

import copy
import io
import json
import random
import struct
import zlib
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any
from unittest import mock

import fuzzing
import numpy as np
import trimesh
from fuzzing import Target
from PIL import Image

from drapery.comparison.picture import decode_picture
from drapery.file_formats import READERS
from drapery.garments import Garment, tailor
from drapery.garments.motions import find_motion
from drapery.garments.profiles import read_profile
from drapery.mesh_file import read_mesh_file
from drapery.packs import open_packs
from drapery.picture_file import opened_picture
from drapery.picture_pixels import pixels_of
from drapery.render.frame import Frame
from drapery.style.skins import read_skin
from drapery.styles import Style

PNG = b"\x89PNG\r\n\x1a\n"
MAX_FACES = 50_000
"""The most triangles of a 3-D file, as in garments."""
MAX_PIXELS = 1 << 22
"""The most pixels of a picture, fewer than are read elsewhere: the bound on memory is on copies."""
MAX_TEXT = 4000
"""The longest text of a garment or style [characters]; the longest sample has a third."""
GARMENT = """\
description = "All shapes"
fabric = { density = 0.2 }
collisions = "all"
texture = { block = "white_wool", dye = "red", stripes = ["blue"], width = 2 }
picture = { wind = 3, view = "iso", style = ["cel"] }
[wearer]
kind = "player"
motion = "walk+wave"
armor = "helmet:iron"
look = [10, 5]
[[piece]]
name = "shawl"
size = [8, 8]
hem = 10
points = [5, 4]
mirror = "other"
texture = { design = "white creeper:lime", box = [0, 0, 10, 16, 1] }
[[piece]]
name = "rope"
shape = "strip"
ends = [[0, 20, 0], [4, 20, 0]]
length = 5
points = 4
[[piece]]
name = "skirt"
shape = "ring"
profile = [[12, 4, 3], [4, 8, 8]]
points = [8, 3]
open = 30
[[piece]]
name = "hat"
shape = "disc"
radius = 4
rings = 2
[[piece]]
name = "pennon"
shape = "polygon"
corners = [[0, 0], [6, 2], [0, 4]]
spacing = 1
[[pin]]
piece = "shawl"
at = "top"
to = "body"
[[pin]]
piece = "pennon"
at = [[0, 0], [0, 4]]
[[seam]]
join = ["shawl.left", "other.left"]
[[pole]]
start = [0, 0, 9]
end = [0, 30, 9]
[[block]]
cell = [0, 0, 2]
kind = "grass"
"""
STYLE = """\
description = "All kinds"
light = "flat"
samples = 4
[[motion]]
step = "hold"
every = 2
[[shape]]
step = "smooth"
times = 2
[[material]]
step = "palette"
colours = ["#000000", "#ffffff"]
dither = 0.5
[[picture]]
step = "pixels"
size = 2
[[picture]]
step = "limit"
colours = 3
[[picture]]
step = "outline"
colour = "#1a1620"
width = 1.5
"""
POSE = {"head": [0, 10, -5], "right_arm": [-90, 0, 0], "left_leg": [20.5, 0, 0]}
PROFILES = (
    '{texture:"minecraft:entity/player/slim/alex",model:"slim"}',
    '{"profile": {"texture": "a:b", "cape": "a:c", "elytra": "a:d", "name": "x"}}',
    "/give @p player_head[profile={texture:'a:b/c',model:'wide'}]",
)


def file_targets(folder: Path) -> dict[str, Target]:
    """All readers by name. folder: where their files are written."""
    found = {
        "garment": Target(_written(folder, "mine.toml", _garment), [GARMENT], _mutate_toml),
        "style": Target(_written(folder, "style.toml", _style), [STYLE], _mutate_toml),
        "pose": Target(
            _written(folder, "pose.json", _pose), [json.dumps(POSE).encode()], _mutate_json_file
        ),
        "profile": Target(_profile, PROFILES, fuzzing.mutate_text),
        "skin": Target(_skin, [_picture((64, 64), "PNG", "RGBA")], _mutate_skin),
        "picture": Target(_pixels, pictures(), _mutate_picture),
    }
    for ending, samples in meshes().items():
        mutate = _mutate_glb if ending == "glb" else _mutate_bytes
        found[ending] = Target(_written(folder, f"mesh.{ending}", _mesh), samples, mutate)
    return found


def _written(
    folder: Path, name: str, read: Callable[[Path], Iterable[Any]]
) -> Callable[[bytes | str], Iterable[Any]]:
    def write_and_read(data: bytes | str) -> Iterable[Any]:
        path = folder / name
        path.write_bytes(data if isinstance(data, bytes) else data.encode("utf-8", "replace"))
        return read(path)

    return write_and_read


def _garment(path: Path) -> Iterable[Any]:
    return tailor(Garment.load(path), open_packs(()))


def _style(path: Path) -> Iterable[Any]:
    """What the picture steps of a style make of a small picture."""
    style = Style.load(path)
    frame = Frame(np.random.default_rng(0).integers(0, 256, (24, 16, 4), dtype=np.uint8))
    return [style.draw(frame, lambda scene: frame)]


def _pose(path: Path) -> Iterable[Any]:
    return find_motion(path.name, path.parent).poses


def _profile(text: str) -> Iterable[Any]:
    return [read_profile(text)]


def _skin(data: bytes) -> Iterable[Any]:
    with opened_picture(data, "skin", ("PNG",), max_pixels=MAX_PIXELS) as image:
        return [read_skin(pixels_of(image))]


def _pixels(data: bytes) -> Iterable[Any]:
    with (
        mock.patch("drapery.comparison.files.MAX_PIXELS", MAX_PIXELS),
        mock.patch("drapery.comparison.picture.MAX_PIXELS", MAX_PIXELS),
    ):
        return [decode_picture(data, "picture")]


def _mesh(path: Path) -> Iterable[Any]:
    return read_mesh_file(path, max_faces=MAX_FACES)


def meshes() -> dict[str, list[Any]]:
    """Sound 3-D files of each format, by the ends of their names."""
    box = trimesh.creation.box()
    whole = trimesh.Scene({"box": box, "other": trimesh.creation.icosphere(1)})
    coloured = box.copy()
    coloured.visual = trimesh.visual.TextureVisuals(
        uv=np.random.default_rng(0).random((len(box.vertices), 2)),
        image=Image.new("RGB", (4, 4), "red"),
    )
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl a\nf 1/1/1 2/1/1 -1/1/1\n"
    return {
        "glb": [whole.export(file_type="glb"), trimesh.Scene(coloured).export(file_type="glb")],
        "obj": [text.encode(), box.export(file_type="obj").encode()],
        "stl": [box.export(file_type="stl"), box.export(file_type="stl_ascii").encode()],
        "ply": [box.export(file_type="ply"), box.export(file_type="ply", encoding="ascii")],
    }


def pictures() -> list[bytes]:
    """Sound pictures of each format that is read, and of several modes."""
    small = (9, 7)
    found = [_picture(small, form, "RGB") for form in READERS]
    found += [_picture(small, "PNG", mode) for mode in ("1", "L", "LA", "P", "RGBA", "I;16")]
    found += [_picture(small, "PNG", "RGB", frames=3), _picture(small, "GIF", "P", frames=3)]
    found += [_picture(small, "WEBP", "RGBA", frames=2), _picture(small, "WEBP", "RGB", lossless=1)]
    found += [_picture(small, "TIFF", "RGBA", compression=each) for each in TIFF_COMPRESSIONS]
    return [*found, _picture((40, 40), "JPEG", "RGB", progressive=True)]


TIFF_COMPRESSIONS = ("tiff_lzw", "tiff_adobe_deflate", "packbits")


def _picture(size: tuple[int, int], form: str, mode: str, frames: int = 1, **rest: Any) -> bytes:
    rng = np.random.default_rng(len(mode))
    noise = [rng.integers(0, 256, (size[1], size[0], 4), dtype=np.uint8) for _ in range(frames)]
    first, *others = (Image.fromarray(each).convert(mode.partition(";")[0]) for each in noise)
    if ";" in mode:
        first = first.convert(mode)
    if others:
        rest |= {"save_all": True, "append_images": others, "duration": 50}
    out = io.BytesIO()
    first.save(out, form, **rest)
    return out.getvalue()


def _mutate_bytes(rng: random.Random, samples: Sequence[bytes]) -> bytes:
    """Other bytes; a text keeps its encoding half of the time, a PNG its checksums."""
    data = rng.choice(samples)
    if rng.random() < 0.5:
        with suppress(UnicodeDecodeError):
            text = data.decode()
            return fuzzing.mutate_text(rng, [text]).encode("utf-8", "replace")
    changed = fuzzing.change_bytes(rng, data, samples)
    return _with_checksums(changed) if rng.random() < 0.8 else changed


def _with_checksums(data: bytes) -> bytes:
    """A PNG with the checksums of its chunks, as far as it has whole chunks."""
    if data[:8] != PNG:
        return data
    at, parts = 8, [data[:8]]
    while at + 12 <= len(data):
        size = int.from_bytes(data[at : at + 4], "big")
        body = data[at + 4 : at + 8 + size]
        if len(body) < 4 + size:
            break
        parts += [data[at : at + 4], body, struct.pack(">I", zlib.crc32(body))]
        at += 12 + size
    return b"".join([*parts, data[at:]])


def _mutate_skin(rng: random.Random, samples: Sequence[bytes]) -> bytes:
    """Other bytes, or a sound picture of another size and mode."""
    if rng.random() < 0.6:
        return _mutate_bytes(rng, samples)
    size = rng.choice((1, 16, 31, 32, 64, 128)), rng.choice((1, 32, 63, 64, 128))
    return _picture(size, "PNG", rng.choice(("1", "L", "LA", "P", "RGB", "RGBA", "I;16")))


OTHER_FORMATS = [_picture((9, 7), form, "RGB") for form in ("PPM", "ICO", "TGA")]
"""Pictures that Pillow reads, and that are refused here."""


def _mutate_picture(rng: random.Random, samples: Sequence[bytes]) -> bytes:
    return _mutate_bytes(rng, OTHER_FORMATS if rng.random() < 0.1 else samples)


def _mutate_toml(rng: random.Random, samples: Sequence[str]) -> str:
    """Other values, lines left out or doubled; or other characters."""
    text = rng.choice(samples)
    if rng.random() < 0.3:
        return fuzzing.mutate_text(rng, samples)[:MAX_TEXT]
    lines = text.splitlines()
    for _ in range(rng.randint(1, 2)):
        at = rng.randrange(len(lines))
        name, equals, _ = lines[at].partition(" = ")
        if rng.random() < 0.9 and equals:
            lines[at] = f"{name} = {rng.choice(ODD_TOML)}"
        else:
            lines[at : at + 1] = [lines[at]] * rng.choice((0, 0, 2))
    return "\n".join(lines)


ODD_TOML = (
    *("0", "-1", "1", "2", "65", "1e9", "-0.0", "nan", "inf", "0.001", "2**9", "9" * 99, "true"),
    *('""', '"a"', '"red"', '"../x"', '"/dev/zero"', '"a\\u0000b"', '"' + "x" * 900 + '"', "''"),
    *("[]", "{}", "[1]", "[1, 2]", "[0, 0, 0]", "[[0, 0], [0, 0]]", "[[1, 1, 1], [1, 1, 1]]"),
    *("[1024, 1024]", "[-1024, 1024]", "[65, 65]", "[0.01, 0.01]", '["a", "b"]', "{ a = 1 }"),
    *("1979-05-27", "07:32:00", "1979-05-27T07:32:00Z", "a.b", "[" * 40 + "]" * 40),
)


def _mutate_json_file(rng: random.Random, samples: Sequence[bytes]) -> bytes:
    if rng.random() < 0.5:
        return _mutate_bytes(rng, samples)
    tree = json.loads(rng.choice(samples))
    _change_tree(rng, tree)
    return json.dumps(tree).encode()


def _mutate_glb(rng: random.Random, samples: Sequence[bytes]) -> bytes:
    """Other bytes, or another description of the same bytes."""
    if rng.random() < 0.3:
        return _mutate_bytes(rng, samples)
    data = rng.choice(samples)
    size = int.from_bytes(data[12:16], "little")
    tree, blob = json.loads(data[20 : 20 + size]), data[20 + size :]
    for _ in range(rng.randint(1, 3)):
        _change_tree(rng, tree)
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(blob))
    return head + struct.pack("<I4s", len(text), b"JSON") + text + blob


def _change_tree(rng: random.Random, tree: Any) -> None:
    """Remove, double or replace one value of a tree of JSON."""
    places: list[tuple[Any, Any]] = []
    left = [tree]
    while left:
        node = left.pop()
        keys = list(node) if isinstance(node, dict) else range(len(node))
        places += ((node, key) for key in keys)
        left += (node[key] for key in keys if isinstance(node[key], (dict, list)))
    if not places:
        return
    node, key = rng.choice(places)
    chance = rng.random()
    if chance < 0.2:
        del node[key]
    elif chance < 0.4 and isinstance(node, list):
        node[key:key] = [node[key]] * rng.choice((1, 2, 40))
    elif chance < 0.5:
        other, name = rng.choice(places)
        node[key] = copy.deepcopy(other[name])
    else:
        node[key] = copy.deepcopy(rng.choice(ODD_JSON))


ODD_JSON: tuple[Any, ...] = (
    *(None, True, -1, 0, 1, 2, 3, 7, 5121, 5123, 5126, 10**9, 10**30, 0.5, -1e308),
    *("", "a", "VEC3", "MAT4", "SCALAR", "data:;base64,AAAA", "x" * 500, [], {}, [0], [1e9] * 16),
    *([0, 0, 0, 0], {"a": 1}, [[0]], [None]),
)
