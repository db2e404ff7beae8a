"""Region files of Java worlds (`r.<x>.<z>.mca`): up to 32 x 32 chunks in sectors of 4 KiB.

The first sector lists the place of each chunk: three bytes for its first sector and one for the
number of sectors. A chunk begins with its length and its kind of compression; if the high bit of
the kind is set, the chunk is too large and has its own file, `c.<x>.<z>.mcc`.
"""

import os
import re
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import BinaryIO

from drapery.banner.formats import chunk
from drapery.banner.formats.blocks import OnError, raise_error
from drapery.banner.formats.compression import check_size, inflate
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.lz4 import unlz4
from drapery.banner.formats.nbt import WORDS, read_nbt
from drapery.errors import DesignError, counted
from drapery.user_files import read_user_file

NAME = "region"
SECTOR = 4096
SIDE = 32
MAX_CHUNK = 16 * 2**20
"""Most bytes of an unpacked chunk; usual ones have under 300 KiB."""

MAX_RATIO = 100
"""All chunks together may decompress to this many times the size of the file. It limits files in
which every chunk is a compression bomb. A chunk takes at least a sector, and a chunk of air becomes
about twenty sectors."""

MAX_BANNERS = 20_000
"""Most banners of one chunk, which has 98,304 blocks."""

KINDS = {1: "gzip", 2: "zlib", 3: "none", 127: "one of a mod's own"}
_LZ4 = 4
_OWN_FILE = 0x80
_FILE_NAME = re.compile(r"r\.(-?[0-9]{1,9})\.(-?[0-9]{1,9})\.mc[ar]")


def recognises(head: bytes, size: int) -> bool:
    """Whether a file of this size [bytes] is a region.

    head: at least its first sector. Region files have no signature, but every chunk that they
    list must lie inside the file and after the two sectors of the header.
    """
    if size < 2 * SECTOR or len(head) < SECTOR:
        return False
    places = [_place(head, n) for n in range(SIDE * SIDE)]
    used = [(first, count) for first, count in places if first or count]
    return all(first >= 2 and count and first * SECTOR < size for first, count in used)


def find(
    file: BinaryIO,
    name: str,
    where: str = "",
    on_error: OnError = raise_error,
    folder: Path | None = None,
) -> Iterator[FoundBanner]:
    """Every banner of a region file, with its place: `chunk 3,-1 block 48,71,-9`.

    A broken chunk is one error, and the others are read.

    name: of the file, `r.<x>.<z>.mca`, which gives the chunks' positions. folder: contains the
    files of chunks that are too large for a region.
    """
    corner = _corner(name)
    limit = max(MAX_CHUNK, MAX_RATIO * file.seek(0, os.SEEK_END))
    unpacked = file.seek(0)
    head = file.read(SECTOR)
    owners: dict[int, str] = {}
    for number in _listed(head, where, on_error):
        x, z = corner[0] + number % SIDE, corner[1] + number // SIDE
        at = f"{where} chunk {x},{z}"
        place = _place(head, number)
        try:
            _check_place(owners, place[0], f"{x},{z}", at)
            data = _unpacked(file, place, folder, f"c.{x}.{z}.mcc", at)
            unpacked += len(data)
            check_size(unpacked, where, limit)
            if any(word in data for word in WORDS):
                yield from _limited(chunk.find(read_nbt(data, at), at, on_error), at)
        except DesignError as error:
            on_error(error)
        if unpacked > limit:
            return


def _limited(found: Iterator[FoundBanner], where: str) -> Iterator[FoundBanner]:
    """The banners of a chunk. Raises DesignError after the last that is allowed."""
    yield from islice(found, MAX_BANNERS)
    if next(found, None) is not None:
        raise DesignError(f"{where}: over {MAX_BANNERS} banners; split the chunk in two worlds")


def _corner(name: str) -> tuple[int, int]:
    """The first chunk of a region, from the file's name; 0, 0 for other names."""
    match = _FILE_NAME.fullmatch(name)
    return (int(match[1]) * SIDE, int(match[2]) * SIDE) if match else (0, 0)


def _listed(head: bytes, where: str, on_error: OnError) -> list[int]:
    """The numbers of the chunks that a region has."""
    if len(head) < SECTOR:
        # The game leaves empty region files where it did not finish to save.
        if head:
            on_error(
                DesignError(f"{where}: cut off: {counted(len(head), 'byte')} cannot hold a region")
            )
        return []
    return [number for number in range(SIDE * SIDE) if _place(head, number) != (0, 0)]


def _place(head: bytes, number: int) -> tuple[int, int]:
    """A chunk's first sector and its number of sectors."""
    entry = head[4 * number : 4 * number + 4]
    return int.from_bytes(entry[:3], "big"), entry[3]


def _check_place(owners: dict[int, str], sector: int, chunk: str, where: str) -> None:
    """Raise DesignError for a sector that another chunk has, which would be read once for each."""
    owner = owners.setdefault(sector, chunk)
    if owner != chunk:
        raise DesignError(
            f"{where}: overlaps chunk {owner} at byte {sector * SECTOR};"
            " let the game repair the world"
        )


def _unpacked(
    file: BinaryIO, place: tuple[int, int], folder: Path | None, own_file: str, where: str
) -> bytes:
    """A chunk's NBT. Raises DesignError, naming chunk and byte, where it is broken."""
    first, count = place
    file.seek(first * SECTOR)
    opening = file.read(5)
    length = int.from_bytes(opening[:4], "big")
    if len(opening) < 5 or not 1 <= length <= count * SECTOR:
        at = first * SECTOR
        raise DesignError(f"{where}: there is no chunk at byte {at}; let the game repair the world")
    kind = opening[4]
    large = kind & _OWN_FILE
    data = _own_file(folder, own_file, where) if large else file.read(length - 1)
    return _unwrap(data, kind & ~_OWN_FILE, where)


def _own_file(folder: Path | None, name: str, where: str) -> bytes:
    """The data of a chunk of over a megabyte, from the file beside the region."""
    path = folder / name if folder else None
    if path is None or path.is_symlink() or not path.is_file():
        raise DesignError(f"{where}: its file {name} is missing; copy it into the region's folder")
    check_size(path.stat().st_size, f"{where} {name}", MAX_CHUNK)
    return read_user_file(path, MAX_CHUNK, name=f"{where} {name}", error=DesignError)


def _unwrap(data: bytes, kind: int, where: str) -> bytes:
    if kind == _LZ4:
        return unlz4(data, where, MAX_CHUNK)
    if kind not in (1, 2, 3):
        name = KINDS.get(kind, "unknown")
        raise DesignError(
            f"{where}: compressed by method {kind} ({name}), which is not supported;"
            " set region-file-compression=deflate and let the server save it again"
        )
    if kind == 3:
        check_size(len(data), where, MAX_CHUNK)
        return data
    return inflate(data, where, MAX_CHUNK)
