"""3-D files judged by their headers, before a library reads them.

Each function returns bytes that `trimesh` reads quickly: what is not used is left out, and what the
file counts is within the bounds. All raise OptionError, one line that names the file.
"""

import base64
import binascii
import json
import re
import struct
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from drapery.errors import OptionError, counted
from drapery.json_text import parse_json
from drapery.picture_file import opened_picture

MAX_PARTS = 1000
"""The most parts of a 3-D file, as often as it places them."""
MAX_NODES = 2000
"""The most nodes of a .glb file: its parts, bones and what holds them."""
MAX_NODE_DEPTH = 64
"""The most nodes of a .glb file below one another."""
MAX_TEXTURE = 1024
"""The widest and highest texture of a 3-D file [px]."""
MAX_TEXTURES = 64
"""The most textures of a 3-D file."""
SHARED = 4
"""Arrays of a .glb file may share its bytes so often."""

_PICTURES = ("PNG", "JPEG", "WEBP")
_COMPRESSED = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu")
_TYPES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_BYTES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
_KEPT = (
    *("asset", "scene", "scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers"),
    *("materials", "textures", "images", "samplers"),
)
"""What of a .glb file is read; animations, skins and cameras are not."""


@dataclass(frozen=True)
class MeshLimits:
    """What a file may count. name: of the file in messages. faces: its triangles."""

    name: str
    faces: int

    @property
    def vertices(self) -> int:
        """The most vertices: three of each triangle."""
        return 3 * self.faces

    def refuse(self, fault: str, remedy: str = "export it again") -> OptionError:
        """The error of this file."""
        return OptionError(f"{self.name} {fault}; {remedy}")

    def check_faces(self, count: int) -> None:
        """Raise OptionError for too many triangles."""
        if count > self.faces:
            raise self.refuse(f"has over {self.faces} triangles", "simplify it")

    def check_vertices(self, count: int) -> None:
        """Raise OptionError for too many vertices."""
        if count > self.vertices:
            raise self.refuse(f"has over {self.vertices} vertices", "simplify it")


def checked_obj(data: bytes, limits: MeshLimits) -> bytes:
    """A Wavefront OBJ file: vertices and faces alone, counted from the first one on.

    A relative index counts back from the last vertex before its line. Materials lie in other files,
    which are not read.
    """
    text = _text(data, limits).replace("\\\n", " ")
    counts = {"v": 0, "vt": 0, "vn": 0}
    kept, faces, triangles = [], [], 0
    for number, line in enumerate(text.split("\n"), 1):
        word, *values = line.partition("#")[0].split() or [""]
        if word in counts:
            counts[word] += 1
            limits.check_vertices(counts[word])
            if not 2 - (word == "vt") < len(values) < 9 or not all(map(_is_number, values)):
                raise limits.refuse(f"line {number}: {word} is followed by no place")
            kept.append(f"{word} {' '.join(values)}")
        elif word == "f":
            triangles += max(0, len(values) - 2)
            limits.check_faces(triangles)
            faces.append((number, [_corner(each, counts, number, limits) for each in values]))
    most = [counts["v"], counts["vt"], counts["vn"]]
    for number, corners in faces:
        for corner in corners:
            for index, count in zip(corner, most, strict=False):
                if index is not None and index > count:
                    raise limits.refuse(
                        f"line {number}: a face names place {index} of {count}",
                        "they count from 1",
                    )
        if len(corners) > 2:
            named = ("/".join("" if i is None else str(i) for i in corner) for corner in corners)
            kept.append(f"f {' '.join(named)}")
    return "\n".join(kept).encode()


def _corner(
    text: str, counts: Mapping[str, int], number: int, limits: MeshLimits
) -> list[int | None]:
    """The indices of a corner of a face, from 1; None for one that is left out."""
    found: list[int | None] = []
    for part, count in zip(text.split("/"), counts.values(), strict=False):
        try:
            index = int(part) if part else None
        except ValueError:
            index = 0
        if index is not None and index < 0:
            index += count + 1
        if index is not None and not 0 < index < 1 << 31:
            raise limits.refuse(
                f"line {number}: a face has the corner {text[:20]!r}", "places count from 1"
            )
        found.append(index)
    return found


