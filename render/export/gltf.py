"""glTF 2.0 in one binary file, moving meshes as morph targets (Khronos, glTF 2.0 specification).

trimesh writes neither morph targets nor samplers, and without a sampler a viewer blurs pixel art,
so this module writes the file.
"""

import json
import struct
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.render.camera import Camera, camera_pose
from drapery.render.drawlist import Float32
from drapery.render.encode.png import png_bytes
from drapery.render.export.parts import MeshPart, MeshParts, MeshSkin
from drapery.render.scene import Scene

Json = dict[str, Any]

COMPONENTS = {"float32": 5126, "uint32": 5125, "uint8": 5121}
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
        code = COMPONENTS[values.dtype.name]
        view = self.view(values.tobytes(), **({"target": target} if target else {}))
        flat = values.reshape(len(values), -1)
        bounds = {"min": flat.min(axis=0).tolist(), "max": flat.max(axis=0).tolist()}
        entry = {"bufferView": view, "componentType": code, "count": len(values), "type": kind}
        return self.add("accessors", entry | bounds)


def glb_files(parts: MeshParts, scene: Scene, fps: float, name: str) -> dict[str, bytes]:
    """The file of all frames: NAME.glb."""
    width, height = scene.size
    return {f"{name}.glb": _glb_bytes(parts, fps, scene.camera, width / height)}


def _glb_bytes(parts: MeshParts, fps: float, camera: Camera | None, aspect: float) -> bytes:
    """The file's bytes. Moving parts are animated for one loop at `fps` frames/s; after the last
    frame comes the first one. Parts with bones are moved by a skeleton."""
    document = GltfDocument()
    texture = _texture(document, parts)
    materials: dict[tuple[str, bool], int] = {}
    channels = []
    skeleton = Skeleton(document, [part.skin for part in parts.parts if part.skin is not None])
    for part in parts.parts:
        kind = part.alpha, part.lit
        if kind not in materials:
            materials[kind] = document.add("materials", _material(part, texture))
        mesh = document.add("meshes", _mesh(document, part, materials[kind]))
        entry: Json = {"name": part.name, "mesh": mesh}
        if part.skin is not None:
            entry["skin"] = skeleton.skin(part.skin)
        node = document.add("nodes", entry)
        if len(part.positions) > 1 and part.skin is None:
            channels.append(node)
    if parts.frames > 1 and (channels or skeleton.moves):
        document.add("animations", _animation(document, channels, skeleton, parts.frames, fps))
    if camera is not None:
        document.add("nodes", _camera_node(document, camera, aspect))
    if any(not part.lit for part in parts.parts):
        document.json["extensionsUsed"] = ["KHR_materials_unlit"]
    nodes = document.json["nodes"]
    children = {child for node in nodes for child in node.get("children", ())}
    roots = [number for number in range(len(nodes)) if number not in children]
    document.json |= {"scene": 0, "scenes": [{"nodes": roots}]}
    return _file(document)


class Skeleton:
    """The bones of all parts as nodes, each at its joint, below one root.

    Parts of one figure have bones of the same names.
    """

    def __init__(self, document: GltfDocument, skins: Sequence[MeshSkin]) -> None:
        self._document = document
        self._skins: dict[tuple[str, ...], int] = {}
        self._nodes: dict[str, int] = {}
        self._poses: dict[str, tuple[NDArray[np.float32], NDArray[np.float32]]] = {}
        for skin in skins:
            for number, bone in enumerate(skin.bones):
                if bone not in self._nodes:
                    self._add(bone, skin, number)
        if skins:
            document.add("nodes", {"name": "skeleton", "children": [*self._nodes.values()]})

    @property
    def moves(self) -> bool:
        """Whether there is a bone to animate."""
        return bool(self._nodes)

    def skin(self, part: MeshSkin) -> int:
        """The skin of a part: its bones, and how each is undone at rest."""
        if part.bones not in self._skins:
            undone = np.tile(np.eye(4, dtype=np.float32), (len(part.bones), 1, 1))
            undone[:, 3, :3] = -part.joints  # column by column
            matrices = self._document.accessor(undone.reshape(-1, 16), "MAT4")
            joints = [self._nodes[bone] for bone in part.bones]
            entry = {"joints": joints, "inverseBindMatrices": matrices}
            self._skins[part.bones] = self._document.add("skins", entry)
        return self._skins[part.bones]

    def animate(self, times: int, samplers: list[Json], channels: list[Json]) -> None:
        """Add where each bone is at each key; the last one is the first again."""
        for bone, (places, turns) in self._poses.items():
            for path, values, kind in (
                ("translation", places, "VEC3"),
                ("rotation", turns, "VEC4"),
            ):
                output = self._document.accessor(np.concatenate([values, values[:1]]), kind)
                entry = {"input": times, "output": output, "interpolation": "LINEAR"}
                target = {"node": self._nodes[bone], "path": path}
                channels.append({"sampler": len(samplers), "target": target})
                samplers.append(entry)

    def _add(self, bone: str, skin: MeshSkin, number: int) -> None:
        rotations = skin.rotations[:, number]
        # The node of a bone is at its joint.
        joint = (rotations * skin.joints[number]).sum(axis=-1)
        places = (skin.places[:, number] + joint).astype(np.float32)
        turns = quaternions(rotations)
        self._poses[bone] = places, turns
        entry = {"name": bone, "translation": places[0].tolist(), "rotation": turns[0].tolist()}
        self._nodes[bone] = self._document.add("nodes", entry)


