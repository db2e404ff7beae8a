"""Plans: what a page needs to play a panel of cloth, as one binary file."""

import hashlib
import json
from typing import Any

from drapery.scenes import LivePanel, PlayedSubject, live_panels
from drapery.web.wasm.image import Image, WasmBuildError, types_of
from drapery.web.wasm.module import module_info, read_module

LANES = 4
"""Lanes of a cloth's arrays: the register of WebAssembly holds four float32."""

FAULTS = {
    "play": "the cloth has blown up; use a weaker wind",
    "draw": "the cloth is outside the picture",
}
"""What it means that a kernel fails, by the purpose of its call."""
WRITERS = {
    **dict.fromkeys(("vertices", "normals", "light"), "cover"),
    **dict.fromkeys(("figure", "figureLight"), "pose"),
}
"""The calls that write arrays which a host reads, where it is not `play`."""


def plans_of(played: PlayedSubject) -> list[bytes]:
    """The plans of a subject's cloths, in their order, at the start of the motion.

    Raises OptionError for cloth that cannot be played, and WasmBuildError without the module.
    """
    info = module_info(read_module())
    return [write_plan(panel, info) for panel in live_panels(played, LANES)]


def write_plan(panel: LivePanel, info: dict[str, Any]) -> bytes:
    """A plan for the module with this `module_info`. Raises WasmBuildError if it has no kernels
    for the panel."""
    image, addresses = Image(), {name: name for name in panel.functions}
    calls = {}
    for purpose, kernel in panel.calls.items():
        if info["kernels"].get(kernel.name) != types_hash(kernel.arguments):
            raise WasmBuildError(
                f"the WebAssembly module has no kernel {kernel.name} for this cloth"
            )
        fault = FAULTS.get(purpose, f"the kernel {kernel.name} has failed")
        calls[purpose] = [kernel.name, image.add_call(kernel.arguments, addresses), fault]
    header = {
        **panel.header,
        "module": info["sources"],
        "calls": calls,
        "fields": {
            name: [image.add_array(array), array.dtype.name, array.size, WRITERS.get(name)]
            for name, array in panel.arrays.items()
        },
        "image": len(image.data),
        "pointers": image.pointers,
        "functions": image.functions,
    }
    text = json.dumps(header, separators=(",", ":")).encode()
    text += b" " * (-(len(text) + 4) % 16)
    return len(text).to_bytes(4, "little") + text + bytes(image.data).rstrip(b"\0")


def types_hash(arguments: tuple[Any, ...]) -> str:
    """A hash of the types for which a kernel is compiled."""
    return hashlib.sha256(str(types_of(arguments)).encode()).hexdigest()[:16]


def split_plan(plan: bytes) -> tuple[dict[str, Any], bytes]:
    """The header of a plan, and its image without the zeros at its end."""
    start = 4 + int.from_bytes(plan[:4], "little")
    return json.loads(plan[4:start]), plan[start:]


def kernels_of(plan: bytes) -> set[str]:
    """The names of the kernels that a plan calls."""
    header, _ = split_plan(plan)
    return {name for name, *_ in header["calls"].values()} | {
        name for _, name in header["functions"]
    }