def checked_stl(data: bytes, limits: MeshLimits) -> bytes:
    """An STL file, binary or text."""
    if len(data) >= 84:
        count = int.from_bytes(data[80:84], "little")
        if len(data) == 84 + 50 * count:
            limits.check_faces(count)
            return data
    text = _text(data, limits, "is neither a whole binary STL file nor a text").lower()
    if not re.match(r"\s*solid\b", text) or "endsolid" not in text:
        raise limits.refuse("is no whole STL file")
    if text.count("endsolid") > MAX_PARTS:
        raise limits.refuse(f"has over {MAX_PARTS} parts", "join them")
    limits.check_faces(text.count("vertex") // 3)
    return text.encode()


def checked_ply(data: bytes, limits: MeshLimits) -> bytes:
    """A PLY file, binary or text."""
    head, end, body = data.partition(b"end_header")
    lines = head[: 1 << 16].decode("latin-1").replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if not end or len(head) > 1 << 16 or lines[0].strip() != "ply":
        raise limits.refuse("has no whole header of a PLY file")
    counts: dict[str, int] = {}
    kept = []
    for line in lines:
        words = line.split()
        if line.strip().lower().startswith("comment texturefile"):
            raise limits.refuse(
                f"has its texture in another file, {line.split(None, 2)[-1][:40]!r}",
                "export it as .glb, or remove that line",
            )
        if not words or words[0] in ("comment", "obj_info"):
            continue
        if words[0] == "element":
            if len(words) != 3 or not words[2].isdecimal() or len(words[2]) > 9:
                raise limits.refuse(f"has a header with {line.strip()[:40]!r}")
            counts[words[1]] = int(words[2])
        kept.append(" ".join(words))
    limits.check_vertices(counts.get("vertex", 0))
    limits.check_faces(counts.get("face", 0))
    total = sum(counts.values())
    if total > max(len(body), limits.vertices + limits.faces):
        raise limits.refuse(f"counts {counted(total, 'row')} in {counted(len(body), 'byte')}")
    # The line of `end_header` ends with one line break, after which binary data begins.
    body = re.sub(rb"^[ \t]*(\r\n|\r|\n)", b"", body, count=1)
    if any(line.startswith("format ascii") for line in kept):
        rows = (line for line in body.splitlines() if line.strip())
        body = b"\n".join(line for line, _ in zip(rows, range(total), strict=False))
    return "\n".join([*kept, "end_header\n"]).encode("latin-1") + body


def checked_glb(data: bytes, limits: MeshLimits) -> bytes:
    """A glTF 2.0 file of one piece, without what is not drawn."""
    if len(data) < 20 or data[:4] != b"glTF":
        raise limits.refuse("is no .glb file")
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise limits.refuse(f"is of version {version} of glTF", "export it as glTF 2.0")
    if length > len(data):
        raise limits.refuse(f"has {len(data)} of {counted(length, 'byte')}", "copy it again")
    chunks = dict(reversed([*_chunks(data)]))
    try:
        tree = parse_json(chunks[b"JSON"].decode("utf-8"))
        blob = chunks.get(b"BIN\0", b"")
        whole = _GlbTree(tree, blob, limits)
        whole.check()
    except OptionError:
        raise
    except (KeyError, IndexError, TypeError, ValueError, AttributeError, RecursionError):
        raise limits.refuse("has a broken description") from None
    return _glb({name: tree[name] for name in _KEPT if name in tree}, blob)


def _chunks(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    at = 12
    while at + 8 <= len(data):
        size = int.from_bytes(data[at : at + 4], "little")
        yield data[at + 4 : at + 8], data[at + 8 : at + 8 + size]
        at += 8 + size


def _glb(tree: dict[str, Any], blob: bytes) -> bytes:
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    blob += b"\0" * (-len(blob) % 4)
    parts = [struct.pack("<I4s", len(text), b"JSON"), text]
    parts += [struct.pack("<I4s", len(blob), b"BIN\0"), blob]
    return struct.pack("<4sII", b"glTF", 2, 12 + sum(map(len, parts))) + b"".join(parts)


@dataclass(frozen=True)
class _GlbTree:
    """The description of a .glb file, and its bytes."""

    tree: dict[str, Any]
    blob: bytes
    limits: MeshLimits

    def check(self) -> None:
        """Raise OptionError, or another error for a part that lacks what it must have."""
        for name in self.tree.get("extensionsRequired", []):
            if name in _COMPRESSED:
                raise self.limits.refuse(f"is packed with {name}", "export it without compression")
        buffers = self.tree.get("buffers", [])
        if len(buffers) > 1 or any("uri" in each for each in buffers):
            raise self.limits.refuse("has its places in another file", "export it as one .glb")
        self._check_arrays()
        self._check_nodes()
        self._check_pictures()

    def _list(self, name: str) -> list[dict[str, Any]]:
        found = self.tree.get(name, [])
        if not isinstance(found, list) or not all(isinstance(each, dict) for each in found):
            raise TypeError(f"{name} is no list")
        return found

    def _check_arrays(self) -> None:
        total = 0
        for each in self._list("accessors"):
            count = _whole(each["count"])
            total += count * _TYPES[each["type"]] * _BYTES[each["componentType"]]
        most = SHARED * len(self.blob)
        if total > most:
            raise self.limits.refuse(
                f"states arrays of {total} bytes; it has {len(self.blob)}, each of which at most"
                f" {SHARED} may share"
            )
        for each in self._list("bufferViews"):
            start, size = _whole(each.get("byteOffset", 0)), _whole(each["byteLength"])
            if start + size > len(self.blob):
                raise self.limits.refuse(f"states bytes up to {start + size} of {len(self.blob)}")

    def _check_nodes(self) -> None:
        nodes, accessors = self._list("nodes"), self._list("accessors")
        if len(nodes) > MAX_NODES:
            raise self.limits.refuse(f"has over {MAX_NODES} nodes", "join its parts")
        parts, faces = [], []
        for mesh in self._list("meshes"):
            own = mesh["primitives"]
            parts.append(len(own))
            places = (each.get("indices", each["attributes"]["POSITION"]) for each in own)
            faces.append(sum(accessors[_whole(place)]["count"] for place in places) // 3)
        if sum(parts) > MAX_PARTS:
            raise self.limits.refuse(f"has over {MAX_PARTS} parts", "join them")
        used = [_whole(node["mesh"]) for node in nodes if "mesh" in node]
        if sum(parts[each] for each in used) > MAX_PARTS:
            raise self.limits.refuse(f"has over {MAX_PARTS} parts", "join them")
        self.limits.check_faces(max(sum(faces), sum(faces[each] for each in used)))
        self._check_depth([[_whole(child) for child in node.get("children", ())] for node in nodes])

    def _check_depth(self, children: list[list[int]]) -> None:
        parents = {child for each in children for child in each}
        if sum(map(len, children)) > len(parents):
            raise self.limits.refuse("has a node that lies below two others")
        level = [number for number in range(len(children)) if number not in parents]
        seen = len(level)
        for _ in range(MAX_NODE_DEPTH):
            level = [child for number in level for child in children[number]]
            seen += len(level)
        if level:
            raise self.limits.refuse(
                f"has over {MAX_NODE_DEPTH} nodes below one another", "join its parts"
            )
        if seen < len(children):
            raise self.limits.refuse("has a node that lies below itself")

    def _check_pictures(self) -> None:
        images = self._list("images")
        if max(len(images), len(self._list("textures"))) > MAX_TEXTURES:
            raise self.limits.refuse(f"has over {MAX_TEXTURES} textures", "join them")
        if len(self._list("materials")) > MAX_PARTS:
            raise self.limits.refuse(f"has over {MAX_PARTS} materials", "join them")
        views = self._list("bufferViews")
        for number, image in enumerate(images, 1):
            if "bufferView" in image:
                view = views[_whole(image["bufferView"])]
                start = view.get("byteOffset", 0)
                data = self.blob[start : start + view["byteLength"]]
            else:
                data = self._data_of(str(image["uri"]))
            name = f"{self.limits.name}: its texture {number}"
            with opened_picture(data, name, _PICTURES) as picture:
                if max(picture.size) > MAX_TEXTURE:
                    raise self.limits.refuse(
                        f"has a texture over {MAX_TEXTURE} px", "make it smaller"
                    )
                picture.load()  # so that a broken one is refused here

    def _data_of(self, address: str) -> bytes:
        head, comma, text = address.partition(";base64,")
        if not comma or not head.startswith("data:"):
            raise self.limits.refuse(
                f"has its texture in another file, {address[:40]!r}", "export it as one .glb"
            )
        try:
            return base64.b64decode(text)
        except binascii.Error:
            raise self.limits.refuse("has a broken texture") from None


def _whole(value: object) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or value < 0:
        raise TypeError(f"{str(value)[:20]} is no number of a place")
    return value


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return "_" not in text


def _text(data: bytes, limits: MeshLimits, fault: str = "is no text in UTF-8") -> str:
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise limits.refuse(fault) from None
    if "\0" in text:
        raise limits.refuse(fault)
    return text.replace("\r\n", "\n").replace("\r", "\n")


CHECKS: Mapping[str, Callable[[bytes, MeshLimits], bytes]] = {
    ".glb": checked_glb,
    ".obj": checked_obj,
    ".ply": checked_ply,
    ".stl": checked_stl,
}
"""The formats that are read, by the ends of their names."""
