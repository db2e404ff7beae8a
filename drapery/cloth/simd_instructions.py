"""What numba must know of registers of lanes: their type and instructions. See `simd`.

These parts of numba and llvmlite may change; `tests/test_cloth_simd.py` names what breaks.
"""

import operator
from collections.abc import Callable
from typing import Any, cast

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, lower_builtin, models, register_model, type_callable

from drapery.cloth.simd import BYTES

_intrinsic: Any = intrinsic
_cgutils: Any = cgutils
_Type: Any = types.Type
_Model: Any = models.PrimitiveModel


class Lanes(_Type):  # type: ignore[misc]
    """The type of such a value."""

    def __init__(self, dtype: Any) -> None:
        self.dtype, self.count = dtype, 8 * BYTES // dtype.bitwidth
        super().__init__(name=f"Lanes({dtype})")


@register_model(Lanes)
class _LanesModel(_Model):  # type: ignore[misc]
    def __init__(self, manager: Any, kind: Lanes) -> None:
        one = ir.FloatType() if kind.dtype == types.float32 else ir.DoubleType()
        super().__init__(manager, kind, ir.VectorType(one, kind.count))


def _place(context: Any, builder: Any, kind: Any, array: Any, row: Any, lane: Any) -> Any:
    """Pointer to a register at array[row, lane], whose last axis is contiguous."""
    numbers = context.make_array(kind)(context, builder, array)
    if context.enable_boundscheck:
        rows, lanes = _cgutils.unpack_tuple(builder, numbers.shape, 2)
        last = builder.add(lane, context.get_constant(types.intp, Lanes(kind.dtype).count - 1))
        _cgutils.do_boundscheck(context, builder, row, rows, 0)
        for each in (lane, last):
            _cgutils.do_boundscheck(context, builder, each, lanes, 1)
    bytes_a_row = builder.extract_value(numbers.strides, 0)
    start = builder.bitcast(numbers.data, ir.IntType(8).as_pointer())
    line = builder.gep(start, [builder.mul(row, bytes_a_row)])
    return builder.gep(builder.bitcast(line, numbers.data.type), [lane])


@_intrinsic
def lane_count(typing: Any, array: Any) -> Any:
    """Numbers of an array's type in a register."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return context.get_constant(types.intp, Lanes(array.dtype).count)

    return types.intp(array), generate


@_intrinsic
def load(typing: Any, array: Any, row: Any, lane: Any) -> Any:
    """A register of array[row, lane : ...]; checked only with NUMBA_BOUNDSCHECK."""
    kind = Lanes(array.dtype)

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        place = _place(context, builder, signature.args[0], *args)
        register = context.get_value_type(kind).as_pointer()
        value = builder.load(builder.bitcast(place, register))
        value.align = array.dtype.bitwidth // 8
        return value

    return kind(array, types.intp, types.intp), generate


@_intrinsic
def store(typing: Any, array: Any, row: Any, lane: Any, value: Any) -> Any:
    """array[row, lane : ...] = value; checked only with NUMBA_BOUNDSCHECK."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        place = _place(context, builder, signature.args[0], *args[:3])
        register = args[3].type.as_pointer()
        builder.store(args[3], builder.bitcast(place, register)).align = array.dtype.bitwidth // 8
        return context.get_dummy_value()

    return types.none(array, types.intp, types.intp, value), generate


def _filled(builder: Any, register: Any, number: Any) -> Any:
    start = ir.Constant(register, ir.Undefined)
    first = builder.insert_element(start, number, ir.Constant(ir.IntType(32), 0))
    order = ir.Constant(ir.VectorType(ir.IntType(32), register.count), [0] * register.count)
    return builder.shuffle_vector(first, start, order)


@_intrinsic
def fill(typing: Any, number: Any) -> Any:
    """A register with one number in every lane."""
    kind = Lanes(number)

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return _filled(builder, context.get_value_type(kind), args[0])

    return kind(number), generate


def _call(builder: Any, name: str, value: Any) -> Any:
    """An instruction of one operand that LLVM has as a function."""
    kind = value.type
    name = f"llvm.{name}.v{kind.count}f{64 if kind.element == ir.DoubleType() else 32}"
    shape = ir.FunctionType(kind, [kind])
    return builder.call(_cgutils.get_or_insert_function(builder.module, shape, name), [value])


@_intrinsic
def sqrt(typing: Any, value: Any) -> Any:
    """Square roots."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return _call(builder, "sqrt", args[0])

    return value(value), generate


@_intrinsic
def flush_denormals(typing: Any, value: Any, least: Any) -> Any:
    """0 where the absolute value is below `least`, elsewhere the value."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        size = _call(builder, "fabs", args[0])
        return builder.select(
            builder.fcmp_ordered("<", size, _filled(builder, args[0].type, args[1])),
            ir.Constant(args[0].type, None),
            args[0],
        )

    return value(value, value.dtype), generate


@_intrinsic
def maximum(typing: Any, a: Any, b: Any) -> Any:
    """The larger of each pair; b where one is NaN."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.select(builder.fcmp_ordered(">", *args), *args)

    return a(a, b), generate


@_intrinsic
def minimum(typing: Any, a: Any, b: Any) -> Any:
    """The smaller of each pair; b where one is NaN."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.select(builder.fcmp_ordered("<", *args), *args)

    return a(a, b), generate


def _operator(sign: Callable[..., Any], instruction: str) -> None:
    """Two registers, or a register and a number of its type."""

    def typer(context: Any) -> Any:
        def kind(a: Any, b: Any) -> Any:
            register = a if isinstance(a, Lanes) else b
            fits = (register, getattr(register, "dtype", None))
            return register if isinstance(register, Lanes) and a in fits and b in fits else None

        return kind

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        register = context.get_value_type(signature.return_type)
        both = [
            arg if isinstance(kind, Lanes) else _filled(builder, register, arg)
            for kind, arg in zip(signature.args, args, strict=True)
        ]
        return getattr(builder, instruction)(*both)

    cast(Any, type_callable)(sign)(typer)
    for kinds in ((Lanes, Lanes), (Lanes, types.Float), (types.Float, Lanes)):
        cast(Any, lower_builtin)(sign, *kinds)(generate)


@cast(Any, type_callable)(operator.neg)
def _negative_type(context: Any) -> Any:
    return lambda value: value if isinstance(value, Lanes) else None


@cast(Any, lower_builtin)(operator.neg, Lanes)
def _negative(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    return builder.fneg(args[0])


_operator(operator.add, "fadd")
_operator(operator.sub, "fsub")
_operator(operator.mul, "fmul")
_operator(operator.truediv, "fdiv")
