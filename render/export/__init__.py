"""Scenes written as 3-D files; the ending selects the format, see `drapery.file_formats`."""

from collections.abc import Iterable
from contextlib import ExitStack
from dataclasses import replace
from itertools import chain, islice
from pathlib import Path

import numpy as np

from drapery.errors import OptionError
from drapery.mesh import Array
from drapery.output_files import replacing
from drapery.render.camera import Vector
from drapery.render.encode import check_fps, check_target, writer_of
from drapery.render.export.parts import take_apart
from drapery.render.scene import Model, RiggedModel, Scene


def save_scenes(
    scenes: Scene | Iterable[Scene],
    path: str | Path,
    *,
    fps: float = 20.0,
    origin: Vector = (0.0, 0.0, 0.0),
) -> None:
    """Write a scene, or the scenes of a loop, as a 3-D file; no error leaves a partial file.

    scenes: one, or those of a loop, of equal meshes.
    path: the file; its ending selects the format.
    fps: [frames/s] of a loop.
    origin: the place in the scene that is the file's origin [m].

    Raises OptionError for an unknown ending, for models without a scene, for scenes with different
    meshes and for a loop of more poses than the format has, OutputError for a bad target.
    """
    path = Path(path)
    format = check_target(path, "model")
    check_fps(fps, format)
    given = scenes if isinstance(scenes, Iterable) else [scenes]
    moments = (_shifted(_checked(scene), origin) for scene in given)
    first = next(moments, None)
    if first is None:
        raise OptionError("there is no scene to write")
    # The later scenes of a loop are made only for a format that holds motion.
    parts = take_apart(chain([first], moments if format.moving else islice(moments, 0)))
    _write(path, writer_of(format)(parts, first, fps, path.name[: -len(format.ending)]))


def _checked(scene: Scene) -> Scene:
    """Refuse what is no scene. A file of several scenes is a loop, so models need one to be in."""
    if not isinstance(scene, Scene):
        raise OptionError(
            f"save_scenes writes scenes, not a {type(scene).__name__}: put models into one by "
            "`Scene((model,), camera)`"
        )
    return scene


def _shifted(scene: Scene, origin: Vector) -> Scene:
    """The scene with another place at its origin."""
    if not any(origin):
        return scene
    camera, by = scene.camera, -np.asarray(origin)
    x, y, z = origin

    def less(place: Vector) -> Vector:
        return place[0] - x, place[1] - y, place[2] - z

    return replace(
        scene,
        models=tuple(_shifted_model(model, by) for model in scene.models),
        camera=replace(camera, position=less(camera.position), target=less(camera.target)),
    )


def _shifted_model(model: Model, by: Array) -> Model:
    mesh = replace(model.mesh, positions=model.mesh.positions + by)
    if isinstance(model, RiggedModel):
        return replace(model, mesh=mesh, places=model.places + by)
    return replace(model, mesh=mesh)


def _write(path: Path, files: dict[str, bytes]) -> None:
    """Write all files, by name and the target last, or none if one of them cannot be written."""
    with ExitStack() as stack:
        for name, data in files.items():
            stack.enter_context(replacing(path.with_name(name))).write_bytes(data)
