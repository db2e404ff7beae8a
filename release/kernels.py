"""Compile the kernels of the usual pictures into one library: `python -m release.kernels`.

The library is written beside `drapery/jit/library.py`, which loads it, for the platform on which
this runs. A wheel that is built afterwards holds it. Pictures are drawn and the calls of kernels
noted; numba translates each kernel for the types of its arguments; LLVM compiles the result for
any processor of the platform (x86-64 with AVX2); `zig cc` links. It needs llvmlite and ziglang.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

TRIPLES = {
    ("linux", "x86_64"): ("x86_64-unknown-linux-gnu", "x86_64-linux-gnu.2.17"),
    ("linux", "arm64"): ("aarch64-unknown-linux-gnu", "aarch64-linux-gnu.2.17"),
    ("darwin", "x86_64"): ("x86_64-apple-macosx11.0", "x86_64-macos.11.0"),
    ("darwin", "arm64"): ("arm64-apple-macosx11.0", "aarch64-macos.11.0"),
    ("win32", "x86_64"): ("x86_64-pc-windows-gnu", "x86_64-windows-gnu"),
}
"""LLVM's and zig's name of each platform."""
PROCESSORS = {"x86_64": ("x86-64", "+avx2"), "arm64": ("", "")}
"""The processor and further registers that the code is compiled for."""
PICTURES: tuple[dict[str, Any], ...] = (
    {},
    {"view": "hero", "shadow": True, "samples": 4},
    {"contact": "none", "wind": 0.0},
    {"grid": (33, 65)},
    {"solver": "desbrun"},
    {"solver": "desbrun", "grid": (9, 17)},
    {"kind": "shield"},
)
"""Options of the pictures whose kernels are compiled."""


@dataclass(frozen=True)
class Call:
    """A kernel and the types of its arguments, as `drapery.jit.library` and as numba names them."""

    kernel: Any
    types: tuple[str, ...]
    signature: tuple[Any, ...]

    @property
    def name(self) -> str:
        return f"{self.kernel.__module__}.{self.kernel.__qualname__}"


def recorded_calls() -> list[Call]:
    """The kernels that the pictures call, each with its types, in the order of their names."""
    from drapery import Banner, draw, iter_frames
    from drapery.cloth import grid
    from drapery.jit import EntryPoint
    from drapery.jit.arguments import pack
    from drapery.jit.codegen import types_of
    from drapery.style import cover_crowd, make_shell

    found: dict[tuple[str, tuple[str, ...]], Call] = {}
    run, look_up = EntryPoint.__call__, EntryPoint.compiled

    def note(kernel: Any, arguments: tuple[Any, ...]) -> None:
        call = Call(kernel, pack(arguments).types, types_of(arguments))
        found.setdefault((call.name, call.types), call)

    def noted_run(self: Any, *arguments: Any) -> Any:
        note(self, arguments)
        return run(self, *arguments)

    def noted_look_up(self: Any, arguments: tuple[Any, ...]) -> Any:
        note(self, arguments)
        return look_up(self, arguments)

    EntryPoint.__call__, EntryPoint.compiled = noted_run, noted_look_up  # type: ignore[method-assign]
    banner = Banner.parse("white creeper:lime border:black")
    for options in PICTURES:
        draw(banner, **{"size": (32, 32), "time": 0.1, **options})
    list(iter_frames(banner, seconds=0.1, fps=20, size=(32, 32)))
    cloth = grid(2, 2, 1.0, 1.0)  # crowds are covered by a kernel
    shell = make_shell(cloth.triangles, cloth.uvs)
    cover_crowd(shell, cloth.rest_positions[None].astype(float), 0.1)
    EntryPoint.__call__, EntryPoint.compiled = run, look_up  # type: ignore[method-assign]
    return [found[key] for key in sorted(found)]


def compiled(
    call: Call, number: int, triple: str, processor: tuple[str, str]
) -> tuple[bytes, dict[str, Any]]:
    """The object file of a kernel with a function that unpacks its arguments; what it is."""
    import llvmlite.binding as llvm

    from drapery.jit.codegen import caller_module, result_type

    made = call.kernel.dispatcher.overloads[call.signature].fndesc
    about = {"types": call.types, "result": result_type(made.restype)}
    about |= {"symbol": f"drapery_call_{number}", "inner": f"drapery_inner_{number}"}
    text = call.kernel.dispatcher.inspect_llvm(call.signature)
    text = re.sub(r'target triple = ".*"', f'target triple = "{triple}"', text)
    text = re.sub(r'target datalayout = ".*"\n', "", text)
    text = text.replace(made.llvm_func_name, str(about["inner"]))
    code = llvm.parse_assembly(text)
    caller = caller_module(made, about["result"], about["symbol"], about["inner"])
    code.link_in(llvm.parse_assembly(caller))
    machine = llvm.Target.from_triple(triple).create_target_machine(
        cpu=processor[0], features=processor[1], opt=3, reloc="pic", codemodel="default"
    )
    code.data_layout = str(machine.target_data)
    code.verify()
    for each in [*code.functions, *code.global_variables]:
        if not each.is_declaration and each.name not in about.values():
            each.linkage = "internal"
    options = llvm.create_pipeline_tuning_options(speed_level=3)
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(code, builder)
    if "numba.dynamic.globals" in str(code):
        raise SystemExit(f"{call.name} holds an address of this process; leave it to numba")
    return machine.emit_object(code), about


def build(path: Path, platform: tuple[str, str], calls: list[Call]) -> None:
    """Write the library of a platform with the kernels of some calls."""
    import llvmlite.binding as llvm

    from drapery.jit.arguments import ABI
    from drapery.jit.library import SYMBOL
    from drapery.jit.sources import source_key

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    triple, target = TRIPLES[platform]
    kernels: dict[str, list[dict[str, Any]]] = {}
    sources: dict[str, str | None] = {}
    with tempfile.TemporaryDirectory() as folder:
        objects = []
        for number, call in enumerate(calls):
            content, about = compiled(call, number, triple, PROCESSORS[platform[1]])
            objects.append(Path(folder, f"{number}.o"))
            objects[-1].write_bytes(content)
            kernels.setdefault(call.name, []).append(about)
            sources[call.name] = source_key(call.kernel)
            print(f"{call.name}: {len(content) / 1000:.0f} kB, {len(call.types)} types")
        description = json.dumps({"abi": ABI, "sources": sources, "kernels": kernels})
        text = f"const char *{SYMBOL}(void) {{ return {json.dumps(description)}; }}\n"
        describe = Path(folder, "description.c")
        describe.write_text(text, encoding="utf-8")
        link = [sys.executable, "-m", "ziglang", "cc", "-shared", "-O2", "-s", "-target", target]
        if platform[0] == "linux":
            link.append("-Wl,--no-undefined")
        subprocess.run([*link, "-o", path, *objects, describe], check=True)
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB")


def main() -> None:
    """Build the library of this platform."""
    # Unoptimised code from numba, which LLVM optimises for the platform. The cache has no text.
    with tempfile.TemporaryDirectory() as cache:
        os.environ |= {"NUMBA_OPT": "0", "NUMBA_CACHE_DIR": cache, "DRAPERY_AOT": "0"}
        from drapery.jit.library import library_path, machine

        build(library_path(), (sys.platform, machine()), recorded_calls())


if __name__ == "__main__":
    main()
