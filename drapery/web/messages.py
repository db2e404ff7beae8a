"""What a page draws, as bytes.

A message is a JSON header followed by arrays of numbers, all little-endian. Its first four bytes
give the header's length. Blanks pad the header, and zeros pad each array, to a multiple of four
bytes. The header's `arrays` gives each array's name, type, length and start; starts count from the
end of the header.
"""

import json
from collections.abc import Collection, Mapping
from dataclasses import astuple
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array
from drapery.render import Scene, bake_normal_maps
from drapery.render.drawlist import make_topology

TYPES = {"float32": "<f4", "uint32": "<u4", "int32": "<i4", "uint8": "|u1"}


def pack(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """A message as bytes."""
    listed, parts, at = [], [], 0
    for name, array in arrays.items():
        kind = array.dtype.name
        data = np.ascontiguousarray(array).astype(TYPES[kind], copy=False).tobytes()
        listed.append([name, kind, array.size, at])
        parts.append(data + bytes(-len(data) % 4))
        at += len(parts[-1])
    text = json.dumps({**header, "arrays": listed}, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return b"".join([len(text).to_bytes(4, "little"), text, *parts])


def unpack(message: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """The header and the arrays of a message, each [n]."""
    start = 4 + int.from_bytes(message[:4], "little")
    header = json.loads(message[4:start])
    arrays = {
        name: np.frombuffer(message, TYPES[kind], count, start + at)
        for name, kind, count, at in header.pop("arrays")
    }
    return header, arrays


def scene_message(
    scene: Scene, cloths: Collection[int]
) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """The header and the arrays of a scene at its start.

    cloths: the numbers of the models that move and can be pulled. A run of vertices is the first
    one and their number: `runs` has those of all models, `grip` those of cloths.
    Raises OptionError for what cannot be drawn.
    """
    models = bake_normal_maps(scene).models
    topology = make_topology(models)
    runs = [[start, end - start] for start, end in pairwise(topology.vertex_start.tolist())]
    materials = np.zeros(len(topology.uvs), np.int32)
    materials[topology.triangles] = topology.triangle_material[:, None]
    tables = topology.material_tables
    kinds = np.stack([tables.material_alpha, tables.material_lit], axis=1)
    shines = np.zeros(len(topology.uvs), np.bool_)
    shines[topology.triangles[tables.material_lit[topology.triangle_material]]] = True
    normals = np.concatenate([_flat(each.mesh.normals) for each in models])
    light = np.where(shines, scene.light.brightness(normals), 1)
    header = {
        "vertices": len(topology.uvs),
        "atlas": tables.atlas.shape[1::-1],
        "background": scene.background,
        "grip": [runs[number] for number in sorted(cloths)],
        "runs": runs,
        "tint": scene.light.tint,
        "camera": astuple(scene.camera),
    }
    arrays: dict[str, NDArray[Any]] = {
        "uvs": topology.uvs,
        "triangles": topology.triangles.astype(np.uint32),
        "triangleMaterials": topology.triangle_material,
        "vertexMaterials": materials,
        "materials": np.concatenate([tables.material_layers, kinds], axis=1, dtype=np.int32),
        "layers": np.concatenate([tables.layer_rects, tables.layer_tints], axis=1, dtype=np.int32),
        "atlas": tables.atlas,
        "positions": np.concatenate([_flat(each.mesh.positions) for each in models]),
        "light": light.astype(np.float32, copy=False),
    }
    return header, arrays


def _flat(vectors: Array) -> NDArray[np.float32]:
    return np.asarray(vectors, np.float32).reshape(-1, 3)
