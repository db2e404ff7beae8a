"""Finished pictures: one frame, or an animation of frames."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from drapery.arrays import Pixels

__all__ = ["Animation", "Frame", "Pixels"]


@dataclass(frozen=True, eq=False)
class Frame:
    """A finished picture. pixels: sRGB, straight alpha, shape [H, W, 4], uint8, top row first."""

    pixels: Pixels

    def save(self, path: str | Path, *, quality: int | None = None) -> None:
        """Write the picture in the format of the name's ending, see `drapery.file_formats`.

        quality: of a WebP or AVIF that may lose something, 1 to 100.
        Raises OptionError for an ending or a size that no format of pictures has, and for a quality
        that does nothing, OutputError for a file that cannot be written.
        """
        from drapery.render.encode import save_frame

        save_frame(self, path, quality=quality)


@dataclass(frozen=True, eq=False)
class Animation:
    """Frames of one size, shown in a loop.

    frames: at least one, in order. fps: frames/s, above 0.
    """

    frames: tuple[Frame, ...]
    fps: float

    def __iter__(self) -> Iterator[Frame]:
        return iter(self.frames)

    def __len__(self) -> int:
        return len(self.frames)

    def save(self, path: str | Path, *, quality: int | None = None) -> None:
        """Write the animation in the format of the name's ending, see `drapery.file_formats`.

        quality: of a WebP or AVIF that may lose something, 1 to 100.
        Raises OptionError for an ending or a rate that no such format has and for no frames,
        OutputError for a target that cannot be written, BackendError for a video without PyAV.
        """
        from drapery.render.encode import save_animation

        save_animation(self.frames, self.fps, path, quality=quality)