def quaternions(rotations: NDArray[Any]) -> NDArray[np.float32]:
    """Unit quaternions x, y, z, w of rotations, shape [F, 3, 3] -> [F, 4], each near the last.

    Each component from the largest, see Shepperd, Journal of Guidance and Control 1 (1978).
    """
    found: list[NDArray[Any]] = []
    for m in rotations:
        trace = m[0, 0] + m[1, 1] + m[2, 2]
        square = np.array([*(2 * np.diag(m) - trace), trace]) + 1  # 4 x^2, 4 y^2, 4 z^2, 4 w^2
        twice = np.array(
            [
                [square[0], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
                [m[0, 1] + m[1, 0], square[1], m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]],
                [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], square[2], m[1, 0] - m[0, 1]],
                [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], square[3]],
            ]
        )
        row = twice[int(np.argmax(square))]
        unit = row / np.sqrt((row * row).sum())
        near = found[-1] if found else np.array([0.0, 0.0, 0.0, 1.0])
        found.append(-unit if (unit * near).sum() < 0 else unit)
    return np.array(found).astype(np.float32)


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
    """The first frame as the mesh, and the difference of each later one as a morph target.

    A part with bones is the mesh at rest, without targets.
    """

    def vectors(values: Float32) -> int:
        return document.accessor(values, "VEC3", VERTICES)

    skin = part.skin
    later = range(1, len(part.positions) if skin is None else 1)
    attributes = {
        "POSITION": vectors(part.positions[0] if skin is None else skin.positions),
        "NORMAL": vectors(part.normals[0] if skin is None else skin.normals),
        "TEXCOORD_0": document.accessor(part.uvs, "VEC2", VERTICES),
    }
    if skin is not None:
        joints, weights = np.zeros((2, len(skin.member), 4))
        joints[:, 0], weights[:, 0] = skin.member, 1
        attributes["JOINTS_0"] = document.accessor(joints.astype(np.uint8), "VEC4", VERTICES)
        attributes["WEIGHTS_0"] = document.accessor(weights.astype(np.float32), "VEC4", VERTICES)
    primitive: Json = {
        "attributes": attributes,
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


def _animation(
    document: GltfDocument, nodes: list[int], skeleton: Skeleton, frames: int, fps: float
) -> Json:
    """At key k frame k's weight is 1 and all others 0; the last key is the first frame again."""
    times = document.accessor((np.arange(frames + 1) / fps).astype(np.float32), "SCALAR")
    samplers: list[Json] = []
    channels: list[Json] = []
    if nodes:
        weights = np.eye(frames + 1, frames, dtype=np.float32)[:, 1:]
        output = document.accessor(weights.ravel(), "SCALAR")
        samplers.append({"input": times, "output": output, "interpolation": "LINEAR"})
        channels += [{"sampler": 0, "target": {"node": n, "path": "weights"}} for n in nodes]
    skeleton.animate(times, samplers, channels)
    return {"name": "loop", "samplers": samplers, "channels": channels}


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
