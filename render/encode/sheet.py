"""Sprite sheets: all frames in one PNG, and a JSON file that game engines read.

The layout is the "JSON hash" that TexturePacker and Aseprite export.
"""

import json
import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from drapery.errors import OutputError
from drapery.output_files import replacing
from drapery.render.encode.delays import frame_delays
from drapery.render.encode.png import png_bytes
from drapery.render.pixels import HasPixels, Pixels

if TYPE_CHECKING:
    from drapery.render.encode.palette import Matte

MAX_SIDE = 16_384  # the largest texture that common graphics hardware takes


def sheet_pixels(frames: Sequence[HasPixels]) -> Pixels:
    """The frames row by row in a sheet about as wide as high. Raises OutputError if too large."""
    height, width = frames[0].pixels.shape[:2]
    columns, rows = grid_of(len(frames), width, height)
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


def sheet_index(frames: Sequence[HasPixels], fps: float, name: str) -> dict[str, Any]:
    """The JSON beside the sheet; `name` is the sheet's file name, durations are in ms."""
    height, width = frames[0].pixels.shape[:2]
    columns, rows = grid_of(len(frames), width, height)
    times, whole = frame_delays(fps, 1000), {"x": 0, "y": 0, "w": width, "h": height}
    return {
        "frames": {
            f"frame_{number:04d}.png": {
                "frame": whole | {"x": number % columns * width, "y": number // columns * height},
                "rotated": False,
                "trimmed": False,
                "spriteSourceSize": whole,
                "sourceSize": {"w": width, "h": height},
                "duration": next(times),
            }
            for number in range(len(frames))
        },
        "meta": {
            "app": "drapery",
            "image": name,
            "format": "RGBA8888",
            "size": {"w": columns * width, "h": rows * height},
            "scale": "1",
            "frameTags": [
                {"name": "loop", "from": 0, "to": len(frames) - 1, "direction": "forward"}
            ],
        },
    }


def write_sheet(
    path: Path, frames: Iterable[HasPixels], fps: float | None, matte: "Matte | None"
) -> None:
    """Write NAME.sheet.png and NAME.sheet.json. Raises OutputError."""
    every = list(frames)
    index = json.dumps(sheet_index(every, fps or 1, path.name), indent=1) + "\n"
    png = png_bytes(sheet_pixels(every))
    with replacing(path) as sheet, replacing(path.with_suffix(".json")) as beside:
        sheet.write_bytes(png)
        beside.write_text(index)


def grid_of(count: int, width: int, height: int) -> tuple[int, int]:
    """Columns and rows for `count` frames in a sheet about as wide as high."""
    columns = min(count, max(1, round(math.sqrt(count * height / width))))
    return columns, -(-count // columns)
