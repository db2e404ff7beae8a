"""Scenes written as 3-D files; the ending selects the format, see `drapery.file_formats`."""

from collections.abc import Iterable
from contextlib import ExitStack
from itertools import chain, islice
from pathlib import Path

from drapery.errors import OptionError
from drapery.render.encode import check_fps, check_target, writer_of
from drapery.render.encode.output import replacing
from drapery.render.export.parts import take_apart
from drapery.render.scene import Scene


def save_model(scenes: Scene | Iterable[Scene], path: str | Path, *, fps: float = 20.0) -> None:
    """Write a scene, or the scenes of a loop, as a 3-D file.

    fps: frames/s of a loop. Raises OptionError for an unknown ending and for scenes with different
    meshes, OutputError for a bad target; no partial file remains.
    """
    path = Path(path)
    format = check_target(path, "model")
    check_fps(fps, format)
    moments = iter([scenes] if isinstance(scenes, Scene) else scenes)
    first = next(moments, None)
    if first is None:
        raise OptionError("there is no scene to write")
    # The later scenes of a loop are made only for a format that holds motion.
    parts = take_apart(chain([first], moments if format.moving else islice(moments, 0)))
    _write(path, writer_of(format)(parts, first, fps, path.name[: -len(format.ending)]))


def _write(path: Path, files: dict[str, bytes]) -> None:
    """Write all files, by name and the target last, or none if one of them cannot be written."""
    with ExitStack() as stack:
        for name, data in files.items():
            stack.enter_context(replacing(path.with_name(name))).write_bytes(data)
