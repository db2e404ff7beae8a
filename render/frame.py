"""Finished pictures: one frame, or an animation of frames."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class Frame:
    """A picture. pixels: sRGB with straight alpha, shape [H, W, 4], uint8, top row first."""

    pixels: Pixels

    def save(self, path: str | Path) -> None:
        """Write the picture; the ending chooses the format. Raises OutputError."""
        from drapery.render.encode import save_frame

        save_frame(self, path)


@dataclass(frozen=True, eq=False)
class Animation:
    """Frames of one size shown at a steady rate [frames/s]; the last is followed by the first."""

    frames: tuple[Frame, ...]
    fps: float

    def __iter__(self) -> Iterator[Frame]:
        return iter(self.frames)

    def __len__(self) -> int:
        return len(self.frames)

    def save(self, path: str | Path) -> None:
        """Write the animation; the ending, or a folder, chooses the format. Raises OutputError."""
        from drapery.render.encode import save_animation

        save_animation(self.frames, self.fps, path)
