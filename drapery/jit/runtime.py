"""What compiled kernels call for memory, as a part of their objects.

numba has these functions in a module of its own; here they need no numba. `calloc`, `malloc` and
`free` are those of the process.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite import ir
from numba.core import cgutils

_ir: Any = ir
_BYTE, _INT, _WORD = _ir.IntType(8), _ir.IntType(32), _ir.IntType(64)
_NOTHING = _ir.VoidType()
_BYTES, _WORDS = _BYTE.as_pointer(), _WORD.as_pointer()
for_range: Any = cgutils.for_range
REFERENCES, DATA, SIZE, HEADER = 0, 3, 4, 6
"""Words of numba's block before the memory that arrays share; kernels read and write them."""
MOST = 1 << 62
"""Bytes; no memory is as large, so that sums of a size and a few bytes do not overflow."""


def add_runtime(module: Any) -> None:
    """Define in a module the functions that numba's code calls for memory."""
    calloc = _ir.Function(module, _ir.FunctionType(_BYTES, [_WORD, _WORD]), "calloc")
    malloc = _ir.Function(module, _ir.FunctionType(_BYTES, [_WORD]), "malloc")
    free = _ir.Function(module, _ir.FunctionType(_NOTHING, [_BYTES]), "free")
    _add_alloc(module, calloc)
    for name in ("NRT_MemInfo_call_dtor", "NRT_Free"):
        builder, (block,) = _function(module, name, _NOTHING, _BYTES)
        builder.call(free, [block])
        builder.ret_void()
    _add_counting(module, free)
    builder, (block,) = _function(module, "NRT_MemInfo_data_fast", _BYTES, _BYTES)
    data = builder.gep(builder.bitcast(block, _WORDS), [_WORD(DATA)])
    builder.ret(builder.inttoptr(builder.load(data), _BYTES))
    builder, (size,) = _function(module, "NRT_Allocate", _BYTES, _WORD)
    some = builder.select(builder.icmp_unsigned("==", size, _WORD(0)), _WORD(1), size)
    builder.ret(builder.call(malloc, [some]))
    _add_reshape(module)


def _function(module: Any, name: str, result: Any, *parameters: Any) -> tuple[Any, Any]:
    function = _ir.Function(module, _ir.FunctionType(result, parameters), name)
    return _ir.IRBuilder(function.append_basic_block()), function.args


def _add_alloc(module: Any, calloc: Any) -> None:
    """Zeros with one reference to them, aligned to a power of two; null if no memory is left."""
    builder, (size, align) = _function(module, "NRT_MemInfo_alloc_aligned", _BYTES, _WORD, _INT)
    align = builder.zext(align, _WORD)
    null = _ir.Constant(_BYTES, None)
    with builder.if_then(builder.icmp_unsigned(">", size, _WORD(MOST))):
        builder.ret(null)
    header = builder.add(align, _WORD(8 * HEADER))
    block = builder.call(calloc, [_WORD(1), builder.add(header, size)])
    with builder.if_then(builder.icmp_unsigned("==", block, null)):
        builder.ret(null)
    first = builder.add(builder.ptrtoint(block, _WORD), builder.sub(header, _WORD(1)))
    data = builder.and_(first, builder.sub(_WORD(0), align))
    words = builder.bitcast(block, _WORDS)
    for index, value in ((REFERENCES, _WORD(1)), (DATA, data), (SIZE, size)):
        builder.store(value, builder.gep(words, [_WORD(index)]))
    builder.ret(block)


def _add_counting(module: Any, free: Any) -> None:
    """One reference more, and one less; the last one frees the memory. Nothing for null."""
    for name, change in (("NRT_incref", "add"), ("NRT_decref", "sub")):
        builder, (block,) = _function(module, name, _NOTHING, _BYTES)
        with builder.if_then(builder.icmp_unsigned("==", block, _ir.Constant(_BYTES, None))):
            builder.ret_void()
        count = builder.bitcast(block, _WORDS)
        before = builder.atomic_rmw(change, count, _WORD(1), "seq_cst")
        if change == "sub":
            with builder.if_then(builder.icmp_unsigned("==", before, _WORD(1))):
                builder.call(free, [block])
        builder.ret_void()


def _add_reshape(module: Any) -> None:
    """Whether an array can be reshaped without a copy, and its new strides: only one that is
    contiguous in the order of C can. Kernels reshape no others."""
    kinds = (_WORD, _WORDS, _WORDS, _WORD, _WORDS, _WORDS, _WORD, _INT)
    builder, parts = _function(module, "numba_attempt_nocopy_reshape", _INT, *kinds)
    count, shape, strides, new_count, new_shape, new_strides, item, is_fortran = parts
    with builder.if_then(builder.icmp_unsigned("!=", is_fortran, _INT(0))):
        builder.ret(_INT(0))
    step = builder.alloca(_WORD)
    with _axes(builder, count, shape, step, item) as (axis, size):
        stride = builder.load(builder.gep(strides, [axis]))
        is_apart = builder.icmp_unsigned("!=", stride, builder.load(step))
        has_more = builder.icmp_unsigned("!=", size, _WORD(1))
        with builder.if_then(builder.and_(is_apart, has_more)):
            builder.ret(_INT(0))
    with _axes(builder, new_count, new_shape, step, item) as (axis, _):
        builder.store(builder.load(step), builder.gep(new_strides, [axis]))
    builder.ret(_INT(1))


@contextmanager
def _axes(builder: Any, count: Any, shape: Any, step: Any, item: Any) -> Iterator[tuple[Any, Any]]:
    """A loop over the axes, the last first: each with its size, and its stride in `step`."""
    builder.store(item, step)
    with for_range(builder, count) as loop:
        axis = builder.sub(builder.sub(count, loop.index), _WORD(1))
        size = builder.load(builder.gep(shape, [axis]))
        yield axis, size
        builder.store(builder.mul(builder.load(step), size), step)
