"""Decompression of lz4-java's block streams, in which a server may save its chunks.

A stream is a sequence of blocks. Each begins with the eight characters LZ4Block, then a byte whose
high half is 1 for uncompressed bytes and 2 for LZ4 (its low half is the writer's block size), then
three little-endian numbers of 32 bits: the length in the stream, the length after decompression,
and a checksum. A block of length 0 ends the stream.
"""

import struct

from drapery.banner.formats.compression import check_size
from drapery.errors import DesignError

_MAGIC = b"LZ4Block"
_HEAD = struct.Struct("<8sBiii")
_RAW, _PACKED = 1, 2
_REMEDY = "let the game repair the world"


def unlz4(data: bytes, where: str, limit: int) -> bytes:
    """The bytes of a stream. Raises DesignError: broken, cut off, over the limit [bytes]."""
    pieces: list[bytes] = []
    size = start = 0
    while True:
        if len(data) - start < _HEAD.size:
            raise DesignError(f"{where}: cut off: its LZ4 data ends at byte {len(data)}; {_REMEDY}")
        magic, token, here, unpacked, _ = _HEAD.unpack_from(data, start)
        start += _HEAD.size
        if magic != _MAGIC or here < 0 or unpacked < 0 or token >> 4 not in (_RAW, _PACKED):
            raise DesignError(
                f"{where}: no LZ4 block at byte {start - _HEAD.size} of it; {_REMEDY}"
            )
        if unpacked == 0:
            return b"".join(pieces)
        size += unpacked
        check_size(size, where, limit)
        pieces.append(_block(data[start : start + here], token >> 4, unpacked, where))
        start += here


def _block(data: bytes, method: int, unpacked: int, where: str) -> bytes:
    piece = data if method == _RAW else _decompress(data, unpacked, where)
    if len(piece) != unpacked:
        raise DesignError(f"{where}: an LZ4 block of {unpacked} bytes has {len(piece)}; {_REMEDY}")
    return piece


def _decompress(data: bytes, size: int, where: str) -> bytes:
    try:
        from lz4 import block
    except ImportError:
        raise DesignError(
            f'{where}: packed with LZ4, which needs an extra; pip install "drapery-mc[lz4]"'
        ) from None
    try:
        piece: bytes = block.decompress(data, uncompressed_size=size)
    except block.LZ4BlockError:
        raise DesignError(f"{where}: broken LZ4 data; {_REMEDY}") from None
    return piece
