"""Scenes written as 3-D files; the ending selects the format.

| ending    | contents                                                                 |
|-----------|--------------------------------------------------------------------------|
| .glb      | meshes, texture and camera; an animation as morph targets                |
| .obj      | the first frame, with NAME.mtl and NAME_texture.png beside it            |
| .ply      | the first frame; colours at its vertices, as the format has no textures  |
| .bbmodel  | the first frame for Blockbench, texture inside                           |
| .geo.json | the first frame as Bedrock geometry, with NAME_texture.png beside it     |
"""

from collections.abc import Callable, Iterable
from contextlib import ExitStack
from importlib import import_module
from itertools import chain, islice
from pathlib import Path
from typing import Any

import numpy as np

from drapery.errors import OptionError
from drapery.render.encode import check_fps
from drapery.render.encode.output import check_writable, replacing
from drapery.render.encode.png import png_bytes
from drapery.render.export.parts import MeshPart, MeshParts, take_apart
from drapery.render.scene import Scene, Texels

Files = dict[str, bytes]
"""The files to write, by name; the target comes last."""

MODEL_ENDINGS = (".glb", ".obj", ".ply", ".bbmodel", ".geo.json")
"""The endings of the 3-D files that `save_model` writes; only .glb holds a motion."""


def save_model(scenes: Scene | Iterable[Scene], path: str | Path, *, fps: float = 20.0) -> None:
    """Write a scene, or the scenes of a loop, as a 3-D file.

    fps: frames/s of a loop. Raises OptionError for an unknown ending and for scenes with different
    meshes, OutputError for a bad target; no partial file remains.
    """
    path = Path(path)
    ending = check_model_target(path)
    check_fps(fps)
    moments = iter([scenes] if isinstance(scenes, Scene) else scenes)
    first = next(moments, None)
    if first is None:
        raise OptionError("there is no scene to write")
    # Only .glb is animated; for the others the later scenes are never made.
    wanted = chain([first], moments if ending == ".glb" else islice(moments, 0))
    parts = take_apart(wanted)
    _write(path, WRITERS[ending](parts, first, fps, path.name[: -len(ending)]))


def check_model_target(path: str | Path) -> str:
    """The ending of a 3-D file. Raises OptionError or OutputError if it cannot be written."""
    path = Path(path)
    for ending in MODEL_ENDINGS:
        if path.name.lower().endswith(ending) and len(path.name) > len(ending):
            check_writable(path)
            return ending
    raise OptionError(f"{path}: the ending of a 3-D file is one of {', '.join(MODEL_ENDINGS)}")


def _write(path: Path, files: Files) -> None:
    """Write all files, or none if one of them cannot be written."""
    with ExitStack() as stack:
        for name, data in files.items():
            stack.enter_context(replacing(path.with_name(name))).write_bytes(data)


def _glb(parts: MeshParts, scene: Scene, fps: float, name: str) -> Files:
    from drapery.render.export.gltf import glb_bytes

    width, height = scene.size
    return {f"{name}.glb": glb_bytes(parts, fps, scene.camera, width / height)}


def _obj(parts: MeshParts, scene: Scene, fps: float, name: str) -> Files:
    from drapery.render.export.obj import obj_files

    return obj_files(parts, name)


def _ply(parts: MeshParts, scene: Scene, fps: float, name: str) -> Files:
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


def _bbmodel(parts: MeshParts, scene: Scene, fps: float, name: str) -> Files:
    from drapery.render.export.blockbench import bbmodel_text

    return {f"{name}.bbmodel": bbmodel_text(parts, name).encode()}


def _bedrock(parts: MeshParts, scene: Scene, fps: float, name: str) -> Files:
    from drapery.render.export.blockbench import bedrock_text

    texture = f"{name}_texture.png"
    return {
        texture: png_bytes(parts.atlas),
        f"{name}.geo.json": bedrock_text(parts, name).encode(),
    }


WRITERS: dict[str, Callable[[MeshParts, Scene, float, str], Files]] = {
    ".glb": _glb,
    ".obj": _obj,
    ".ply": _ply,
    ".bbmodel": _bbmodel,
    ".geo.json": _bedrock,
}


def _library(name: str) -> Any:
    """A module of trimesh, imported when it is needed; parts of it have no types."""
    return import_module(name)


def _vertex_colours(part: MeshPart, atlas: Texels) -> Texels:
    """The texel at each vertex, shape [V, 4]; opaque if the part is opaque."""
    height, width = atlas.shape[:2]
    x, y = (part.uvs * [width, height]).astype(np.int64).T
    colours: Texels = atlas[np.minimum(y, height - 1), np.minimum(x, width - 1)]
    return colours
