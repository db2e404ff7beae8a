"""Stanford PLY: one pose, with colours at its vertices."""

from importlib import import_module
from typing import Any

import numpy as np

from drapery.arrays import Texels
from drapery.render.export.parts import MeshPart, MeshParts
from drapery.render.scene import Scene


def ply_files(parts: MeshParts, scene: Scene, fps: float, name: str) -> dict[str, bytes]:
    """The file of the first frame: NAME.ply."""
    starts = np.cumsum([0, *(len(part.uvs) for part in parts.parts)])
    triangles = [p.triangles + start for p, start in zip(parts.parts, starts[:-1], strict=True)]
    mesh = _library("trimesh").Trimesh(
        np.concatenate([part.positions[0] for part in parts.parts]),
        np.concatenate(triangles),
        vertex_normals=np.concatenate([part.normals[0] for part in parts.parts]),
        vertex_colors=np.concatenate([_vertex_colours(p, parts.atlas) for p in parts.parts]),
        process=False,
    )
    return {f"{name}.ply": _library("trimesh.exchange.ply").export_ply(mesh, vertex_normal=True)}


def _library(name: str) -> Any:
    """A module of trimesh, imported when it is needed; parts of it have no types."""
    return import_module(name)


def _vertex_colours(part: MeshPart, atlas: Texels) -> Texels:
    """The texel at each vertex, shape [V, 4]; opaque if the part is opaque."""
    height, width = atlas.shape[:2]
    x, y = (part.uvs * [width, height]).astype(np.int64).T
    colours: Texels = atlas[np.minimum(y, height - 1), np.minimum(x, width - 1)]
    return colours
