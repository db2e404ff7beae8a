"""Decorators: `kernel` for functions that kernels call, `entry_point` for those Python calls."""

from collections.abc import Callable
from typing import Any, TypeVar, cast

from numba import njit

from drapery.jit_cache import cache_on_disk

Function = TypeVar("Function", bound=Callable[..., object])

_njit: Any = njit  # its type stubs lack the wrapper options
INNER = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
OUTER = {"error_model": "numpy", "nogil": True}


def kernel(function: Function) -> Function:
    """A function that only kernels call: strict IEEE arithmetic, cached as part of its callers."""
    return cast(Function, _njit(**INNER)(function))


def entry_point(function: Function) -> Function:
    """The same for a function that Python calls: cached on disk; it releases the GIL."""
    return cast(Function, cache_on_disk(_njit(**OUTER)(function)))
