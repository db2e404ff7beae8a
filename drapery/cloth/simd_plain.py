"""What `simd_instructions` has, for one number at a time, from nothing that numba may change.

Kernels use it where a version of numba or llvmlite lacks what registers are made with, and where
DRAPERY_SIMD is 0. A register has one lane here. The operations and their order are the same for
each number, so the bits are too; kernels take several times as long.
"""

from typing import Any

import numpy as np

from drapery.jit import kernel


@kernel
def lane_count(array: Any) -> Any:
    """Numbers of an array's type in a register."""
    return 1


@kernel
def load(array: Any, row: Any, lane: Any) -> Any:
    """array[row, lane]."""
    return array[row, lane]


@kernel
def store(array: Any, row: Any, lane: Any, value: Any) -> None:
    """array[row, lane] = value."""
    array[row, lane] = value


@kernel
def fill(number: Any) -> Any:
    """The number."""
    return number


@kernel
def sqrt(value: Any) -> Any:
    """Square root."""
    return np.sqrt(value)


@kernel
def flush_denormals(value: Any, least: Any) -> Any:
    """0 where the absolute value is below `least`, elsewhere the value."""
    return least - least if abs(value) < least else value


@kernel
def maximum(a: Any, b: Any) -> Any:
    """The larger one; b where one is NaN."""
    return a if a > b else b


@kernel
def minimum(a: Any, b: Any) -> Any:
    """The smaller one; b where one is NaN."""
    return a if a < b else b
