"""Numbered PNG frames in a folder.

A run replaces all frame_NNNN.png files of the folder and changes no other files. The frames are
first written to a hidden folder beside the target and moved at the end, so a failed run changes
nothing. A run that is stopped by Ctrl-C moves the finished frames, unless the folder has frames of
an earlier run; those then remain unchanged.
"""

import os
import re
import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from drapery.arrays import HasPixels
from drapery.errors import OutputError
from drapery.output_files import check_writable, explained, partial_path
from drapery.render.encode.ahead import encode_ahead
from drapery.render.encode.png import png_bytes

if TYPE_CHECKING:
    from drapery.render.encode.palette import Matte

FRAME_NAME = re.compile(r"frame_\d{4,}\.png")


def write_sequence(
    folder: Path, frames: Iterable[HasPixels], fps: float | None, matte: "Matte | None"
) -> None:
    """Write frame_0000.png and so on. Raises OutputError if the folder cannot be written."""
    check_folder(folder)
    gathering = partial_path(folder)
    try:
        with explained(folder):
            shutil.rmtree(gathering, ignore_errors=True)
            gathering.mkdir()
            try:
                _gather(gathering, frames)
            except KeyboardInterrupt:
                if not _own_frames(folder):
                    _move_in(gathering, folder)
                raise
            _move_in(gathering, folder)
    finally:
        shutil.rmtree(gathering, ignore_errors=True)


def check_folder(folder: Path) -> None:
    """Raise OutputError for a folder that cannot be written, before anything is drawn."""
    if not folder.is_dir():
        if folder.exists():
            raise OutputError(f"cannot write frames into {folder}: it is a file; choose a folder")
        check_writable(folder)
    elif not os.access(folder, os.W_OK | os.X_OK):
        raise OutputError(f"cannot write frames into {folder}: it may not be written to")


def _gather(gathering: Path, frames: Iterable[HasPixels]) -> None:
    files = encode_ahead(frames, lambda frame: png_bytes(frame.pixels))
    for number, png in enumerate(files):
        path = gathering / f"frame_{number:04d}.png"
        unfinished = path.with_suffix(".part")
        unfinished.write_bytes(png)
        unfinished.replace(path)


def _own_frames(folder: Path) -> list[Path]:
    if not folder.is_dir():
        return []
    return [path for path in folder.iterdir() if FRAME_NAME.fullmatch(path.name)]


def _move_in(gathering: Path, folder: Path) -> None:
    fresh = sorted(path.name for path in gathering.glob("*.png"))
    if not fresh:
        return
    if not folder.is_dir():
        for unfinished in gathering.glob("*.part"):
            unfinished.unlink()
        gathering.rename(folder)
        return
    for stale in _own_frames(folder):
        if stale.name not in fresh:
            stale.unlink()
    for name in fresh:
        (gathering / name).replace(folder / name)
