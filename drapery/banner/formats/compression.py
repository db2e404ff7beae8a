"""Decompression of gzip and zlib piece by piece, within a limit of memory."""

import zlib
from collections.abc import Iterator

from drapery.errors import DesignError

MAX_BYTES = 64 * 2**20
"""Most bytes of a file after decompression."""

_PIECE = 2**20
_FEED = 2**16
_GZIP_OR_ZLIB = 32 + zlib.MAX_WBITS
_REMEDY = "save or download the file again"


def inflate(data: bytes, where: str, limit: int = MAX_BYTES) -> bytes:
    """The decompressed bytes; bytes that are neither gzip nor zlib are returned as they are.

    Raises DesignError if they are broken, cut off, or over `limit` after decompression.
    """
    if not is_compressed(data):
        check_size(len(data), where, limit)
        return data
    pieces: list[bytes] = []
    size = 0
    for piece in _pieces(data, where):
        pieces.append(piece)
        size += len(piece)
        check_size(size, where, limit)
    return b"".join(pieces)


def _pieces(data: bytes, where: str) -> Iterator[bytes]:
    """The unpacked bytes, at most _PIECE at once."""
    stream = zlib.decompressobj(_GZIP_OR_ZLIB)
    size = start = 0
    waiting, piece = b"", b""
    while not stream.eof:
        # In small parts, since zlib copies the part that it has not read yet.
        if not waiting and len(piece) < _PIECE:
            if start >= len(data):
                raise DesignError(
                    f"{where}: cut off: its compressed data ends after byte {size} unpacked;"
                    f" {_REMEDY}"
                )
            waiting = data[start : start + _FEED]
            start += _FEED
        try:
            piece = stream.decompress(waiting, _PIECE)
        except zlib.error:
            raise DesignError(
                f"{where}: broken compressed data after byte {size} unpacked; {_REMEDY}"
            ) from None
        waiting = stream.unconsumed_tail
        size += len(piece)
        yield piece


def is_compressed(data: bytes) -> bool:
    """Whether the bytes begin as gzip (RFC 1952) or zlib (RFC 1950) data."""
    return data[:2] == b"\x1f\x8b" or (
        len(data) > 1 and data[0] == 0x78 and int.from_bytes(data[:2], "big") % 31 == 0
    )


def check_size(size: int, where: str, limit: int = MAX_BYTES) -> None:
    """Raise DesignError for a file over the limit [bytes]."""
    if size > limit:
        raise DesignError(
            f"{where}: over {limit / 2**20:g} MiB unpacked; save a smaller piece of it"
        )
