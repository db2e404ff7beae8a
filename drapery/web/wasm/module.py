"""The built module: where it is, and for which sources it is valid."""

import hashlib
import json
from collections.abc import Collection
from functools import cache
from itertools import chain
from pathlib import Path
from types import ModuleType
from typing import Any

import drapery.cloth
import drapery.render
import drapery.style
from drapery.jit.kernel_cache import kernel_cache_status
from drapery.web.wasm.binary import custom_content, custom_section, trimmed
from drapery.web.wasm.image import WasmBuildError

HERE = Path(__file__).parent
BUILDERS = "binary.py", "compiler.py", "compiling.py", "image.py", "runtime.c"
COMMON = "elementary.py", "jit/__init__.py", "jit/calls.py"
"""Files of Drapery's own folder that kernels are compiled with."""


@cache
def sources_hash() -> str:
    """A hash of all sources on which the module's code and the layout of its memory depend."""
    total = hashlib.sha256()
    packages = drapery.cloth, drapery.style, drapery.render
    sources = [*chain(*(sorted(_folder(package).rglob("*.py")) for package in packages))]
    common, builders = (
        (HERE.parents[1] / name for name in COMMON),
        (HERE / name for name in BUILDERS),
    )
    for path in (*sources, *common, *builders):
        total.update(hashlib.sha256(path.read_bytes()).digest())
    return total.hexdigest()[:16]


def _folder(package: ModuleType) -> Path:
    return Path(str(package.__file__)).parent


def module_places() -> list[Path]:
    """Where the module may be: in the package, else with the kernels that numba compiled."""
    name, folder = f"kernels-{sources_hash()}.wasm", kernel_cache_status().folder
    return [HERE / name, *([folder / "web" / name] if folder else [])]


def is_module_built() -> bool:
    """Whether the module is built for these sources."""
    return any(path.is_file() for path in module_places())


def read_module() -> bytes:
    """The module. Raises WasmBuildError where it is not built for these sources."""
    for path in module_places():
        if path.is_file():
            return path.read_bytes()
    raise WasmBuildError(
        "the WebAssembly module of the kernels is not built; "
        "run python -m drapery.web.wasm.build (needs drapery-mc[web-build])"
    )


def module_info(module: bytes) -> dict[str, Any]:
    """What the build wrote into the module: `sources`, `kernels` by name with their types, and
    `functions`, the numbers of those that each kernel needs."""
    content = custom_content(module, "drapery")
    if content is None:
        raise WasmBuildError("the WebAssembly module was not built by drapery.web.wasm.build")
    found: dict[str, Any] = json.loads(content)
    return found


def smallest_module(kernels: Collection[str]) -> bytes:
    """The module with only these kernels. Raises WasmBuildError where it is not built."""
    module = read_module()
    info = module_info(module)
    needed = {number for name in kernels for number in info["functions"][name]}
    named = json.dumps({"sources": info["sources"]}).encode()
    return trimmed(module, {*kernels, "reserve"}, needed) + custom_section("drapery", named)
