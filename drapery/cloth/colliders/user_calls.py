"""A user's distance and gradient functions as machine code, and the instructions that call them.

Imported by name when a kernel is compiled; see `user_defined`.
"""

from collections.abc import Sequence
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.core.dispatcher import Dispatcher
from numba.extending import intrinsic

_numba: Any = numba  # its type stubs lack what is used here
carray: Any = _numba.carray
_types: Any = types
_intrinsic: Any = intrinsic
_pointer = _types.CPointer(types.float64)
_DISTANCE = types.float64(types.float64, types.float64, types.float64, _pointer, types.intp)
_GRADIENT = types.void(types.float64, types.float64, types.float64, _pointer, types.intp, _pointer)


def compile_distance(function: Any) -> Any:
    """A function of (point, parameters) that gives a distance. Raises NumbaError."""
    inner = _compiled_inner(function)

    def call(x: Any, y: Any, z: Any, first: Any, count: Any) -> Any:
        return inner((x, y, z), carray(first, (count,)))

    return _numba.cfunc(_DISTANCE, error_model="numpy")(call)


def compile_gradient(function: Any) -> Any:
    """A function of (point, parameters) that gives a direction. Raises NumbaError."""
    inner = _compiled_inner(function)

    def call(x: Any, y: Any, z: Any, first: Any, count: Any, result: Any) -> None:
        direction = inner((x, y, z), carray(first, (count,)))
        result[0], result[1], result[2] = direction[0], direction[1], direction[2]

    return _numba.cfunc(_GRADIENT, error_model="numpy")(call)


def _compiled_inner(function: Any) -> Any:
    if isinstance(function, Dispatcher):
        return function
    return _numba.njit(error_model="numpy")(function)


def _function_of(builder: Any, address: Any, result: Any, operands: Sequence[Any]) -> Any:
    shape = ir.FunctionType(result, [operand.type for operand in operands])
    return builder.inttoptr(address, shape.as_pointer())


def _operands(context: Any, builder: Any, signature: Any, args: Any) -> list[Any]:
    """x, y, z, the first parameter's place, and their number."""
    parameters = context.make_array(signature.args[4])(context, builder, args[4])
    return [*args[1:4], parameters.data, builder.extract_value(parameters.shape, 0)]


@_intrinsic
def call_distance(typing: Any, address: Any, x: Any, y: Any, z: Any, parameters: Any) -> Any:
    """The distance function at an address."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        operands = _operands(context, builder, signature, args)
        function = _function_of(builder, args[0], ir.DoubleType(), operands)
        return builder.call(function, operands)

    f8 = types.float64
    return f8(types.int64, f8, f8, f8, parameters), generate


@_intrinsic
def call_gradient(
    typing: Any, address: Any, x: Any, y: Any, z: Any, parameters: Any, result: Any
) -> Any:
    """The gradient function at an address, into an array [3]."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        place = context.make_array(signature.args[5])(context, builder, args[5])
        operands = [*_operands(context, builder, signature, args), place.data]
        function = _function_of(builder, args[0], ir.VoidType(), operands)
        builder.call(function, operands)
        return context.get_dummy_value()

    f8 = types.float64
    return types.none(types.int64, f8, f8, f8, parameters, result), generate
