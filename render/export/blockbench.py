"""Models for Blockbench (.bbmodel) and for Bedrock Edition (.geo.json): one pose, as meshes.

A block is 16 units. Blockbench's y and z axes equal those of a scene; its UVs are in texels, v
downwards. Bedrock mirrors x, and its v grows upwards. Its meshes, `poly_mesh`, consist of quads; a
triangle is a quad that repeats its last corner (Bedrock schema geometry 1.12.0).
"""

import base64
import json
import re
from typing import Any
from uuid import NAMESPACE_URL, uuid5

import numpy as np
from numpy.typing import NDArray

from drapery.render.encode.png import png_bytes
from drapery.render.export.parts import MeshPart, MeshParts
from drapery.render.scene import Scene

UNITS = 16  # per block

Json = dict[str, Any]


def bbmodel_files(parts: MeshParts, scene: Scene, fps: float, name: str) -> dict[str, bytes]:
    """The file of the first frame: NAME.bbmodel."""
    return {f"{name}.bbmodel": _bbmodel_text(parts, name).encode()}


def bedrock_files(parts: MeshParts, scene: Scene, fps: float, name: str) -> dict[str, bytes]:
    """The files of the first frame: NAME.geo.json and NAME_texture.png."""
    texture = png_bytes(parts.atlas)
    text = _bedrock_text(parts, name)
    return {f"{name}_texture.png": texture, f"{name}.geo.json": text.encode()}


def _bbmodel_text(parts: MeshParts, name: str) -> str:
    """A generic model with the texture inside. The same parts and name give the same text."""
    height, width = parts.atlas.shape[:2]
    png = base64.b64encode(png_bytes(parts.atlas)).decode()
    meshes = [_mesh(part, width, height, _identity(name, part.name)) for part in parts.parts]
    texture = {
        "name": f"{name}.png",
        "id": "0",
        "uuid": _identity(name, "texture"),
        "mode": "bitmap",
        "source": f"data:image/png;base64,{png}",
    }
    model = {
        "meta": {"format_version": "4.9", "model_format": "free", "box_uv": False},
        "name": name,
        "resolution": {"width": width, "height": height},
        "elements": meshes,
        "outliner": [mesh["uuid"] for mesh in meshes],
        "textures": [texture],
    }
    return _text(model)


def _bedrock_text(parts: MeshParts, name: str) -> str:
    """A geometry document; the texture is a separate file."""
    height, width = parts.atlas.shape[:2]
    points = np.concatenate([part.positions[0] for part in parts.parts])
    low, high = points.min(axis=0), points.max(axis=0)
    across = 2 * np.abs(np.stack([low, high])[:, [0, 2]]).max()
    description = {
        "identifier": f"geometry.{re.sub(r'[^a-z0-9_]', '_', name.lower())}",
        "texture_width": width,
        "texture_height": height,
        "visible_bounds_width": _rounded(across),
        "visible_bounds_height": _rounded(high[1] - low[1]),
        "visible_bounds_offset": [0, _rounded((low[1] + high[1]) / 2), 0],
    }
    bones = [
        {"name": part.name.replace("/", "_"), "pivot": [0, 0, 0], "poly_mesh": _poly_mesh(part)}
        for part in parts.parts
    ]
    geometry = {"description": description, "bones": bones}
    return _text({"format_version": "1.12.0", "minecraft:geometry": [geometry]})


def _mesh(part: MeshPart, width: int, height: int, identity: str) -> Json:
    corners = [f"v{number}" for number in range(part.uvs.shape[0])]
    uvs = _rounded(part.uvs * [width, height])
    return {
        "type": "mesh",
        "name": part.name,
        "uuid": identity,
        "origin": [0, 0, 0],
        "rotation": [0, 0, 0],
        "vertices": dict(zip(corners, _rounded(part.positions[0] * UNITS), strict=True)),
        "faces": {
            f"f{number}": {
                "vertices": [corners[v] for v in triangle],
                "uv": {corners[v]: uvs[v] for v in triangle},
                "texture": 0,
            }
            for number, triangle in enumerate(part.triangles.tolist())
        },
    }


def _poly_mesh(part: MeshPart) -> Json:
    mirror = np.array([-1, 1, 1])
    return {
        "normalized_uvs": True,
        "positions": _rounded(part.positions[0] * UNITS * mirror),
        "normals": _rounded(part.normals[0] * mirror),
        "uvs": _rounded(np.stack([part.uvs[:, 0], 1 - part.uvs[:, 1]], axis=1)),
        "polys": [
            [[v, v, v] for v in (*triangle, triangle[2])] for triangle in part.triangles.tolist()
        ],
    }


def _rounded(values: NDArray[Any] | float) -> Any:
    return np.round(np.asarray(values, np.float64), 6).tolist()


def _identity(*names: str) -> str:
    return str(uuid5(NAMESPACE_URL, "/".join(("drapery", *names))))


def _text(document: Json) -> str:
    return json.dumps(document, separators=(",", ":")) + "\n"
