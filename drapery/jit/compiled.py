"""A compiled kernel: its call with a block of words, its result, and its error.

The block begins with the address of an error, then comes the result, then the arguments; see
`drapery.jit.arguments`. `drapery.jit.codegen` makes the function that is called with a block.
"""

import ctypes
import pickle
import struct
from array import array
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

SCALARS: dict[str, Callable[[int], Any]] = {
    "none": lambda word: None,
    "int64": int,
    "bool": lambda word: bool(word & 1),
    "float64": lambda word: struct.unpack("d", struct.pack("q", word))[0],
}
"""How the word of a result becomes a value, by its type."""

Result = str | list[Any]
"""The type of a result: a name of SCALARS, or a list of types for a tuple."""


class _Error(ctypes.Structure):
    """How numba describes an error: the pickled class and arguments, and more."""

    _fields_ = (("pickled", ctypes.c_void_p), ("size", ctypes.c_int32))


@dataclass(frozen=True)
class CompiledKernel:
    """A kernel for arguments of certain types.

    call: the function that takes the address of a block. address: of the function that other
    kernels call. result: the type of what it returns. owner: keeps the code in memory.
    """

    call: Callable[[int], int]
    address: int
    result: Result
    owner: Any = None

    def __call__(self, words: list[int]) -> Any:
        """words: see `drapery.jit.arguments`. Raises what the kernel raises."""
        count = word_count(self.result)
        block = array("q", [0] * (1 + count) + words)
        if self.call(block.buffer_info()[0]):
            raise _error_at(block[0])
        if count == 1:
            return SCALARS[str(self.result)](block[1])
        return _value(self.result, iter(block[1 : 1 + count]))


def word_count(result: Result) -> int:
    """How many words a result takes."""
    return 1 if isinstance(result, str) else max(1, sum(map(word_count, result)))


def _value(result: Result, words: Iterator[int]) -> Any:
    if isinstance(result, str):
        return SCALARS[result](next(words))
    return tuple(_value(part, words) for part in result)


def _error_at(address: int) -> BaseException:
    """The error that a kernel has left at an address."""
    described = _Error.from_address(address)
    kind, arguments, *_ = pickle.loads(ctypes.string_at(described.pickled, described.size))
    error: BaseException = kind(*(arguments or ()))
    return error
