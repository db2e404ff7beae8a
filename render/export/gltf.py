"""glTF 2.0 in one binary file, moving meshes as morph targets (Khronos, glTF 2.0 specification).

trimesh writes neither morph targets nor samplers, and without a sampler a viewer blurs pixel art,
so this module writes the file. Morph targets take most of it: they are whole numbers of 16 bits
for positions and 8 for normals (KHR_mesh_quantization). Those reach from -1 to 1, but differences
of normals from -2 to 2, so a target holds half of the difference and has a weight of 2.
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
from drapery.render.export.poses import key_poses
from drapery.render.scene import Scene

Json = dict[str, Any]

COMPONENTS = {
    "float32": 5126,
    "uint32": 5125,
    "uint16": 5123,
    "int16": 5122,
    "uint8": 5121,
    "int8": 5120,
}
QUANTIZED = "KHR_mesh_quantization"
FULL_WEIGHT = 2.0
"""Of the target whose pose is shown."""
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
        """Add an array and its accessor, with its least and greatest values; returns its index.

        Signed whole numbers are shares of the largest one.
        """
        flat = values.reshape(len(values), -1)
        more = {"target": target} if target else {}
        entry = self._entry(values, kind)
        if values.dtype.name in ("int8", "int16"):
            # The values of a vertex begin at a multiple of four bytes.
            padded = np.pad(flat, ((0, 0), (0, -flat.shape[1] % (4 // flat.itemsize))))
            more["byteStride"] = padded.shape[1] * padded.itemsize
            entry["normalized"] = True
            view = self.view(padded.tobytes(), **more)
            self.require(QUANTIZED)
        else:
            view = self.view(values.tobytes(), **more)
        bounds = {"min": flat.min(axis=0).tolist(), "max": flat.max(axis=0).tolist()}
        return self.add("accessors", entry | bounds | {"bufferView": view})

    def sparse(self, count: int, places: NDArray[np.uint32], value: float) -> int:
        """Add an accessor of numbers that are zero but at some places; returns its index."""
        numbers = np.full(len(places), value, np.float32)
        sparse = {
            "count": len(places),
            "indices": {"bufferView": self.view(places.tobytes()), "componentType": 5125},
            "values": {"bufferView": self.view(numbers.tobytes())},
        }
        entry = {"componentType": COMPONENTS["float32"], "count": count, "type": "SCALAR"}
        return self.add("accessors", entry | {"sparse": sparse, "min": [0.0], "max": [value]})

    def require(self, extension: str) -> None:
        """Say that readers must know an extension."""
        for key in ("extensionsUsed", "extensionsRequired"):
            if extension not in self.json.setdefault(key, []):
                self.json[key].append(extension)

    def _entry(self, values: NDArray[Any], kind: str) -> Json:
        code = COMPONENTS[values.dtype.name]
        return {"componentType": code, "count": len(values), "type": kind}


def glb_files(parts: MeshParts, scene: Scene, fps: float, name: str) -> dict[str, bytes]:
    """The file of all frames: NAME.glb."""
    width, height = scene.size
    return {f"{name}.glb": _glb_bytes(parts, fps, scene.camera, width / height)}


def _glb_bytes(parts: MeshParts, fps: float, camera: Camera | None, aspect: float) -> bytes:
    """The file's bytes. Moving parts are animated for one loop at `fps` frames/s; after the last
    frame comes the first one. Parts with bones are moved by a skeleton.

    Raises OptionError for a loop of too many poses.
    """
    document = GltfDocument()
    texture = _texture(document, parts)
    kept, error = key_poses(parts, fps)
    channels = []
    skeleton = Skeleton(document, [part.skin for part in parts.parts if part.skin is not None])
    for part in parts.parts:
        material = document.add("materials", _material(part, texture))
        mesh = document.add("meshes", _mesh(document, part, material, kept))
        entry: Json = {"name": part.name, "mesh": mesh}
        if part.skin is not None:
            entry["skin"] = skeleton.skin(part.skin)
        node = document.add("nodes", entry)
        if len(part.positions) > 1 and part.skin is None:
            channels.append(node)
    if parts.frames > 1 and (channels or skeleton.moves):
        clip = PoseClip(document, parts.frames, fps)
        clip.pose(channels, kept, error)
        skeleton.animate(clip)
        document.add("animations", clip.entry())
    if camera is not None:
        document.add("nodes", _camera_node(document, camera, aspect))
    if any(not part.lit for part in parts.parts):
        document.json.setdefault("extensionsUsed", []).append("KHR_materials_unlit")
    nodes = document.json["nodes"]
    children = {child for node in nodes for child in node.get("children", ())}
    roots = [number for number in range(len(nodes)) if number not in children]
    document.json |= {"scene": 0, "scenes": [{"nodes": roots}]}
    return _file(document)


class PoseClip:
    """The animation of a loop: at its end is its first frame again."""

    def __init__(self, document: GltfDocument, frames: int, fps: float) -> None:
        self.document = document
        self._frames, self._fps = frames, fps
        self._times: dict[tuple[int, ...], int] = {}
        self._samplers: list[Json] = []
        self._channels: list[Json] = []
        self._extras: Json = {}

    def add(self, frames: Sequence[int], output: int, nodes: Sequence[int], path: str) -> None:
        """Move a property of some nodes. output: the accessor of its values in these frames."""
        key = tuple(frames)
        if key not in self._times:
            times = (np.array(key) / self._fps).astype(np.float32)
            self._times[key] = self.document.accessor(times, "SCALAR")
        sampler = {"input": self._times[key], "output": output, "interpolation": "LINEAR"}
        self._channels += [
            {"sampler": len(self._samplers), "target": {"node": node, "path": path}}
            for node in nodes
        ]
        self._samplers.append(sampler)

    def pose(self, nodes: Sequence[int], kept: Sequence[int], error: float) -> None:
        """Show the morph target of each kept frame at its time, alone. error: of the others [m]."""
        targets = len(kept) - 1
        if nodes and targets:
            places = np.arange(targets, dtype=np.uint32) * (targets + 1) + targets
            weights = self.document.sparse((targets + 2) * targets, places, FULL_WEIGHT)
            self.add([*kept, self._frames], weights, nodes, "weights")
            self._extras = {"keyPoseError": round(error, 6)}

    def every(self, values: NDArray[np.float32], kind: str, node: int, path: str) -> None:
        """Move a property of a node. values: in each frame, shape [F, ...]."""
        output = self.document.accessor(np.concatenate([values, values[:1]]), kind)
        self.add(range(self._frames + 1), output, [node], path)

    def entry(self) -> Json:
        """The animation as the document has it: cloth waves, and bones alone move."""
        name = "wave" if self._extras else "move"
        found: Json = {"name": name, "samplers": self._samplers, "channels": self._channels}
        return found | ({"extras": self._extras} if self._extras else {})


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

    def animate(self, clip: "PoseClip") -> None:
        """Add where each bone is in each frame."""
        for bone, (places, turns) in self._poses.items():
            clip.every(places, "VEC3", self._nodes[bone], "translation")
            clip.every(turns, "VEC4", self._nodes[bone], "rotation")

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
    view = document.view(png_bytes(parts.atlas))
    image = {"name": "texture", "mimeType": "image/png", "bufferView": view}
    sampler = {
        "magFilter": NEAREST,
        "minFilter": NEAREST,
        "wrapS": CLAMP_TO_EDGE,
        "wrapT": CLAMP_TO_EDGE,
    }
    return document.add(
        "textures",
        {
            "name": "texture",
            "source": document.add("images", image),
            "sampler": document.add("samplers", sampler),
        },
    )


def _material(part: MeshPart, texture: int) -> Json:
    """A matt material. A closed part hides its backs, which a viewer would draw through edges."""
    surface = {
        "baseColorTexture": {"index": texture},
        "metallicFactor": 0.0,
        "roughnessFactor": 1.0,
    }
    both = not (part.closed and part.alpha == "opaque")
    material: Json = {"name": part.name, "doubleSided": both, "pbrMetallicRoughness": surface}
    if part.alpha != "opaque":
        material["alphaMode"] = ALPHA_MODES[part.alpha]
    if not part.lit:
        material["extensions"] = {"KHR_materials_unlit": {}}
    return material


def _mesh(document: GltfDocument, part: MeshPart, material: int, kept: Sequence[int]) -> Json:
    """The first frame as the mesh, and each later one that is kept as a morph target.

    A part with bones is the mesh at rest, without targets.
    """

    def vectors(values: Float32) -> int:
        return document.accessor(values, "VEC3", VERTICES)

    skin = part.skin
    later = kept[1:] if skin is None and len(part.positions) > 1 else []
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
    # The largest number of a type ends a strip in some programs, so no vertex has it.
    numbers = np.uint16 if len(part.uvs) <= np.iinfo(np.uint16).max else np.uint32
    primitive: Json = {
        "attributes": attributes,
        "indices": document.accessor(part.triangles.astype(numbers).ravel(), "SCALAR", INDICES),
        "material": material,
    }
    mesh: Json = {"name": part.name, "primitives": [primitive]}
    if later:
        primitive["targets"] = [
            {
                "POSITION": vectors(_half(part.positions[frame] - part.positions[0], np.int16)),
                "NORMAL": vectors(_half(part.normals[frame] - part.normals[0], np.int8)),
            }
            for frame in later
        ]
        mesh["weights"] = [0.0] * len(later)
        mesh["extras"] = {"targetNames": [f"frame_{frame:04d}" for frame in later]}
    return mesh


def _half(difference: Float32, kind: type[np.int8] | type[np.int16]) -> NDArray[Any]:
    """Half of a difference as shares of the largest number; as it is where it is over 1."""
    half = difference / np.float32(FULL_WEIGHT)
    if np.abs(half).max() > 1:
        return half
    return np.round(half * np.iinfo(kind).max).astype(kind)


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
