"""Golden files, and whether a picture agrees with one."""

import hashlib
import io
import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from PIL import Image, PngImagePlugin

from drapery.comparison import errors
from drapery.errors import DraperyError, OptionError
from drapery.render import Frame

LAYERS_KEY = "drapery:layers"
MAX_SIDE = 16384


class GoldenError(DraperyError):
    """A golden file that cannot be used."""


@dataclass(frozen=True)
class Tolerance:
    """How far a picture may differ from its golden; by default not at all.

    channel: channel errors up to this value, 0..255, do not count.
    pixels: the number of pixels that may have larger errors, 0 or more.
    Raises OptionError for numbers out of range.
    """

    channel: int = 0
    pixels: int = 0

    def __post_init__(self) -> None:
        if not (0 <= self.channel <= 255 and self.pixels >= 0):
            raise OptionError(
                f"tolerance {self.channel} of {self.pixels} pixels is out of range;"
                " use 0 to 255, and 0 or more pixels"
            )


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


def encode(frame: Frame, layers: list[dict[str, str]] | None = None) -> bytes:
    """The bytes of a golden file: a PNG, with the design's layers as a note if given."""
    note = PngImagePlugin.PngInfo()
    if layers is not None:
        note.add_text(LAYERS_KEY, json.dumps(layers), zip=True)
    buffer = io.BytesIO()
    Image.fromarray(frame.pixels).save(buffer, "PNG", pnginfo=note)
    return buffer.getvalue()


def decode(data: bytes) -> tuple[Frame, list[dict[str, str]] | None]:
    """The picture and the layers in a golden file. Raises GoldenError."""
    try:
        with Image.open(io.BytesIO(data), formats=("PNG",)) as image:
            if max(image.size) > MAX_SIDE:
                raise GoldenError(f"the golden is {image.size[0]}x{image.size[1]} pixels")
            if image.mode != "RGBA":
                raise GoldenError(f"the golden's mode is {image.mode}, not RGBA")
            frame = Frame(np.asarray(image))
            note = (
                image.text.get(LAYERS_KEY)
                if isinstance(image, PngImagePlugin.PngImageFile)
                else None
            )
    except GoldenError:
        raise
    except Exception as error:  # Pillow raises errors of many types for a broken file
        raise GoldenError(f"the golden is not a readable PNG ({error})") from error
    return frame, _layers(note) if note else None


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


def fingerprint(frame: Frame) -> bytes:
    """The golden of the hash mode: one line with size and SHA-256 of the pixels."""
    height, width = frame.pixels.shape[:2]
    digest = hashlib.sha256(frame.pixels.tobytes()).hexdigest()
    return f"{width}x{height} sha256:{digest}\n".encode()


def agrees(expected: Frame, actual: Frame, tolerance: Tolerance) -> bool:
    """Whether a picture is within the tolerance of its golden."""
    if expected.pixels.shape != actual.pixels.shape:
        return False
    worst = errors(expected.pixels, actual.pixels)
    return int(np.count_nonzero(worst > tolerance.channel)) <= tolerance.pixels
