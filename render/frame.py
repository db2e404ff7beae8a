"""Finished pictures: one frame, or an animation of frames."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from drapery.arrays import Pixels
from drapery.errors import OptionError

__all__ = ["Animation", "Frame", "Pixels", "enlarge"]

MAX_SIDE = 16384


@dataclass(frozen=True, eq=False)
class Frame:
    """A finished picture. pixels: sRGB, straight alpha, shape [H, W, 4], uint8, top row first."""

    pixels: Pixels

    def save(self, path: str | Path, *, quality: int | None = None) -> None:
        """Write the picture in the format of the name's ending, see `drapery.file_formats`.

        path: the file to write.
        quality: of a WebP or AVIF that may lose something, 1 to 100.

        Raises OptionError for an ending or a size that no format of pictures has, and for a quality
        that does nothing, OutputError for a file that cannot be written.
        """
        from drapery.render.encode import save_frame

        save_frame(self, path, quality=quality)


@dataclass(frozen=True, eq=False)
class Animation:
    """Frames of one size, shown in a loop.

    frames: at least one, in order.
    fps: [frames/s], above 0.
    """

    frames: tuple[Frame, ...]
    fps: float

    def __iter__(self) -> Iterator[Frame]:
        return iter(self.frames)

    def __len__(self) -> int:
        return len(self.frames)

    def save(self, path: str | Path, *, quality: int | None = None) -> None:
        """Write the animation in the format of the name's ending, see `drapery.file_formats`.

        path: the file to write.
        quality: of a WebP or AVIF that may lose something, 1 to 100.

        Raises OptionError for an ending or a rate that no such format has and for no frames,
        OutputError for a target that cannot be written, BackendError for a video without PyAV.
        """
        from drapery.render.encode import save_animation

        save_animation(self.frames, self.fps, path, quality=quality)


def enlarge(frame: Frame, times: int) -> Frame:
    """The frame with each pixel as a square of times x times pixels.

    Raises OptionError if the result would be wider or higher than MAX_SIDE.
    """
    height, width = frame.pixels.shape[:2]
    if times < 1 or max(height, width) * times > MAX_SIDE:
        raise OptionError(
            f"a picture of {width}x{height} cannot be enlarged {times} times;"
            f" use 1 to {max(1, MAX_SIDE // max(height, width))}"
        )
    return Frame(frame.pixels.repeat(times, axis=0).repeat(times, axis=1))
