"""Registers of lanes: one value in a kernel that holds many floating-point numbers.

The compiler vectorises a loop over lanes of several rows only behind checks that no rows overlap,
and gives up where there are many rows. So kernels are written with registers: `load` 64 bytes of a
row, calculate, `store`. Operators act on each number by itself, in strict IEEE arithmetic. A
processor with narrower registers uses several. `simd_plain` stands in for registers where numba
cannot make them.
"""

from typing import Any

import numpy as np

from drapery.jit import REGISTER, kernel, numba_name

BYTES = REGISTER
"""Size of a register and of a cache line."""

_INSTRUCTIONS = "drapery.cloth.simd_instructions"
_PLAIN = "drapery.cloth.simd_plain"
fill = numba_name(_INSTRUCTIONS, "fill", _PLAIN)
flush_denormals = numba_name(_INSTRUCTIONS, "flush_denormals", _PLAIN)
lane_count = numba_name(_INSTRUCTIONS, "lane_count", _PLAIN)
load = numba_name(_INSTRUCTIONS, "load", _PLAIN)
maximum = numba_name(_INSTRUCTIONS, "maximum", _PLAIN)
minimum = numba_name(_INSTRUCTIONS, "minimum", _PLAIN)
sqrt = numba_name(_INSTRUCTIONS, "sqrt", _PLAIN)
store = numba_name(_INSTRUCTIONS, "store", _PLAIN)


def lanes_per_register(dtype: Any) -> int:
    """Numbers in one register."""
    return BYTES // int(np.dtype(dtype).itemsize)


def padded_count(count: int, dtype: Any) -> int:
    """`count` rounded up to whole registers."""
    return -(-count // lanes_per_register(dtype)) * lanes_per_register(dtype)


@kernel
def empty_lanes(rows: Any, lanes: Any, like: Any) -> Any:
    """Zeros [rows, lanes] of the type of an array, aligned to a cache line."""
    size = np.intp(rows) * np.intp(lanes)
    numbers = np.zeros(size + BYTES // like.itemsize, like.dtype)
    first = -numbers.ctypes.data % BYTES // like.itemsize
    return numbers[first : first + size].reshape((np.intp(rows), np.intp(lanes)))
