"""Frames written as files; the ending selects the format, see `drapery.file_formats`.

Every animation loops forever. The same frames give the same bytes. A file is replaced as a whole,
or not at all if writing fails.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sized
from functools import partial
from importlib import import_module
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drapery.errors import OptionError, shown
from drapery.file_formats import FORMATS, FileFormat, Kind, format_of, formats_of
from drapery.output_files import check_writable, replacing

if TYPE_CHECKING:
    from drapery.arrays import HasPixels
    from drapery.render.encode.palette import Matte

SHEET = ".sheet.png"
Progress = Callable[[int, int | None], None]


def save_frame(
    frame: "HasPixels",
    path: str | Path,
    *,
    matte: "Matte | None" = None,
    quality: int | None = None,
) -> None:
    """Write one picture.

    frame: the picture.
    path: the file; its ending selects the format.
    matte: in a format whose pixels are opaque or have no colour, the colour behind half-transparent
        pixels; with None, those of at least half alpha become opaque.
    quality: of a format that may lose something, 1 to 100; with None WebP loses nothing, AVIF a
        little.

    Raises OptionError for an unknown ending, a matte or quality that does nothing and a picture
    that is too large for the format, OutputError for a bad target.
    """
    format = check_target(path, "still")
    _check_matte(format, matte, "still")
    check_quality(format, quality)
    _write(format, Path(path), _checked([frame], format, "still"), None, matte, quality)


def save_animation(
    frames: "Iterable[HasPixels]",
    fps: float,
    path: str | Path,
    *,
    matte: "Matte | None" = None,
    quality: int | None = None,
    total: int | None = None,
    progress: Progress | None = None,
) -> None:
    """Write frames as they come; each is encoded while the next ones are drawn.

    No error leaves a partial file; KeyboardInterrupt leaves the finished frames in a folder that
    had no frames before.

    frames: at least one, of one size.
    fps: [frames/s], above 0.
    path: the file, or a folder of frames; its ending selects the format.
    matte: as for `save_frame`; in a video it is the background (default: white).
    quality: as for `save_frame`.
    total: number of the frames, for `progress`; by default len(frames).
    progress: called with the number of frames drawn and `total`.

    Raises OptionError as `save_frame`, for no frames, frames of several sizes and more frames/s
    than the format has, OutputError for a bad target, BackendError if PyAV is missing.
    """
    format = check_target(path, "loop")
    _check_matte(format, matte, "loop")
    check_quality(format, quality)
    check_fps(fps, format)
    if total is None and isinstance(frames, Sized):
        total = len(frames)
    counted = _counted(_checked(frames, format, "loop"), total, progress)
    _write(format, Path(path), counted, fps, matte, quality)


def check_target(path: str | Path, *kinds: Kind) -> FileFormat:
    """The format of a file that is to hold one of some kinds, before anything is drawn.

    Raises OptionError for an ending that no file of these kinds has, OutputError for a place that
    cannot be written.
    """
    format = format_of(path, *kinds)
    if format.ending == "/":
        from drapery.render.encode.sequence import check_folder

        check_folder(Path(path))
    else:
        check_writable(Path(path))
    return format


def check_sheet(path: str | Path) -> Path:
    """The path of a sprite sheet, before anything is drawn. Raises errors as `check_target`."""
    target = Path(path)
    if check_target(target, "loop").ending != SHEET:
        raise OptionError(f"{shown(target.name)} is no sprite sheet; end the name with {SHEET}")
    return target


def check_fps(fps: float, format: FileFormat) -> None:
    """Raise OptionError for a rate [frames/s] that a format does not have."""
    most = format.max_fps
    if math.isfinite(fps) and 0 < fps <= most:
        return
    faster = [
        each.ending
        for each in formats_of("loop")
        if most < fps <= each.max_fps and each.kind() == "loop"
    ]
    remedy = f"give a number above 0, up to {most}"
    if faster:
        remedy = f"{format.name} shows at most {most}; use {' or '.join(faster[:2])}"
    raise OptionError(f"fps {fps:g}: {remedy}")


def check_quality(format: FileFormat, quality: int | None) -> None:
    """Raise OptionError for a quality that a format does not have."""
    if quality is None:
        return
    if not format.lossy:
        used = ", ".join(each.name for each in FORMATS if each.lossy)
        raise OptionError(
            f"quality does nothing for {format.name}; leave it out (it is for {used})"
        )
    if isinstance(quality, bool) or quality not in range(1, 101):
        raise OptionError(f"quality {quality!r} is not a whole number from 1 to 100; give one")


def writer_of(format: FileFormat) -> Any:
    """The function that writes a format."""
    module, _, name = format.writer.rpartition(".")
    return getattr(import_module(f"drapery.render.{module}"), name)


def _check_matte(format: FileFormat, matte: "Matte | None", kind: Kind) -> None:
    if matte is not None and not format.matte:
        used = ", ".join(each.name for each in formats_of(kind) if each.matte)
        raise OptionError(
            f"matte does nothing for {format.name}, which keeps transparency; leave it out"
            f" (it is for {used})"
        )


def _write(
    format: FileFormat,
    path: Path,
    frames: "Iterator[HasPixels]",
    fps: float | None,
    matte: "Matte | None",
    quality: int | None,
) -> None:
    """Write a loop, or a still if there is no rate."""
    write = writer_of(format)
    if quality is not None:
        write = partial(write, quality=quality)
    if format.single:
        with replacing(path) as unfinished:
            write(unfinished, frames, fps, matte)
    else:
        write(path, frames, fps, matte)


def _checked(
    frames: "Iterable[HasPixels]", format: FileFormat, kind: Kind
) -> "Iterator[HasPixels]":
    """Frames of one size, which the format can have."""
    rest = iter(frames)
    first = next(rest, None)
    if first is None:
        raise OptionError("an animation needs at least one frame; ask for more seconds")
    (height, width) = first.pixels.shape[:2]
    if format.max_side and max(width, height) > format.max_side:
        larger = [each.ending for each in formats_of(kind) if not each.max_side and each.single]
        raise OptionError(
            f"{width}x{height} pixels are too many for {format.name}, which has at most"
            f" {format.max_side} a side; use {larger[0]}"
        )
    for number, frame in enumerate(chain([first], rest)):
        if frame.pixels.shape != first.pixels.shape:
            high, wide = frame.pixels.shape[:2]
            raise OptionError(f"frame {number} is {wide}x{high}, the first {width}x{height}")
        yield frame


def _counted(
    frames: "Iterator[HasPixels]", total: int | None, progress: Progress | None
) -> "Iterator[HasPixels]":
    for number, frame in enumerate(frames, 1):
        yield frame
        if progress is not None:
            progress(number, total)
