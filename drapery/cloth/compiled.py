"""The compiler's settings for what only other kernels call."""

from collections.abc import Callable
from typing import Any, TypeVar, cast

from numba import njit

Function = TypeVar("Function", bound=Callable[..., object])

_njit: Any = njit  # its type stubs lack the wrapper options and would hide ours
WITHIN = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
DOOR = {"error_model": "numpy", "cache": True, "nogil": True}


def kernel(function: Function) -> Function:
    """Strict IEEE arithmetic, in its caller's cache. The types are the function's own."""
    return cast(Function, _njit(**WITHIN)(function))


def door(function: Function) -> Function:
    """The same for what Python calls: cached, and other threads run meanwhile."""
    return cast(Function, _njit(**DOOR)(function))
