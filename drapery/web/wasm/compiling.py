"""The process that compiles the module; `drapery.web.wasm.build` starts it."""

import sys
from pathlib import Path
from typing import Any

from drapery import jit

if __name__ == "__main__":
    # No kernel is imported yet. Registers of WebAssembly have 16 bytes. Where Python calls such
    # code, it writes anywhere in memory.
    jit.REGISTER = 16

from drapery import Banner, Settings
from drapery.garments import find_garment
from drapery.packs import open_packs
from drapery.scenes import (
    live_panels,
    live_picture,
    played_body,
    played_garment,
    repeating_garment,
)
from drapery.style import body_of
from drapery.web.wasm.build import METHODS
from drapery.web.wasm.compiler import ExportedKernel, compile_module
from drapery.web.wasm.image import types_of
from drapery.web.wasm.module import sources_hash
from drapery.web.wasm.plan import LANES, types_hash


def main(path: Path, methods: list[str]) -> None:
    """Write the module with the kernels of some methods."""
    kernels: dict[str, ExportedKernel] = {}
    hashes: dict[str, str] = {}
    for method in methods:
        options: Any = METHODS[method]
        settings = Settings(**options, light="game", time=0)
        if method == "player":
            cape = repeating_garment(find_garment("cape"), open_packs(()), settings)
            (panel,) = live_panels(played_garment(cape), LANES)
        else:
            body = body_of(Banner.parse("white"), open_packs(()), settings)
            if method == "picture":
                panel = live_picture(body, settings, LANES)
            else:
                (panel,) = live_panels(played_body(body, settings), LANES)
        for call in panel.calls.values():
            kernels[call.name] = ExportedKernel(call.name, call.function, types_of(call.arguments))
            hashes[call.name] = types_hash(call.arguments)
        for name, (function, example) in panel.functions.items():
            kernels[name] = ExportedKernel(name, function, types_of(example), by_address=True)
    info = {"sources": sources_hash(), "kernels": hashes}
    path.write_bytes(compile_module(list(kernels.values()), info, path.parent))


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
