"""The library of kernels of this platform: finding it, checking it, calling it.

A wheel for a platform holds one shared library with the kernels of the usual pictures, so that the
first picture does not wait for a compiler, and no command waits for the import of numba. The code
comes from the same source as numba's own, in strict IEEE arithmetic, so it gives the same bits.
`python -m release.kernels` in a checkout builds the library. Without a library, or if it was built
from other sources, numba compiles every kernel when it is first called, and it is stored.
"""

import ctypes
import json
import os
import platform
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from drapery.jit.arguments import ABI
from drapery.jit.compiled import CompiledKernel
from drapery.jit.sources import source_key

OFF = "DRAPERY_AOT"
"""The variable of the environment that turns the library off if it is 0."""
SYMBOL = "drapery_kernels"
"""The function of the library that returns its description, a JSON text."""
ENDINGS = {"linux": "so", "darwin": "dylib", "win32": "dll"}


def machine() -> str:
    """The kind of processor, as it is in names of files."""
    return {"amd64": "x86_64", "aarch64": "arm64"}.get(name := platform.machine().lower(), name)


def library_path() -> Path:
    """Where the library of this platform is, if there is one."""
    name = f"kernels-{sys.platform}-{machine()}.{ENDINGS.get(sys.platform, 'so')}"
    return Path(__file__).with_name(name)


def kernels_of(entry_point: Any) -> dict[tuple[str, ...], CompiledKernel]:
    """The compiled code of a function by the types of its arguments; empty if there is none."""
    found = installed_library()
    name = f"{entry_point.__module__}.{entry_point.__qualname__}"
    if found is None or name not in found[1]["kernels"]:
        return {}
    loaded, description = found
    if description["sources"][name] != source_key(entry_point):
        return {}
    return {tuple(each["types"]): _compiled(loaded, each) for each in description["kernels"][name]}


@cache
def installed_library() -> tuple[ctypes.CDLL, dict[str, Any]] | None:
    """The library and its description; None if there is none that this processor can run."""
    path = library_path()
    if os.environ.get(OFF) == "0" or not path.is_file() or not has_registers():
        return None
    try:
        loaded = ctypes.CDLL(str(path))
        describe = getattr(loaded, SYMBOL)
        describe.restype = ctypes.c_char_p
        description = json.loads(describe())
    except (OSError, AttributeError, ValueError):
        return None  # damaged or for another platform: numba compiles the kernels instead
    return (loaded, description) if description.get("abi") == ABI else None


def has_registers() -> bool:
    """Whether the processor has the registers that the library is compiled for."""
    if machine() != "x86_64":
        return True
    try:
        numpy: Any = import_module("numpy._core._multiarray_umath")
    except ImportError:
        return False
    return bool(getattr(numpy, "__cpu_features__", {}).get("AVX2"))


def _compiled(loaded: ctypes.CDLL, description: dict[str, Any]) -> CompiledKernel:
    call = getattr(loaded, description["symbol"])
    call.argtypes, call.restype = [ctypes.c_void_p], ctypes.c_int
    address = ctypes.cast(getattr(loaded, description["inner"]), ctypes.c_void_p).value
    return CompiledKernel(call, address or 0, description["result"], loaded)
