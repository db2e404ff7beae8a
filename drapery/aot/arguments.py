"""The arguments of a kernel as a flat list of 64-bit words, as numba passes them.

An array has 5 + 2 D words: two that own its memory (here 0: Python does), its size, the size of an
item, its address, its shape and its strides. A tuple has those of its parts in turn.
"""

import struct
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

ABI = 2
"""The version of this layout. A library with another version is not used."""

C_CONTIGUOUS, F_CONTIGUOUS, ALIGNED, WRITEABLE = 0x1, 0x2, 0x100, 0x400
_LAYOUT = C_CONTIGUOUS | F_CONTIGUOUS | ALIGNED | WRITEABLE


class Packed(NamedTuple):
    """types: the type of each argument and of each part of a tuple. words: the values, or
    addresses, as signed 64-bit integers."""

    types: tuple[str, ...]
    words: list[int]


def pack(arguments: tuple[Any, ...]) -> Packed | None:
    """The arguments of a call; None if one is of a type that is not compiled ahead of time.

    Arguments with the same types have the same types for numba. The words hold addresses: the
    arguments must live as long as they are in use.
    """
    types: list[str] = []
    words: list[int] = []
    for argument in arguments:
        if not _add(argument, types, words):
            return None
    return Packed(tuple(types), words)


def _add(value: Any, types: list[str], words: list[int]) -> bool:
    kind: Any = type(value)
    if kind is np.ndarray:
        types.append(_array_type(value.dtype, value.ndim, value.flags.num & _LAYOUT))
        words += (0, 0, value.size, value.itemsize, value.ctypes.data)
        words += value.shape
        words += value.strides
    elif kind is int:
        types.append("int64")
        words.append(value)
        return bool(-(2**63) <= value < 2**63)
    elif kind is bool:
        types.append("bool")
        words.append(value)
    elif kind is float:
        types.append("float64")
        words += struct.unpack("q", struct.pack("d", value))
    elif isinstance(value, tuple):
        types.append(_tuple_type(kind))
        for part in value:
            if not _add(part, types, words):
                return False
        types.append(")")
    elif isinstance(value, np.generic) and value.dtype.kind in "biuf":
        types.append(value.dtype.str)
        words += struct.unpack("q", value.tobytes().ljust(8, b"\0"))
    else:
        return False
    return True


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
