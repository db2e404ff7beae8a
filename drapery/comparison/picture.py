"""Pictures to compare: stills and loops, 8 or 16 bits a channel, drawn or from files."""

import math
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageSequence

from drapery.arrays import Channels
from drapery.comparison.files import MAX_PIXELS, opened, picture_bytes
from drapery.errors import OptionError, counted
from drapery.file_formats import LOOP_READERS, READERS
from drapery.picture_pixels import pixels_of, sixteen_bit_pixels
from drapery.render import Animation, Frame


@dataclass(frozen=True, eq=False)
class Picture:
    """A still or a loop.

    frames: at least one, of one size, shape [H, W, 4]; uint16 only for a still of 16 bits.
    delays: how long each frame is shown [s]; empty for a still.
    plays: how often a loop plays; 0 for ever.
    """

    frames: tuple[Channels, ...]
    delays: tuple[float, ...] = ()
    plays: int = 0

    @property
    def size(self) -> tuple[int, int]:
        """Width and height [px]."""
        height, width = self.frames[0].shape[:2]
        return width, height

    def described(self) -> str:
        """The size in words, and for a loop its length and rate."""
        size = f"{self.size[0]}x{self.size[1]}"
        if not self.delays:
            return size
        count = f"{size}, {counted(len(self.frames), 'frame')}"
        rate = 1 / self.delays[0] if self.delays[0] else 0
        if all(math.isclose(delay, self.delays[0], rel_tol=1e-3) for delay in self.delays):
            count += f" at {round(rate, 4):g}/s"
        else:
            count += f" in {sum(self.delays):.4g} s"
        return count if self.plays == 0 else f"{count}, played {times(self.plays)}"


def times(plays: int) -> str:
    """How often a loop plays, in words."""
    return "for ever" if plays == 0 else "once" if plays == 1 else f"{plays} times"


def as_picture(source: Any) -> Picture:
    """A Frame, an Animation, a Pillow image, an array or the path of a file, as a Picture.

    An array is [H, W], [H, W, 3] or [H, W, 4] of uint8 or uint16. An animated Pillow image is a
    loop.

    Raises OptionError for anything else, for a mode without a fixed range of values, and as
    `read_picture`.
    """
    if isinstance(source, Picture):
        return source
    if isinstance(source, Frame):
        return Picture((source.pixels,))
    if isinstance(source, Animation):
        frames = tuple(frame.pixels for frame in source)
        delays = (1 / source.fps,) * len(frames) if len(frames) > 1 else ()
        return Picture(frames, delays)
    if isinstance(source, Image.Image):
        return _of_image(source)
    if isinstance(source, (str, PathLike)):
        return read_picture(Path(source))
    return Picture((_of_array(source),))


def read_picture(path: Path) -> Picture:
    """The picture in a file.

    Raises OptionError for one that cannot be read or is too large.
    """
    return decode_picture(picture_bytes(path), str(path))


def decode_picture(data: bytes, name: str, formats: Sequence[str] = READERS) -> Picture:
    """The picture in a file's bytes.

    data: the bytes.
    name: of the file, in errors.
    formats: names of the formats that are read.

    Raises OptionError for bytes that are no such picture, and for a picture that is too large.
    """
    with opened(data, name, formats) as image:
        count = getattr(image, "n_frames", 1)
        if count * image.width * image.height > MAX_PIXELS:
            raise OptionError(
                f"{name} is {image.width}x{image.height} pixels, {count} times; at most"
                f" {MAX_PIXELS >> 20} million pixels are read: shrink it"
            )
        if count > 1 and image.format in LOOP_READERS:
            return _loop(image)
        deep = sixteen_bit_pixels(image, lambda: opened(data, name, formats))
        return Picture((deep if deep is not None else pixels_of(image, _depth(image, data)),))


def _depth(image: Image.Image, data: bytes) -> int:
    return data[24] if image.format == "PNG" else 8


def _of_image(image: Image.Image) -> Picture:
    if getattr(image, "n_frames", 1) > 1 and image.format in LOOP_READERS:
        place = image.tell()
        try:
            return _loop(image)
        finally:
            image.seek(place)
    if image.mode.startswith("I;16"):
        deep = sixteen_bit_pixels(image, lambda: nullcontext(image))
        if deep is not None:
            return Picture((deep,))
    return Picture((pixels_of(image),))


def _loop(image: Image.Image) -> Picture:
    """All frames of an animated image, as they are shown."""
    frames, delays = [], []
    for frame in _shown_frames(image):
        frames.append(np.array(frame.convert("RGBA")))
        delays.append(float(frame.info.get("duration", 0)) / 1000)
    if len(frames) == 1:
        return Picture((frames[0],))
    return Picture(tuple(frames), tuple(delays), _plays(image))


def _shown_frames(image: Image.Image) -> Iterator[Image.Image]:
    # An APNG may have a picture for programs that play none, which is no frame.
    first = 1 if image.info.get("default_image") else 0
    for number, frame in enumerate(ImageSequence.Iterator(image)):
        if number >= first:
            frame.load()  # WebP tells the time of a frame once it is decoded
            yield frame


def _plays(image: Image.Image) -> int:
    """How often a loop plays; 0 for ever."""
    loop = image.info.get("loop")
    if image.format != "GIF":
        return int(loop or 0)
    if loop is None:
        return 1
    return int(loop) + 1 if loop else 0  # a GIF counts repetitions


def _of_array(source: Any) -> Channels:
    pixels = np.asarray(source)
    if (
        pixels.dtype not in (np.uint8, np.uint16)
        or pixels.ndim not in (2, 3)
        or pixels.shape[2:] not in ((), (3,), (4,))
        or 0 in pixels.shape
    ):
        raise OptionError(
            "a golden picture is a Frame, an Animation, a Pillow image, the path of a picture, or"
            " an array [H, W, 4] of uint8 or uint16;"
            f" this is {type(source).__name__} {pixels.dtype} {list(pixels.shape)}"
        )
    most = np.iinfo(pixels.dtype).max
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[..., None], 3, axis=-1)
    if pixels.shape[2] == 3:
        alpha = np.full((*pixels.shape[:2], 1), most, pixels.dtype)
        pixels = np.concatenate([pixels, alpha], axis=-1)
    return pixels
