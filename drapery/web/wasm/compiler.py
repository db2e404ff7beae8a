"""Kernels as one WebAssembly module, from the code that numba makes of their Python source.

numba compiles for a processor with 64-bit pointers. Before it is optimised its code does not yet
depend on their size, so it is given the target and the data layout of wasm32 and compiled from
there. Each kernel gets a function of one argument, the place of all its arguments in memory: see
`drapery.web.wasm.image`.
"""

import json
import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import llvmlite.binding as llvm

from drapery.web.wasm.binary import custom_section, function_names, trimmed
from drapery.web.wasm.image import FIRST_SLOT, SLOT, WasmBuildError

TRIPLE = "wasm32-unknown-unknown"
LAYOUT = "e-m:e-p:32:32-p10:8:8-p20:8:8-i64:64-i128:128-n32:64-S128-ni:1:10:20"
FEATURES = "+simd128,+bulk-memory,+nontrapping-fptoint"
"""All browsers since 2021 have these."""
STACK = 1 << 16
"""Bytes of the stack; kernels keep their arrays elsewhere."""

_llvm: Any = llvm


class ExportedKernel(NamedTuple):
    """A function to compile: its name in the module, and numba's types of its arguments.

    by_address: whether kernels call it, by the address that the function of this name returns.
    """

    name: str
    function: Any
    types: tuple[Any, ...]
    by_address: bool = False


def compile_module(kernels: list[ExportedKernel], info: Mapping[str, Any], folder: Path) -> bytes:
    """The module with these kernels. info: JSON for its section `drapery`, to which the numbers of
    the functions that each kernel needs are added, as `functions`.

    folder: for files on the way. numba must run with NUMBA_OPT=0 and without kernels in its cache.
    Raises WasmBuildError.
    """
    _llvm.initialize_all_targets()
    _llvm.initialize_all_asmprinters()
    whole = None
    for kernel in kernels:
        made = _typed_code(kernel)
        if whole is None:
            whole = made
        else:
            whole.link_in(made)
    assert whole is not None
    _keep_only(whole, {kernel.name for kernel in kernels})
    machine = _llvm.Target.from_triple(TRIPLE).create_target_machine(opt=3, features=FEATURES)
    _optimize(whole, machine)
    (folder / "kernels.o").write_bytes(machine.emit_object(whole))
    runtime = Path(__file__).with_name("runtime.c")
    target = ["-target", "wasm32-freestanding", "-mcpu=generic+simd128+bulk_memory"]
    _zig(folder, "cc", *target, "-O2", "-fno-builtin", "-c", str(runtime), "-o", "runtime.o")
    module = _linked(folder, [kernel.name for kernel in kernels])
    numbers = function_names(module)
    needed = {
        kernel.name: sorted(
            numbers[name] for name in function_names(_linked(folder, [kernel.name]))
        )
        for kernel in kernels
    }
    whole_info = {**info, "functions": needed}
    plain = trimmed(module, [*needed, "reserve"], range(len(numbers)))
    return plain + custom_section("drapery", json.dumps(whole_info).encode())


def _linked(folder: Path, exports: list[str]) -> bytes:
    """The module with these kernels, and the names of its functions."""
    named = [*(f"--export={name}" for name in exports), "--export=reserve"]
    _zig(
        folder,
        *("wasm-ld", "--no-entry", "--gc-sections", "--export-memory", f"-zstack-size={STACK}"),
        *(*named, "kernels.o", "runtime.o", "-o", "kernels.wasm"),
    )
    return (folder / "kernels.wasm").read_bytes()


def _optimize(code: Any, machine: Any) -> None:
    """Optimise the code for speed."""
    options = _llvm.create_pipeline_tuning_options(speed_level=3)
    builder = _llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(code, builder)


def _zig(folder: Path, *arguments: str) -> None:
    caches = {f"ZIG_{kind}_CACHE_DIR": str(folder / "zig") for kind in ("GLOBAL", "LOCAL")}
    command = [sys.executable, "-m", "ziglang", *arguments]
    done = subprocess.run(
        command, cwd=folder, env={**os.environ, **caches}, capture_output=True, text=True
    )
    if done.returncode:
        lines = done.stderr.strip().splitlines() or ["no reason is given"]
        raise WasmBuildError(f"ziglang {arguments[0]} failed: {lines[-1]}")


