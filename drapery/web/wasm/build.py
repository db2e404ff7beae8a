"""Build the WebAssembly module of the kernels: `python -m drapery.web.wasm.build`.

It needs the extra `web-build`. The module is written into the package, from where wheels take it;
`--cache` writes it beside the kernels that numba has compiled, `--only METHOD` compiles the kernels
of one method: xpbd, xpbdsheet, desbrun, desbrunsheet, picture, or player.
"""

import argparse
import importlib.util
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from drapery.errors import DraperyError, counted
from drapery.module_process import module_command
from drapery.user_files import reason
from drapery.web.wasm.image import WasmBuildError
from drapery.web.wasm.module import module_places

METHODS = {
    "xpbdsheet": {"solver": "xpbd", "grid": (16, 31)},
    "xpbd": {"solver": "xpbd", "grid": (5, 9)},
    "desbrunsheet": {"solver": "desbrun", "grid": (16, 31)},
    "desbrun": {"solver": "desbrun", "grid": (5, 9)},
    "picture": {"solver": "desbrun", "grid": (5, 9), "view": "front"},
    "player": {"solver": "desbrun"},
}
"""The methods that step a cloth, each with settings that use it; what draws a picture; and what
poses a player, with a cape that is stepped as a banner is."""


def build_module(path: Path, methods: Sequence[str] = tuple(METHODS)) -> None:
    """Build the module for some methods and write it to a path. Raises WasmBuildError."""
    if importlib.util.find_spec("ziglang") is None:
        raise WasmBuildError("ziglang is not installed; install drapery-mc[web-build]")
    with tempfile.TemporaryDirectory() as folder:
        # Code that is optimised for 64-bit pointers, or comes from the cache, is of no use here.
        own = {"NUMBA_OPT": "0", "NUMBA_CACHE_DIR": folder, "NUMBA_NUM_THREADS": "1"}
        made = Path(folder) / "module.wasm"
        command = module_command("drapery.web.wasm.compiling", str(made), *methods)
        done = subprocess.run(command, env={**os.environ, **own}, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            lines = done.stderr.strip().splitlines() or ["no reason is given"]
            raise WasmBuildError(f"the kernels cannot be compiled: {lines[-1]}")
        path.parent.mkdir(parents=True, exist_ok=True)
        draft = path.with_name(f"{path.name}.{os.getpid()}")
        draft.write_bytes(made.read_bytes())
        draft.replace(path)


def main(arguments: Sequence[str] | None = None) -> int:
    """The command; returns its exit status."""
    parser = argparse.ArgumentParser("python -m drapery.web.wasm.build", description=__doc__)
    parser.add_argument("--cache", action="store_true", help="write beside numba's kernels")
    parser.add_argument("--only", choices=METHODS, action="append", help="a method to compile")
    given = parser.parse_args(arguments)
    places = module_places()
    path = places[-1 if given.cache else 0]
    try:
        build_module(path, given.only or tuple(METHODS))
        for other in () if given.cache else path.parent.glob("kernels-*.wasm"):
            if other != path:
                other.unlink(missing_ok=True)  # it belongs to older sources
    except DraperyError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"error: {path}: {reason(error)}", file=sys.stderr)
        return 1
    print(f"{path}: {counted(path.stat().st_size, 'byte')}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
