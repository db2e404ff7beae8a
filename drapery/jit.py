"""Decorators: `kernel` for functions that kernels call, `entry_point` for those Python calls."""

from collections.abc import Callable, Sequence
from typing import Any, TypeVar, cast

from llvmlite import ir
from numba import njit, types
from numba.core.cgutils import if_unlikely
from numba.extending import intrinsic

from drapery.jit_cache import cache_on_disk

Function = TypeVar("Function", bound=Callable[..., object])

_njit: Any = njit  # its type stubs lack the wrapper options
_types: Any = types
_intrinsic: Any = intrinsic
_if_unlikely: Any = if_unlikely
INNER = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
OUTER = {"error_model": "numpy", "nogil": True}
REGISTER = 64
"""Bytes of the widest register for which kernels are written; see `drapery.cloth.simd`."""


def kernel(function: Function) -> Function:
    """A function that only kernels call: strict IEEE arithmetic, cached as part of its callers."""
    return cast(Function, _njit(**INNER)(function))


def entry_point(function: Function) -> Function:
    """The same for a function that Python calls: cached on disk; it releases the GIL."""
    return cast(Function, cache_on_disk(_njit(**OUTER)(function)))


def call_by_address(result: Any, parameters: Sequence[Any]) -> Any:
    """A function (address, arguments) that kernels call; see `address_of`.

    What a kernel calls so is compiled once, not again as part of each of its callers.
    result, parameters: types of numba. arguments: a tuple of exactly these types.
    """
    wanted = _types.Tuple(parameters)

    @_intrinsic
    def call(typing: Any, address: Any, arguments: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            given = [builder.extract_value(values[1], i) for i in range(len(parameters))]
            shape = context.call_conv.get_function_type(result, parameters)
            function = builder.inttoptr(values[0], ir.PointerType(shape))
            status, value = context.call_conv.call_function(
                builder, function, result, parameters, given
            )
            with _if_unlikely(builder, status.is_error):
                context.call_conv.return_status_propagate(builder, status)
            return value

        if arguments != wanted:
            raise TypeError(f"called with {arguments}, not with {wanted}")
        return result(_types.int64, wanted), generate

    return call


def address_of(function: Any, parameters: Sequence[Any]) -> int:
    """Where the compiled code of an entry point for parameters of such types is in memory."""
    function.compile(tuple(parameters))
    made = function.overloads[tuple(parameters)]
    return cast(int, made.library.get_pointer_to_function(made.fndesc.llvm_func_name))