def _typed_code(kernel: ExportedKernel) -> Any:
    """A kernel and all it calls, for wasm32, with its function of one argument.

    References to arrays are not counted, which would keep loops from being optimised: the next call
    uses the memory of all arrays again. See `runtime.c`.
    """
    function = kernel.function
    function.compile(kernel.types)
    name = function.overloads[kernel.types].fndesc.llvm_func_name
    text = function.inspect_llvm(kernel.types)
    text = re.sub(r'target triple = ".*"', f'target triple = "{TRIPLE}"', text)
    text = re.sub(r'target datalayout = ".*"', f'target datalayout = "{LAYOUT}"', text)
    kinds = r"= (?:linkonce_odr|common) (?:local_unnamed_addr |unnamed_addr )?global"
    counting = r"(?ms)^define [^\n]*@(NRT_incref|NRT_decref)\(.*?^}"
    text = re.sub(counting, r"define internal void @\1(ptr) {\nret void\n}", text)
    code = _llvm.parse_assembly(re.sub(kinds, "= internal global", text))
    if kernel.by_address:  # contact is seldom, and large
        for each in code.functions:
            each.add_function_attribute("optsize")
    inner = code.get_function(name)
    parameters = [str(argument.type) for argument in inner.arguments]
    lines = (_address if kernel.by_address else _call)(kernel, name, parameters)
    head = [
        f'target triple = "{TRIPLE}"',
        f'target datalayout = "{LAYOUT}"',
        f'declare i32 @"{name}"({", ".join(parameters)})',
        "declare void @rewind()",
        "declare i32 @mark()",
        "declare void @release(i32)",
    ]
    wrapper = _llvm.parse_assembly("\n".join([*head, *lines]))
    inner.linkage = "external"
    code.link_in(wrapper)
    return code


def _address(kernel: ExportedKernel, inner: str, parameters: list[str]) -> list[str]:
    """The function that returns the address of a kernel, as text.

    What the kernel allocates is free again when it returns: it is called once for each step of a
    call, and nothing that it makes is used after.
    """
    given = ", ".join(f"{kind} %a{number}" for number, kind in enumerate(parameters))
    return [
        f'define internal i32 @"{kernel.name}.freeing"({given}) {{',
        "%top = call i32 @mark()",
        f'%code = call i32 @"{inner}"({given})',
        "call void @release(i32 %top)",
        "ret i32 %code",
        "}",
        f'define i32 @"{kernel.name}"() {{',
        f'ret i32 ptrtoint (ptr @"{kernel.name}.freeing" to i32)',
        "}",
    ]


def _call(kernel: ExportedKernel, inner: str, parameters: list[str]) -> list[str]:
    """The function of one argument, as text: it loads each argument of a kernel from its slot."""
    every = list(enumerate(parameters))
    given = [f"{kind} %{'p' if number < 2 else 'a'}{number}" for number, kind in every]
    return [
        f'define i32 @"{kernel.name}"(ptr %at) {{',
        *(f"%p{number} = getelementptr i8, ptr %at, i32 {_place(number)}" for number, _ in every),
        *(f"%a{number} = load {kind}, ptr %p{number}" for number, kind in every[2:]),
        "call void @rewind()",
        f'%code = call i32 @"{inner}"({", ".join(given)})',
        "ret i32 %code",
        "}",
    ]


def _place(number: int) -> int:
    """Where a parameter of a kernel lies; the first two are the result and the error."""
    return SLOT * number if number < 2 else FIRST_SLOT + SLOT * (number - 2)


def _keep_only(code: Any, exported: set[str]) -> None:
    """Make all other functions internal, so that those vanish which nothing calls."""
    for function in code.functions:
        if not function.is_declaration:
            function.linkage = "external" if function.name in exported else "internal"
