"""Object files of what numba compiles, which can be stored and loaded without numba.

numba's own way needs numba in each process, which takes longer to import than a picture takes to
draw. Here a kernel gets a function that unpacks a block of words, see `drapery.jit.compiled`, and
the few functions for memory that kernels call, see `drapery.jit.runtime`.
"""

import pickle
import re
from typing import Any

import llvmlite.binding as llvm
import numba
from llvmlite import ir
from numba.core import types as numba_types
from numba.core.registry import cpu_target

from drapery.jit.arguments import pack
from drapery.jit.compiled import Result, word_count
from drapery.jit.kernel_cache import write_kernel
from drapery.jit.objects import CALL, KernelObject
from drapery.jit.runtime import add_runtime

_llvm: Any = llvm
_numba: Any = numba
_ir: Any = ir
_types: Any = numba_types
_context: Any = cpu_target.target_context
_SCALARS = {
    _types.none: "none",
    _types.int64: "int64",
    _types.boolean: "bool",
    _types.float64: "float64",
}
_WORD = ir.IntType(64)
_STATUS = ir.IntType(32)
OF_OTHERS = re.compile("NRT_|numba_|_?Py")
"""Names of functions that are in no library of C."""


def compile_kernel(entry_point: Any, types: tuple[str, ...], parameters: Any) -> KernelObject:
    """The machine code of an entry point, which is stored if another process can use it.

    types: of the arguments, see `drapery.jit.arguments`. parameters: the same for numba.
    """
    made, is_lasting = _compiled_object(entry_point.dispatcher, parameters)
    if is_lasting:
        write_kernel(entry_point, types, made)
    return made


def pickled_call(function: Any, arguments: tuple[Any, ...]) -> bytes:
    """The module and the name of an entry point, and the arguments of `compile_kernel`."""
    types = pack(arguments).types, types_of(arguments)
    return pickle.dumps((function.__module__, function.__qualname__, *types))


def types_of(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(_numba.typeof(each) for each in arguments)


def _compiled_object(dispatcher: Any, parameters: tuple[Any, ...]) -> tuple[KernelObject, bool]:
    """The machine code of a function for numba's types of its parameters, and whether another
    process can use it.

    Raises TypeError if the result is of a type that has no words.
    """
    dispatcher.compile(parameters)
    made = dispatcher.overloads[parameters]
    library, inner = made.library, made.fndesc.llvm_func_name
    result = result_type(made.fndesc.restype)
    caller = _llvm.parse_assembly(caller_module(made.fndesc, result, CALL, inner))
    machine = _llvm.Target.from_default_triple().create_target_machine(jit=True, opt=1)
    parts = library.serialize_using_object_code()[2][0], machine.emit_object(caller)
    is_lasting = not library.has_dynamic_globals and not _missing(library._final_module)
    return KernelObject(result, inner, parts), is_lasting


def _missing(module: Any) -> set[str]:
    """The functions of numba or of Python that code calls and that another process has not."""
    runtime = _ir.Module()
    add_runtime(runtime)
    called = {each.name for each in module.functions if each.is_declaration}
    return {name for name in called - set(runtime.globals) if OF_OTHERS.match(name)}


def result_type(kind: Any) -> Result:
    """The type of a result, from numba's. Raises TypeError."""
    kind = _types.unliteral(kind)
    if isinstance(kind, _types.BaseTuple):
        parts = [result_type(each) for each in kind]
        if "bool" not in parts and "none" not in parts:
            return parts
    if kind in _SCALARS:
        return _SCALARS[kind]
    raise TypeError(f"a kernel that Python calls cannot return {kind}")


def caller_module(described: Any, result: Result, name: str, inner: str) -> str:
    """The text of a module with a function that calls a kernel with a block of words, and with the
    functions that kernels call for memory.

    described: numba's description of the kernel. inner: the name of its function.
    """
    shape = _context.call_conv.get_function_type(described.restype, described.argtypes)
    module = _ir.Module()
    called = _ir.Function(module, shape, inner)
    caller = _ir.Function(module, _ir.FunctionType(_STATUS, [_WORD.as_pointer()]), name)
    builder = _ir.IRBuilder(caller.append_basic_block())
    (block,) = caller.args

    def place(index: int, pointer: Any) -> Any:
        return builder.bitcast(builder.gep(block, [_WORD(index)]), pointer)

    first = 1 + word_count(result)
    values = [
        builder.load(place(first + index, kind.as_pointer()))
        for index, kind in enumerate(shape.args[2:])
    ]
    returned, error = place(1, shape.args[0]), place(0, shape.args[1])
    builder.ret(builder.call(called, [returned, error, *values]))
    add_runtime(module)
    return str(module)
