"""Sprite sheets: all frames in one PNG, and a JSON file that game engines read.

The layout is the "JSON hash" that TexturePacker and Aseprite export.
"""

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate, islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from drapery.arrays import HasPixels, Pixels
from drapery.errors import OptionError, OutputError
from drapery.file_formats import MAX_FPS, frame_delays
from drapery.output_files import replacing
from drapery.render.encode import check_sheet
from drapery.render.encode.png import png_bytes

if TYPE_CHECKING:
    from drapery.render.encode.palette import Matte

MAX_SIDE = 16_384  # the largest texture that common graphics hardware takes


def sheet_pixels(frames: Sequence[HasPixels], columns: int) -> Pixels:
    """The frames row by row, in columns. Raises OutputError if the sheet is too large."""
    height, width = frames[0].pixels.shape[:2]
    rows = -(-len(frames) // columns)
    if max(columns * width, rows * height) > MAX_SIDE:
        raise OutputError(
            f"{len(frames)} frames of {width}x{height} make a sheet of {columns * width}x"
            f"{rows * height}, over {MAX_SIDE}; use smaller or fewer frames, or a frames/ folder"
        )
    sheet = np.zeros((rows * height, columns * width, 4), np.uint8)
    for number, frame in enumerate(frames):
        left, top = number % columns * width, number // columns * height
        sheet[top : top + height, left : left + width] = frame.pixels
    return sheet


def sheet_index(
    frames: Sequence[HasPixels], columns: int, fps: float, name: str, tags: Mapping[str, int]
) -> dict[str, Any]:
    """The JSON beside the sheet.

    columns: frames in a row. name: the sheet's file name. tags: loops that follow each other, and
    the number of frames of each. Durations are in ms.
    """
    height, width = frames[0].pixels.shape[:2]
    whole = {"x": 0, "y": 0, "w": width, "h": height}
    ends = list(accumulate(tags.values()))
    delays = [each for count in tags.values() for each in islice(frame_delays(fps, 1000), count)]
    return {
        "frames": {
            f"frame_{number:04d}.png": {
                "frame": whole | {"x": number % columns * width, "y": number // columns * height},
                "rotated": False,
                "trimmed": False,
                "spriteSourceSize": whole,
                "sourceSize": {"w": width, "h": height},
                "duration": delay,
            }
            for number, delay in enumerate(delays)
        },
        "meta": {
            "app": "drapery",
            "image": name,
            "format": "RGBA8888",
            "size": {"w": columns * width, "h": -(-len(frames) // columns) * height},
            "scale": "1",
            "frameTags": [
                {"name": tag, "from": end - count, "to": end - 1, "direction": "forward"}
                for (tag, count), end in zip(tags.items(), ends, strict=True)
            ],
        },
    }


def write_sheet(
    path: Path, frames: Iterable[HasPixels], fps: float | None, matte: "Matte | None"
) -> None:
    """Write NAME.sheet.png and NAME.sheet.json, about as wide as high. Raises OutputError."""
    every = list(frames)
    height, width = every[0].pixels.shape[:2]
    columns = columns_of(len(every), width, height)
    _write(path, every, columns, fps or 1, {"loop": len(every)})


def save_sprites(loops: Mapping[str, Sequence[HasPixels]], fps: float, path: str | Path) -> None:
    """Write loops as one sprite sheet, each in a row of its own, and the JSON beside it.

    loops: frames of one size by name, equally many in each; the names are tags in the JSON.
    fps: [frames/s], above 0.
    path: the sheet, whose name ends with `.sheet.png`.

    Raises OptionError for another name, and for loops that differ in size or number, OutputError
    for a sheet that is too large or cannot be written.
    """
    target = check_sheet(path)
    sizes = {(len(frames), *frame.pixels.shape) for frames in loops.values() for frame in frames}
    if len(sizes) != 1 or not all(loops.values()):
        raise OptionError("loops of a sprite sheet differ in number or size of frames")
    if not (math.isfinite(fps) and 0 < fps <= MAX_FPS):
        raise OptionError(f"fps {fps:g}: give a number above 0, up to {MAX_FPS}")
    tags = {name: len(frames) for name, frames in loops.items()}
    every = [frame for frames in loops.values() for frame in frames]
    _write(target, every, max(tags.values()), fps, tags)


def _write(
    path: Path, frames: Sequence[HasPixels], columns: int, fps: float, tags: Mapping[str, int]
) -> None:
    index = json.dumps(sheet_index(frames, columns, fps, path.name, tags), indent=1) + "\n"
    png = png_bytes(sheet_pixels(frames, columns))
    with replacing(path) as sheet, replacing(path.with_suffix(".json")) as beside:
        sheet.write_bytes(png)
        beside.write_text(index)


def columns_of(count: int, width: int, height: int) -> int:
    """Columns for `count` frames in a sheet about as wide as high."""
    return min(count, max(1, round(math.sqrt(count * height / width))))
