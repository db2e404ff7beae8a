"""Unwrapping gzip and zlib piece by piece, so that no file grows beyond its limit."""

import zlib

from drapery.errors import DesignError

MAX_BYTES = 64 * 2**20
"""Bytes after decompression."""

_PIECE = 2**20
_GZIP_OR_ZLIB = 32 + zlib.MAX_WBITS
_REMEDY = "save or download the file anew"


def inflate(data: bytes, where: str, limit: int = MAX_BYTES) -> bytes:
    """The bytes without their gzip or zlib wrapping, if they have one.

    Raises DesignError if they are broken, cut off, or over `limit` once unwrapped.
    """
    if not is_compressed(data):
        check_size(len(data), where, limit)
        return data
    stream = zlib.decompressobj(_GZIP_OR_ZLIB)
    pieces: list[bytes] = []
    size = 0
    while data and not stream.eof:
        pieces.append(_piece(stream, data, where, size))
        data = stream.unconsumed_tail
        size += len(pieces[-1])
        check_size(size, where, limit)
    if not stream.eof:
        raise DesignError(
            f"{where}: cut off: its compressed data ends after byte {size} unpacked; {_REMEDY}"
        )
    return b"".join(pieces)


def is_compressed(data: bytes) -> bool:
    """Whether the bytes open as gzip (RFC 1952) or zlib (RFC 1950) does."""
    return data[:2] == b"\x1f\x8b" or (
        len(data) > 1 and data[0] == 0x78 and int.from_bytes(data[:2], "big") % 31 == 0
    )


def check_size(size: int, where: str, limit: int = MAX_BYTES) -> None:
    """Raise DesignError for a file over the limit [bytes]."""
    if size > limit:
        raise DesignError(
            f"{where}: over {limit / 2**20:g} MiB unpacked; cut a smaller piece out of it"
        )


def _piece(stream: "zlib._Decompress", data: bytes, where: str, size: int) -> bytes:
    try:
        return stream.decompress(data, _PIECE)
    except zlib.error as error:
        raise DesignError(
            f"{where}: broken compressed data after byte {size} unpacked ({error}); {_REMEDY}"
        ) from None
