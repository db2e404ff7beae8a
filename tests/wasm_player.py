"""Plays plans in wasmtime, as `cloth.js` does in a browser."""

from typing import Any

import numpy as np
import wasmtime
from numpy.typing import NDArray

from drapery.web.wasm.plan import split_plan


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
        name, place = self.header["calls"][purpose]
        status = self._call(name, self.at + place)
        assert status == 0, f"{name} returned {status}"
        assert self._number(place, "<i8") == 0, f"{name} failed"

    def read(self, name: str) -> NDArray[Any]:
        place, kind, count = self.header["fields"][name]
        size = count * np.dtype(kind).itemsize
        found = self.memory.read(self.store, self.at + place, self.at + place + size)
        return np.frombuffer(bytes(found), kind)

    def write(self, name: str, *values: float) -> None:
        place, kind, count = self.header["fields"][name]
        assert len(values) == count
        self.memory.write(self.store, np.array(values, kind).tobytes(), self.at + place)

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
