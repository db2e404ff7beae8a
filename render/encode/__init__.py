"""Frames written as files; the ending selects the format.

| target                 | contents                                                             |
|------------------------|----------------------------------------------------------------------|
| .png .webp             | a still, lossless                                                    |
| .apng (.png) .webp     | an animation, lossless, with alpha                                   |
| .gif                   | up to 255 colours exact, one bit of alpha                            |
| .mp4 .webm             | a video (extra `video`); WebM has alpha, MP4 a white background      |
| .sheet.png             | all frames in one PNG, and NAME.sheet.json beside it                 |
| folder/, or no ending  | frame_0000.png and so on                                             |

Every animation loops forever. The same frames give the same bytes. A file is replaced as a whole,
or not at all if writing fails.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sized
from functools import partial
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from drapery.errors import OptionError
from drapery.render.encode.output import check_writable, replacing

if TYPE_CHECKING:
    from drapery.render.encode.palette import Matte
    from drapery.render.pixels import HasPixels

Progress = Callable[[int, int | None], None]
Writer = Callable[[BinaryIO, "Iterable[HasPixels]"], None]

STILL_ENDINGS = (".png", ".apng", ".webp", ".gif")
ANIMATION_ENDINGS = (".gif", ".apng", ".png", ".webp", ".mp4", ".webm", ".sheet.png")
MAX_FPS = 1000


def save_frame(frame: "HasPixels", path: str | Path, *, matte: "Matte | None" = None) -> None:
    """Write one picture as PNG, lossless WebP or GIF.

    matte: in a GIF, the colour behind half-transparent pixels; with None, pixels of at least half
    alpha become opaque. Raises OptionError for an unknown ending, OutputError for a bad target.
    """
    path = Path(path)
    ending = check_still_target(path)
    with replacing(path) as partial_file, partial_file.open("wb") as file:
        if ending == ".gif":
            from drapery.render.encode.gif import write_gif

            write_gif(file, [frame], 1, matte)
        else:
            file.write(_still_bytes(frame, ending))


def save_animation(
    frames: "Iterable[HasPixels]",
    fps: float,
    path: str | Path,
    *,
    matte: "Matte | None" = None,
    total: int | None = None,
    progress: Progress | None = None,
) -> None:
    """Write frames as they come; each is encoded while the next ones are drawn.

    fps: frames/s, above 0. matte: as for `save_frame`; in a video it is the background (default:
    white). progress: called with the number of frames drawn and `total`, by default len(frames).
    Raises OptionError for an unknown ending, for no frames and for frames of several sizes,
    OutputError for a bad target, BackendError if PyAV is missing. No error leaves a partial file;
    KeyboardInterrupt leaves the finished frames in a folder that had no frames before.
    """
    kind = check_animation_target(path)
    check_fps(fps)
    if total is None and isinstance(frames, Sized):
        total = len(frames)
    _write(kind, Path(path), _checked(frames, total, progress), fps, matte)


def check_still_target(path: str | Path) -> str:
    """The ending of a picture's file. Raises OptionError or OutputError if it cannot be written."""
    path = Path(path)
    if path.suffix.lower() not in STILL_ENDINGS and not path.is_dir():
        raise OptionError(f"{path}: the ending of a picture is one of {', '.join(STILL_ENDINGS)}")
    check_writable(path)
    return path.suffix.lower()


def check_animation_target(path: str | Path) -> str:
    """The ending of an animation's file, or "/" for a folder of frames.

    Raises OptionError or OutputError if it cannot be written, before anything is drawn.
    """
    folder, path = str(path).endswith(("/", "\\")), Path(path)
    if folder or path.is_dir() or not path.suffix:
        from drapery.render.encode.sequence import check_folder

        check_folder(path)
        return "/"
    for ending in sorted(ANIMATION_ENDINGS, key=len, reverse=True):
        if path.name.lower().endswith(ending):
            check_writable(path)
            return ending
    raise OptionError(
        f"{path}: the ending of an animation is one of {', '.join(ANIMATION_ENDINGS)}, "
        "or / for a folder of frames"
    )


def check_fps(fps: float) -> None:
    if not (math.isfinite(fps) and 0 < fps <= MAX_FPS):
        raise OptionError(f"fps {fps}: give a number above 0, up to {MAX_FPS}")


def _checked(
    frames: "Iterable[HasPixels]", total: int | None, progress: Progress | None
) -> "Iterator[HasPixels]":
    rest = iter(frames)
    first = next(rest, None)
    if first is None:
        raise OptionError("an animation needs at least one frame; ask for more seconds")
    for number, frame in enumerate(chain([first], rest)):
        if frame.pixels.shape != first.pixels.shape:
            (height, width), (high, wide) = frame.pixels.shape[:2], first.pixels.shape[:2]
            raise OptionError(f"frame {number} is {width}x{height}, the first {wide}x{high}")
        yield frame
        if progress is not None:
            progress(number + 1, total)


def _still_bytes(frame: "HasPixels", ending: str) -> bytes:
    if ending == ".webp":
        from drapery.render.encode.webp import webp_bytes

        return webp_bytes(frame.pixels)
    from drapery.render.encode.png import png_bytes

    return png_bytes(frame.pixels)


def _write(
    kind: str, path: Path, frames: "Iterator[HasPixels]", fps: float, matte: "Matte | None"
) -> None:
    if kind == "/":
        from drapery.render.encode.sequence import write_sequence

        write_sequence(path, frames)
    elif kind == ".sheet.png":
        from drapery.render.encode.sheet import write_sheet

        write_sheet(path, list(frames), fps)
    elif kind in (".mp4", ".webm"):
        from drapery.render.encode.video import load_av, write_video

        load_av()
        with replacing(path) as unfinished:
            write_video(unfinished, kind, frames, fps, matte)
    else:
        with replacing(path) as unfinished, unfinished.open("wb") as file:
            _writer(kind, fps, matte)(file, frames)


def _writer(kind: str, fps: float, matte: "Matte | None") -> Writer:
    if kind == ".gif":
        from drapery.render.encode.gif import write_gif

        return partial(write_gif, fps=fps, matte=matte)
    if kind == ".webp":
        from drapery.render.encode.webp import write_webp

        return partial(write_webp, fps=fps)
    from drapery.render.encode.png import write_apng

    return partial(write_apng, fps=fps)
