"""Chunks of PNG files: which of them say what the texels are, and which have a wrong checksum.

https://www.w3.org/TR/png-3/#5Chunk-layout
"""

import struct
import zlib
from collections.abc import Iterator

from drapery.errors import PackError

MAX_CHUNKS = 1 << 16
"""Most chunks of a file; encoders write one for each 8 KiB or more."""

_DECODED = frozenset({b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"})
_CHECKED = frozenset({b"IHDR", b"PLTE", b"tRNS"})
_FIRST = 8  # after the signature


def texel_chunks(data: bytes, name: str) -> bytes:
    """A PNG file without the chunks that say nothing about its texels: profiles, texts, times.

    name: the file's name in errors. Raises PackError for more than MAX_CHUNKS.
    """
    # What is no chunk at all is kept, so that the decoder finds the damage.
    kept = [data[a:z] for kind, a, z in _chunks(data, name) if kind in _DECODED or _is_odd(kind)]
    return data[:_FIRST] + b"".join(kept)


def wrong_checksums(data: bytes, name: str) -> tuple[str, ...]:
    """The names, each once, of chunks whose checksum is wrong and that do not hinder reading.

    The game checks none. IHDR, PLTE and tRNS are not among them: their damage is an error.
    name: the file's name in errors. Raises PackError for more than MAX_CHUNKS.
    """
    found: dict[str, None] = {}
    for kind, start, end in _chunks(data, name):
        if kind not in _CHECKED and not _is_odd(kind):
            given = data[end - 4 : end]
            if struct.pack(">I", zlib.crc32(data[start + 4 : end - 4])) != given:
                found[kind.decode("ascii")] = None
    return tuple(found)


def _chunks(data: bytes, name: str) -> Iterator[tuple[bytes, int, int]]:
    """The type, start and end of each chunk up to IEND, or up to what is no chunk."""
    at = _FIRST
    for _ in range(MAX_CHUNKS):
        if at + 8 > len(data):
            return
        length, kind = struct.unpack_from(">I4s", data, at)
        end = len(data) if _is_odd(kind) else at + 12 + length
        yield kind, at, end
        at = end
        if kind == b"IEND":
            return
    raise PackError(f"{name} has over {MAX_CHUNKS} chunks: save it again")


def _is_odd(kind: bytes) -> bool:
    """Whether this is no type of a chunk: those are four letters."""
    return not (kind.isalpha() and kind.isascii())
