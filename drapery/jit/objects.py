"""Compiled kernels as bytes, which LLVM's loader puts into memory; numba is not needed for it."""

import ctypes
import json
from contextlib import suppress
from functools import cache
from typing import Any, NamedTuple

import llvmlite.binding as llvm

from drapery.jit.compiled import CompiledKernel, Result

CALL = "drapery_call"
"""The function of an object that takes a block of words."""

_llvm: Any = llvm
_Function = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)


class KernelObject(NamedTuple):
    """The machine code of one kernel.

    result: the type of what it returns. inner: the name of the function that kernels call.
    parts: object files.
    """

    result: Result
    inner: str
    parts: tuple[bytes, ...]

    def to_bytes(self) -> bytes:
        sizes = [len(part) for part in self.parts]
        header = {"result": self.result, "inner": self.inner, "sizes": sizes}
        return b"\n".join([json.dumps(header).encode(), b"".join(self.parts)])

    @classmethod
    def from_bytes(cls, content: bytes) -> "KernelObject":
        header, _, code = content.partition(b"\n")
        about = json.loads(header)
        parts = []
        for size in about["sizes"]:
            parts.append(code[:size])
            code = code[size:]
        return cls(about["result"], about["inner"], tuple(parts))


def load(kernel: KernelObject) -> CompiledKernel:
    """Put a kernel into the memory of this process."""
    _begin()
    machine = _llvm.Target.from_default_triple().create_target_machine(jit=True)
    engine = _llvm.create_mcjit_compiler(_llvm.parse_assembly(""), machine)
    for part in kernel.parts:
        engine.add_object_file(_llvm.ObjectFileRef.from_data(part))
    engine.finalize_object()
    call = _Function(engine.get_function_address(CALL))
    return CompiledKernel(call, engine.get_function_address(kernel.inner), kernel.result, engine)


@cache
def _begin() -> None:
    """Make LLVM ready for this processor."""
    with suppress(RuntimeError):  # from llvmlite 0.45 on this happens by itself
        _llvm.initialize()
    _llvm.initialize_native_target()
    _llvm.initialize_native_asmprinter()


def processor() -> str:
    """The processor and its features, as LLVM names them."""
    return f"{_llvm.get_host_cpu_name()} {_llvm.get_host_cpu_features().flatten()}"
