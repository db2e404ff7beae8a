"""Golden files, and whether a picture or a loop agrees with one."""

import hashlib
import io
import json
import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, PngImagePlugin

from drapery.comparison import (
    Picture,
    Tolerance,
    as_picture,
    decode_picture,
    measure_pictures,
    seen,
)
from drapery.errors import DraperyError
from drapery.render import Frame, apng_bytes

LAYERS_KEY = "drapery:layers"
_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_AFTER_HEADER = 33
"""Where the second chunk of a PNG begins [bytes]."""
MAX_NOTE = 1 << 24
"""The longest note [bytes]."""


class GoldenError(DraperyError):
    """A golden file that cannot be used."""


def encode(source: Any, layers: list[dict[str, str]] | None = None) -> bytes:
    """The bytes of a golden file: a PNG, or an APNG for a loop.

    source: what `as_picture` takes.
    layers: of the design, as a note in the file.
    """
    picture = as_picture(source)
    text = None if layers is None else json.dumps(layers)
    first = picture.frames[0]
    if picture.delays:
        frames = (Frame(pixels) for pixels in picture.frames)
        data = apng_bytes(frames, delays=picture.delays, plays=picture.plays)
    elif first.dtype == np.uint16:
        data = _sixteen_bit_png(first)
    else:
        note = PngImagePlugin.PngInfo()
        if text is not None:
            note.add_text(LAYERS_KEY, text, zip=True)
        buffer = io.BytesIO()
        Image.fromarray(first).save(buffer, "PNG", pnginfo=note)
        return buffer.getvalue()
    return data if text is None else _with_note(data, text)


def decode(data: bytes) -> tuple[Picture, list[dict[str, str]] | None]:
    """The picture and the layers in a golden file.

    Raises GoldenError.
    """
    try:
        picture = decode_picture(data, "the golden", ("PNG",))
    except DraperyError as error:
        raise GoldenError(f"the golden is not a readable PNG ({error})") from None
    note = _note(data)
    return picture, _layers(note) if note else None


def _sixteen_bit_png(pixels: NDArray[np.uint16]) -> bytes:
    """A PNG file of 16 bits a channel, which Pillow does not write."""
    height, width = pixels.shape[:2]
    rows = np.zeros((height, 1 + 8 * width), np.uint8)  # each row begins with its filter: none
    rows[:, 1:] = pixels.astype(">u2").view(np.uint8).reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 16, 6, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows.tobytes())), (b"IEND", b""))
    return _SIGNATURE + b"".join(_chunk(kind, body) for kind, body in chunks)


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def _with_note(png: bytes, text: str) -> bytes:
    """A PNG with a compressed text after its header ("PNG Specification", section 11.3.3.3)."""
    note = _chunk(b"zTXt", LAYERS_KEY.encode() + bytes(2) + zlib.compress(text.encode("latin-1")))
    return png[:_AFTER_HEADER] + note + png[_AFTER_HEADER:]


def _note(png: bytes) -> str | None:
    """The text that `_with_note` or Pillow has put before the pixels; None if there is none."""
    place, start = len(_SIGNATURE), LAYERS_KEY.encode() + bytes(1)
    while place + 12 <= len(png):
        (length,) = struct.unpack_from(">I", png, place)
        kind, body = png[place + 4 : place + 8], png[place + 8 : place + 8 + length]
        if kind in (b"zTXt", b"tEXt") and body.startswith(start):
            return _text(kind, body[len(start) :])
        if kind in (b"IDAT", b"IEND"):
            return None
        place += length + 12
    return None


def _text(kind: bytes, body: bytes) -> str | None:
    """The text of a chunk; None if it is damaged or too long."""
    if kind == b"zTXt":
        unpacker = zlib.decompressobj()
        try:
            body = unpacker.decompress(body[1:], MAX_NOTE)
        except zlib.error:
            return None
        if unpacker.unconsumed_tail:
            return None
    return body.decode("latin-1")


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


def fingerprint(source: Any) -> bytes:
    """The golden of the hash mode: one line with size and SHA-256 of the pixels.

    source: what `as_picture` takes. The colour of transparent pixels does not count, as in a
    comparison.
    """
    picture = as_picture(source)
    pixels = seen(np.stack(picture.frames))
    deep = pixels.dtype == np.uint16
    digest = hashlib.sha256(pixels.astype("<u2" if deep else np.uint8).tobytes()).hexdigest()
    return f"{picture.described()}{', 16 bits' if deep else ''} sha256:{digest}\n".encode()


def agrees(expected: Any, actual: Any, tolerance: Tolerance) -> bool:
    """Whether a picture is within the tolerance of its golden.

    expected: what `as_picture` takes.
    actual: what `as_picture` takes.
    tolerance: what counts as a difference.
    """
    return measure_pictures(as_picture(expected), as_picture(actual), tolerance).agrees
