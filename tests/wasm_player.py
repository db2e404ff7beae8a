"""Plays plans in wasmtime, as `cloth.js` does in a browser."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import wasmtime
from numpy.typing import NDArray

from drapery import Banner, Settings
from drapery.packs import open_packs
from drapery.style import Body, body_of
from drapery.web.wasm.build import build_module
from drapery.web.wasm.module import module_info, module_places
from drapery.web.wasm.plan import split_plan

QUICK = ("desbrun", "xpbd", "xpbdsheet", "picture", "player")
"""The methods of the module that the tests build: the compilation of each takes 15 s or more. The
studio's own settings need `xpbdsheet`, and its capes `xpbd`."""


@cache
def built_module() -> bytes:
    """The module, with the kernels of at least the methods in QUICK; it is built once for the
    sources and kept beside numba's kernels."""
    path = module_places()[-1]
    path.parent.mkdir(parents=True, exist_ok=True)
    with _locked(Path(f"{path}.lock")):
        if not path.is_file() or not _has_all(path.read_bytes()):
            build_module(path, QUICK)
    return path.read_bytes()


def _has_all(module: bytes) -> bool:
    """Whether a module has the methods in QUICK; another program may have built it for less."""
    kernels = module_info(module)["kernels"]
    return {"play_desbrun", "play_xpbd", "play_xpbdsheet", "draw", "pose"} <= kernels.keys()


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Only one process at a time is here; on Windows several may do the same work."""
    with path.open("wb") as lock:
        if sys.platform != "win32":
            import fcntl

            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def quick_settings(**options: Any) -> Settings:
    """Settings of a banner that the module of the tests can play."""
    return Settings(**{"solver": "desbrun", "grid": (5, 9), **options})


def white_banner(settings: Settings) -> Body:
    return body_of(Banner.parse("white"), open_packs(()), settings)


class WasmPlayer:
    """A cloth in an instance of the module of its own."""

    def __init__(self, module: bytes, plan: bytes) -> None:
        self.store = wasmtime.Store()
        made = wasmtime.Module(self.store.engine, module)
        self.exports = wasmtime.Instance(self.store, made, []).exports(self.store)
        self.header, image = split_plan(plan)
        self.at = self._call("reserve", self.header["image"])
        self.memory: Any = self.exports["memory"]
        self.memory.write(self.store, image, self.at)
        for place in self.header["pointers"]:
            self._put(place, self.at + self._number(place, "<u4"), "<u4")
        for place, name in self.header["functions"]:
            self._put(place, self._call(name), "<i8")
        self.run("aim")

    def run(self, purpose: str) -> None:
        name, place, _ = self.header["calls"][purpose]
        status = self._call(name, self.at + place)
        assert status == 0, f"{name} returned {status}"
        assert self._number(place, "<i8") == 0, f"{name} failed"

    def read(self, name: str) -> NDArray[Any]:
        place, kind, count, _ = self.header["fields"][name]
        size = count * np.dtype(kind).itemsize
        found = self.memory.read(self.store, self.at + place, self.at + place + size)
        return np.frombuffer(bytes(found), kind)

    def write(self, name: str, *values: float) -> None:
        place, kind, count, _ = self.header["fields"][name]
        assert len(values) == count
        self.memory.write(self.store, np.array(values, kind).tobytes(), self.at + place)

    def image(self) -> bytes:
        """The memory of the cloth."""
        return bytes(self.memory.read(self.store, self.at, self.at + self.header["image"]))

    def step(self, steps: int) -> None:
        self.write("clock", self.read("clock")[0], steps)
        self.run("play")

    def _call(self, name: str, *arguments: int) -> int:
        function: Any = self.exports[name]
        return int(function(self.store, *arguments))

    def _number(self, place: int, kind: str) -> int:
        start = self.at + place
        found = self.memory.read(self.store, start, start + np.dtype(kind).itemsize)
        return int(np.frombuffer(bytes(found), kind)[0])

    def _put(self, place: int, value: int, kind: str) -> None:
        self.memory.write(self.store, np.array([value], kind).tobytes(), self.at + place)
