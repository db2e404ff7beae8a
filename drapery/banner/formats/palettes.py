"""The blocks at given places: palettes of block states and the arrays that index them."""

from collections.abc import Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drapery.banner.formats.blocks import Spot
from drapery.banner.formats.tree import is_banner_id
from drapery.errors import DesignError

PIECE = 2**20
"""Indices that are unpacked at once, which bounds the memory."""

MAX_PICKED = 100_000
"""Most blocks of one file that are read; the largest builds have some thousand banners."""

Pieces: TypeAlias = Iterable[tuple[int, NDArray[Any]]]
"""Runs of palette indices, each with the number of its first block."""


def pick_states(
    pieces: Pieces, places: Iterable[int], states: Iterable[int], where: str
) -> dict[int, int]:
    """The palette index at each of the places, and wherever it is one of the states.

    pieces: the palette indices of all blocks in order. places: numbers of blocks.
    Raises DesignError over MAX_PICKED blocks.
    """
    wanted = np.unique(np.fromiter(places, np.int64))
    kinds = np.fromiter(states, np.int64)
    picked: dict[int, int] = {}
    for first, values in pieces:
        here = wanted[np.searchsorted(wanted, first) : np.searchsorted(wanted, first + len(values))]
        hits = np.flatnonzero(np.isin(values, kinds)) if len(kinds) else kinds
        if len(picked) + len(here) + len(hits) > MAX_PICKED:
            raise DesignError(f"{where}: over {MAX_PICKED} banners; save a smaller piece of it")
        for offset in (here - first).tolist() + hits.tolist():
            picked[first + offset] = int(values[offset])
    return picked


def names_in_box(
    pieces: Pieces, palette: dict[int, str], size: Spot, places: Iterable[Spot], where: str
) -> dict[Spot, str]:
    """The ids of the blocks at the places, and of every banner, in a box filled by x, z, then y.

    pieces: the palette indices of the box's blocks. size: of the box, along x, y, z [blocks].
    """
    width, height, length = size
    inside = [p for p in places if all(0 <= p[axis] < size[axis] for axis in range(3))]
    banners = [state for state, name in palette.items() if is_banner_id(name)]
    picked = pick_states(
        pieces, [(y * length + z) * width + x for x, y, z in inside], banners, where
    )
    return {
        (n % width, n // width // length, n // width % length): palette[state]
        for n, state in sorted(picked.items())
        if n < width * height * length and state in palette
    }


def varint_pieces(data: bytes, where: str) -> Pieces:
    """Numbers of seven bits a byte, lowest first; a byte's eighth bit says that one follows.

    Raises DesignError for a number of more than five bytes or without an end.
    """
    first = start = 0
    while start < len(data):
        piece = np.frombuffer(data, np.uint8, min(PIECE, len(data) - start), start)
        ends = np.flatnonzero(piece < 128)
        if not len(ends):
            raise DesignError(f"{where}: block data has no end after byte {start}; save it again")
        yield first, _varints(piece, ends, f"{where}: block data near byte {start}")
        first += len(ends)
        start += int(ends[-1]) + 1


def _varints(piece: NDArray[np.uint8], ends: NDArray[np.int64], where: str) -> NDArray[Any]:
    if len(ends) == len(piece):
        return piece
    starts = np.concatenate(([0], ends[:-1] + 1))
    sizes = ends - starts + 1
    if sizes.max() > 5:
        raise DesignError(f"{where} has a number of over five bytes; save the file again")
    values = np.zeros(len(ends), np.int64)
    for place in range(int(sizes.max())):
        byte = piece[np.minimum(starts + place, ends)].astype(np.int64) & 127
        values |= np.where(place < sizes, byte << 7 * place, 0)
    return values


def bits_for(states: int, least: int) -> int:
    """Bits of an index into this many states, at least `least`."""
    return max(least, (states - 1).bit_length())


def longs_needed(count: int, bits: int, spanning: bool) -> int:
    """The length of the array that holds `count` indices."""
    return -(-count * bits // 64) if spanning else -(-count // (64 // bits))


def unpack(
    longs: NDArray[np.int64], bits: int, places: NDArray[np.int64], spanning: bool
) -> NDArray[np.int64]:
    """The indices at the given places of an array of longs, filled from the lowest bit.

    spanning: an index may begin in one long and end in the next (Litematica; the game to 1.15).
    Since 1.16 it may not, and the bits left over in a long are empty.
    """
    words = longs.view(np.uint64)
    if spanning:
        word, shift = places * bits // 64, places * bits % 64
    else:
        word, shift = places // (64 // bits), places % (64 // bits) * bits
    low = words[word] >> shift.astype(np.uint64)
    over = np.maximum(shift + bits - 64, 0)
    following = words[np.minimum(word + 1, len(words) - 1)]
    # A shift by 64 is undefined, so `high` is zero where nothing spans two longs.
    high = np.where(over > 0, following << (bits - over).astype(np.uint64), np.uint64(0))
    return ((low | high) & np.uint64((1 << bits) - 1)).astype(np.int64)


def pack(indices: NDArray[np.int64], bits: int) -> NDArray[np.int64]:
    """A spanning array of longs, as `unpack` reads it."""
    spread = (indices[:, None] >> np.arange(bits)) & 1
    packed = np.packbits(spread.astype(np.uint8).ravel(), bitorder="little")
    return np.pad(packed, (0, -len(packed) % 8)).view("<i8").astype(np.int64)


def packed_pieces(longs: NDArray[np.int64], bits: int, count: int) -> Pieces:
    """All `count` indices of a spanning array of longs, a piece at a time."""
    for first in range(0, count, PIECE):
        places = np.arange(min(PIECE, count - first))
        start = first * bits // 64  # whole, since a piece is a multiple of 64 indices
        stop = start + longs_needed(len(places), bits, spanning=True)
        yield first, unpack(longs[start:stop], bits, places, spanning=True)
