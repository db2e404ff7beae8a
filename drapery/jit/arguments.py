"""The arguments of a kernel as a flat list of 64-bit words, as numba passes them.

An array has 5 + 2 D words: two that own its memory (here 0: Python does), its size, the size of an
item, its address, its shape and its strides. A tuple has those of its parts in turn.
"""

import struct
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

ABI = 3
"""The version of this layout. A library with another version is not used."""

C_CONTIGUOUS, F_CONTIGUOUS, ALIGNED, WRITEABLE = 0x1, 0x2, 0x100, 0x400
MOST_KEPT, MOST_BYTES = 32, 1 << 20
"""How many tuples are kept packed, and the most bytes of the arrays of one."""
_LAYOUT = C_CONTIGUOUS | F_CONTIGUOUS | ALIGNED | WRITEABLE


_kept: dict[int, "_KeptTuple"] = {}
"""Tuples, which are kept so that no other one gets their `id`, with what they are packed to."""


class Packed(NamedTuple):
    """types: the type of each argument and of each part of a tuple. words: the values, or
    addresses, as signed 64-bit integers."""

    types: tuple[str, ...]
    words: list[int]


class _KeptTuple(NamedTuple):
    """A tuple, what it is packed to, and the bytes of its arrays."""

    value: tuple[Any, ...]
    types: list[str]
    words: list[int]
    size: int


def pack(arguments: tuple[Any, ...]) -> Packed:
    """The arguments of a call.

    Arguments with the same types have the same types for numba. The words hold addresses: the
    arguments must live as long as they are in use.
    Raises TypeError for what is no array, no number and no tuple of them, and OverflowError for an
    integer of more than 64 bits.
    """
    types: list[str] = []
    words: list[int] = []
    for argument in arguments:
        _add(argument, types, words)
    return Packed(tuple(types), words)


def _add(value: Any, types: list[str], words: list[int]) -> int:
    """Pack a value. The result is how many bytes of arrays it has."""
    kind: Any = type(value)
    if kind is np.ndarray:
        types.append(_array_type(value.dtype, value.ndim, value.flags.num & _LAYOUT))
        words += (0, 0, value.size, value.itemsize, value.__array_interface__["data"][0])
        words += value.shape
        words += value.strides
        return int(value.nbytes)
    elif kind is int:
        if not -(2**63) <= value < 2**63:
            raise OverflowError(f"a kernel takes integers of 64 bits, not {value}")
        types.append("int64")
        words.append(value)
    elif kind is bool:
        types.append("bool")
        words.append(value)
    elif kind is float:
        types.append("float64")
        words += struct.unpack("q", struct.pack("d", value))
    elif isinstance(value, tuple):
        packed = _kept.pop(id(value), None) or _packed_tuple(value)
        types += packed.types
        words += packed.words
        if packed.size <= MOST_BYTES:
            _keep(packed)
        return packed.size
    elif isinstance(value, np.generic) and value.dtype.kind in "biuf":
        types.append(value.dtype.str)
        words += struct.unpack("q", value.tobytes().ljust(8, b"\0"))
    else:
        raise TypeError(f"a kernel takes no {kind.__module__}.{kind.__qualname__}")
    return 0


def _packed_tuple(value: tuple[Any, ...]) -> _KeptTuple:
    types, words = [_tuple_type(type(value))], list[int]()
    size = 0
    for part in value:
        size += _add(part, types, words)
    types.append(")")
    return _KeptTuple(value, types, words, size)


def _keep(packed: _KeptTuple) -> None:
    """Keep a small tuple, and forget those that were used longest ago.

    A solver calls its kernel with the same tuple in each step, and packing its arrays takes a tenth
    of the step of a small cloth. The arrays of a tuple stay where they are.
    """
    _kept[id(packed.value)] = packed
    for oldest in list(_kept)[:-MOST_KEPT]:
        _kept.pop(oldest, None)


@lru_cache(256)
def _array_type(dtype: np.dtype[Any], ndim: int, flags: int) -> str:
    layout = "C" if flags & C_CONTIGUOUS else "F" if flags & F_CONTIGUOUS else "A"
    extra = ("" if flags & ALIGNED else " unaligned") + ("" if flags & WRITEABLE else " readonly")
    name = dtype.str if dtype.names is None else f"{dtype.descr}{dtype.itemsize}"
    return f"{name}[{ndim}{layout}]{extra}"


@lru_cache(256)
def _tuple_type(kind: type) -> str:
    fields = " ".join(getattr(kind, "_fields", ()))
    return "(" if kind is tuple else f"{kind.__module__}.{kind.__qualname__}[{fields}]("
