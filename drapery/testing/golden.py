"""Golden files, and whether a picture or a loop agrees with one."""

import hashlib
import io
import json
import math
import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageSequence, PngImagePlugin

from drapery.comparison import Tolerance, measure, seen
from drapery.errors import DraperyError, OptionError
from drapery.picture_file import opened_picture
from drapery.render import Animation, Frame, apng_bytes

LAYERS_KEY = "drapery:layers"
MAX_SIDE = 16384
MAX_PIXELS = MAX_SIDE**2
"""The most pixels in all frames of a loop."""
_AFTER_HEADER = 33
"""Where the second chunk of a PNG begins [bytes]."""

Picture = Frame | Animation
"""What a golden holds: a still or a loop."""


class GoldenError(DraperyError):
    """A golden file that cannot be used."""


def as_frame(picture: Any) -> Frame:
    """A Frame, a Pillow image, or an array [H, W], [H, W, 3] or [H, W, 4] of uint8, as a Frame.

    Raises OptionError for anything else.
    """
    if isinstance(picture, Frame):
        return picture
    if isinstance(picture, Image.Image):
        return Frame(np.asarray(picture.convert("RGBA")))
    pixels = np.asarray(picture)
    if (
        pixels.dtype != np.uint8
        or pixels.ndim not in (2, 3)
        or pixels.shape[2:] not in ((), (3,), (4,))
    ):
        raise OptionError(
            f"a golden picture is a Frame, a Pillow image or a uint8 array [H, W, 4];"
            f" this is {type(picture).__name__} {pixels.dtype} {list(pixels.shape)}"
        )
    mode = {(): "L", (3,): "RGB", (4,): "RGBA"}[pixels.shape[2:]]
    return Frame(np.asarray(Image.fromarray(pixels, mode).convert("RGBA")))


def encode(picture: Picture, layers: list[dict[str, str]] | None = None) -> bytes:
    """The bytes of a golden file: a PNG, or an APNG for a loop.

    layers: of the design, as a note in the file.
    """
    text = None if layers is None else json.dumps(layers)
    if isinstance(picture, Animation):
        data = apng_bytes(picture.frames, picture.fps)
        return data if text is None else _with_note(data, text)
    note = PngImagePlugin.PngInfo()
    if text is not None:
        note.add_text(LAYERS_KEY, text, zip=True)
    buffer = io.BytesIO()
    Image.fromarray(picture.pixels).save(buffer, "PNG", pnginfo=note)
    return buffer.getvalue()


def decode(data: bytes) -> tuple[Picture, list[dict[str, str]] | None]:
    """The picture and the layers in a golden file. Raises GoldenError."""
    try:
        limits = {"max_pixels": MAX_SIDE * MAX_SIDE, "max_side": MAX_SIDE}
        with opened_picture(data, "the golden", ("PNG",), **limits) as image:
            assert isinstance(image, PngImagePlugin.PngImageFile)
            count = image.n_frames
            if max(image.size) > MAX_SIDE or count * image.width * image.height > MAX_PIXELS:
                raise GoldenError(
                    f"the golden is {image.width}x{image.height} pixels, {count} times"
                )
            if image.mode != "RGBA":
                raise GoldenError(f"the golden's mode is {image.mode}, not RGBA")
            if count > 1:
                note = image.info.get(LAYERS_KEY)  # `text` would decode all frames once more
                picture: Picture = _loop(image)
            else:
                picture = Frame(np.asarray(image))
                note = image.text.get(LAYERS_KEY)
    except GoldenError:
        raise
    except Exception as error:  # Pillow raises errors of many types for a broken file
        raise GoldenError(f"the golden is not a readable PNG ({error})") from error
    return picture, _layers(note) if note else None


def _loop(image: PngImagePlugin.PngImageFile) -> Animation:
    milliseconds = float(image.info["duration"])
    frames = tuple(Frame(np.array(each)) for each in ImageSequence.Iterator(image))
    return Animation(frames, round(1000 / milliseconds, 4))


def _with_note(png: bytes, text: str) -> bytes:
    """A PNG with a compressed text after its header ("PNG Specification", section 11.3.3.3)."""
    chunk = b"zTXt" + LAYERS_KEY.encode() + bytes(2) + zlib.compress(text.encode("latin-1"))
    whole = struct.pack(">I", len(chunk) - 4) + chunk + struct.pack(">I", zlib.crc32(chunk))
    return png[:_AFTER_HEADER] + whole + png[_AFTER_HEADER:]


def _layers(note: str) -> list[dict[str, str]] | None:
    """The layers in a golden's note; None if another program has changed the note."""
    try:
        layers = json.loads(note)
    except (ValueError, RecursionError):
        return None
    whole = isinstance(layers, list) and all(
        isinstance(layer, dict) and all(isinstance(layer.get(key), str) for key in ("name", "face"))
        for layer in layers
    )
    return layers if whole else None


def fingerprint(picture: Picture) -> bytes:
    """The golden of the hash mode: one line with size and SHA-256 of the pixels.

    The colour of transparent pixels does not count, as in a comparison.
    """
    digest = hashlib.sha256(seen(stacked(picture)).tobytes()).hexdigest()
    return f"{size_of(picture)} sha256:{digest}\n".encode()


def agrees(expected: Picture, actual: Picture, tolerance: Tolerance) -> bool:
    """Whether a picture is within the tolerance of its golden."""
    return beyond(expected, actual, tolerance) == 0


def beyond(expected: Picture, actual: Picture, tolerance: Tolerance) -> float:
    """How many pixels are beyond the tolerance; 0 if the pictures agree.

    It is infinite if their sizes differ.
    """
    if not same_size(expected, actual):
        return math.inf
    frames = [
        measure(old.pixels, new.pixels, tolerance)
        for old, new in zip(frames_of(expected), frames_of(actual), strict=True)
    ]
    if all(frame.agrees for frame in frames):
        return 0
    return float(sum(frame.beyond for frame in frames)) or math.inf


def frames_of(picture: Picture) -> tuple[Frame, ...]:
    """The frames of a loop, or a still as the only one."""
    return picture.frames if isinstance(picture, Animation) else (picture,)


def stacked(picture: Picture) -> NDArray[np.uint8]:
    """The pixels of all frames, shape [frames, H, W, 4]."""
    return np.stack([frame.pixels for frame in frames_of(picture)])


def same_size(a: Picture, b: Picture) -> bool:
    """Whether two pictures have the same size, and loops the same frames a second too."""
    if stacked(a).shape != stacked(b).shape:
        return False
    # A file holds the time of a frame as a fraction of small numbers.
    rates = [each.fps for each in (a, b) if isinstance(each, Animation) and len(each) > 1]
    return len(rates) < 2 or math.isclose(*rates, rel_tol=1e-3)


def size_of(picture: Picture) -> str:
    """The size of a picture in words, and for a loop its length and rate."""
    height, width = frames_of(picture)[0].pixels.shape[:2]
    size = f"{width}x{height}"
    if not isinstance(picture, Animation) or len(picture) == 1:
        return size
    return f"{size}, {len(picture)} frames at {picture.fps:g}/s"
