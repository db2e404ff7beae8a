"""glTF 2.0 in one binary file, moving meshes as morph targets (Khronos, glTF 2.0 specification).

trimesh writes neither morph targets nor samplers, and without a sampler a viewer blurs pixel art,
so this module writes the file.
"""

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.render.camera import Camera, camera_pose
from drapery.render.drawlist import Float32
from drapery.render.encode.png import png_bytes
from drapery.render.export.parts import MeshPart, MeshParts

Json = dict[str, Any]

FLOAT, UINT = 5126, 5125
VERTICES, INDICES = 34962, 34963
NEAREST, CLAMP_TO_EDGE = 9728, 33071
ALPHA_MODES = {"opaque": "OPAQUE", "cutout": "MASK", "blend": "BLEND"}


class GltfDocument:
    """A glTF document under construction: its JSON and its binary buffer."""

    def __init__(self) -> None:
        self.json: Json = {"asset": {"version": "2.0", "generator": "drapery"}}
        self.binary = bytearray()

    def add(self, kind: str, entry: Json) -> int:
        """Append to one of the document's lists; returns the entry's index."""
        entries = self.json.setdefault(kind, [])
        entries.append(entry)
        return len(entries) - 1

    def view(self, data: bytes, **more: Any) -> int:
        """Add bytes, aligned to four, and a buffer view of them; returns its index."""
        self.binary += bytes(-len(self.binary) % 4)
        place = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        self.binary += data
        return self.add("bufferViews", place | more)

    def accessor(self, values: NDArray[Any], kind: str, target: int | None = None) -> int:
        """Add an array and its accessor, with its least and greatest values; returns its index."""
        code = FLOAT if values.dtype == np.float32 else UINT
        view = self.view(values.tobytes(), **({"target": target} if target else {}))
        flat = values.reshape(len(values), -1)
        bounds = {"min": flat.min(axis=0).tolist(), "max": flat.max(axis=0).tolist()}
        entry = {"bufferView": view, "componentType": code, "count": len(values), "type": kind}
        return self.add("accessors", entry | bounds)


def glb_bytes(parts: MeshParts, fps: float, camera: Camera | None, aspect: float) -> bytes:
    """The file's bytes. Moving parts are animated for one loop at `fps` frames/s; after the last
    frame comes the first one."""
    document = GltfDocument()
    texture = _texture(document, parts)
    materials: dict[tuple[str, bool], int] = {}
    channels = []
    for part in parts.parts:
        kind = part.alpha, part.lit
        if kind not in materials:
            materials[kind] = document.add("materials", _material(part, texture))
        mesh = document.add("meshes", _mesh(document, part, materials[kind]))
        node = document.add("nodes", {"name": part.name, "mesh": mesh})
        if len(part.positions) > 1:
            channels.append(node)
    if channels:
        document.add("animations", _animation(document, channels, parts.frames, fps))
    if camera is not None:
        document.add("nodes", _camera_node(document, camera, aspect))
    if any(not part.lit for part in parts.parts):
        document.json["extensionsUsed"] = ["KHR_materials_unlit"]
    document.json |= {"scene": 0, "scenes": [{"nodes": list(range(len(document.json["nodes"])))}]}
    return _file(document)


def _texture(document: GltfDocument, parts: MeshParts) -> int:
    image = {"mimeType": "image/png", "bufferView": document.view(png_bytes(parts.atlas))}
    sampler = {
        "magFilter": NEAREST,
        "minFilter": NEAREST,
        "wrapS": CLAMP_TO_EDGE,
        "wrapT": CLAMP_TO_EDGE,
    }
    return document.add(
        "textures",
        {"source": document.add("images", image), "sampler": document.add("samplers", sampler)},
    )


def _material(part: MeshPart, texture: int) -> Json:
    """A matt material that is visible from both sides."""
    surface = {
        "baseColorTexture": {"index": texture},
        "metallicFactor": 0.0,
        "roughnessFactor": 1.0,
    }
    name = part.alpha if part.lit else f"{part.alpha}_unlit"
    material: Json = {"name": name, "doubleSided": True, "pbrMetallicRoughness": surface}
    if part.alpha != "opaque":
        material["alphaMode"] = ALPHA_MODES[part.alpha]
    if not part.lit:
        material["extensions"] = {"KHR_materials_unlit": {}}
    return material


def _mesh(document: GltfDocument, part: MeshPart, material: int) -> Json:
    """The first frame as the mesh, and the difference of each later one as a morph target."""

    def vectors(values: Float32) -> int:
        return document.accessor(values, "VEC3", VERTICES)

    later = range(1, len(part.positions))
    primitive: Json = {
        "attributes": {
            "POSITION": vectors(part.positions[0]),
            "NORMAL": vectors(part.normals[0]),
            "TEXCOORD_0": document.accessor(part.uvs, "VEC2", VERTICES),
        },
        "indices": document.accessor(part.triangles.astype(np.uint32).ravel(), "SCALAR", INDICES),
        "material": material,
    }
    mesh: Json = {"name": part.name, "primitives": [primitive]}
    if later:
        primitive["targets"] = [
            {
                "POSITION": vectors(part.positions[frame] - part.positions[0]),
                "NORMAL": vectors(part.normals[frame] - part.normals[0]),
            }
            for frame in later
        ]
        mesh["weights"] = [0.0] * len(later)
        mesh["extras"] = {"targetNames": [f"frame_{frame:04d}" for frame in later]}
    return mesh


def _animation(document: GltfDocument, nodes: list[int], frames: int, fps: float) -> Json:
    """At key k frame k's weight is 1 and all others 0; the last key is the first frame again."""
    weights = np.eye(frames + 1, frames, dtype=np.float32)[:, 1:]
    times = (np.arange(frames + 1) / fps).astype(np.float32)
    sampler = {
        "input": document.accessor(times, "SCALAR"),
        "output": document.accessor(weights.ravel(), "SCALAR"),
        "interpolation": "LINEAR",
    }
    return {
        "name": "loop",
        "samplers": [sampler],
        "channels": [{"sampler": 0, "target": {"node": node, "path": "weights"}} for node in nodes],
    }


def _camera_node(document: GltfDocument, camera: Camera, aspect: float) -> Json:
    near, far = {"znear": camera.near}, {"zfar": camera.far}
    if camera.height is None:
        lens = {"yfov": float(np.radians(camera.fov)), "aspectRatio": aspect} | near | far
        entry: Json = {"type": "perspective", "perspective": lens}
    else:
        lens = {"ymag": camera.height / 2, "xmag": camera.height / 2 * aspect} | near | far
        entry = {"type": "orthographic", "orthographic": lens}
    pose = camera_pose(camera)
    return {
        "name": "camera",
        "camera": document.add("cameras", entry),
        "matrix": pose.T.ravel().tolist(),  # column by column
    }


def _file(document: GltfDocument) -> bytes:
    document.json["buffers"] = [{"byteLength": len(document.binary)}]
    content = json.dumps(document.json, separators=(",", ":")).encode()
    chunks = [(b"JSON", content + b" " * (-len(content) % 4))]
    chunks.append((b"BIN\0", bytes(document.binary) + bytes(-len(document.binary) % 4)))
    body = b"".join(struct.pack("<I", len(data)) + kind + data for kind, data in chunks)
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body
