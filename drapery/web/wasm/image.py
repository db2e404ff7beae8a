"""The arguments of kernels as they lie in the memory of a WebAssembly module.

numba passes a structure member by member: a named tuple becomes its fields, an array its data's
place, its shape and its strides. `numba.core.datamodel` knows the members and their order. Each
gets a slot of eight bytes in a block, which one call of a kernel reads. Blocks and arrays make up
an image; its pointers count from its start, and who loads it adds the place it is loaded to.
"""

import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numba
import numpy as np
from numba.core import datamodel, types
from numpy.typing import NDArray

from drapery.errors import DraperyError

SLOT = 8
"""Bytes of an argument."""
FIRST_SLOT = 2 * SLOT
"""Bytes before the first argument: room for the result of a kernel, then for an error."""
ALIGNED = 64
"""Arrays begin at multiples of this number of bytes."""

_typeof: Any = numba.typeof
_types: Any = types
_datamodel: Any = datamodel


class WasmBuildError(DraperyError):
    """The WebAssembly module cannot be built, or kernels cannot be called in it."""


def canonical(value: Any) -> Any:
    """Named tuples and their arrays as kernels are compiled for: rows in order, writable."""
    if isinstance(value, np.ndarray):
        return np.require(value, None, ["C", "A", "W"])
    if isinstance(value, tuple):
        parts = [canonical(part) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value


def types_of(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """The types for which numba compiles a kernel with these arguments."""
    return tuple(_typeof(canonical(argument)) for argument in arguments)


@dataclass
class Image:
    """Blocks of arguments and arrays, with what changes when they are loaded to a place.

    data: the content. pointers: places of 32-bit pointers. functions: places of the addresses of
    kernels, and their names.
    """

    data: bytearray = field(default_factory=bytearray)
    pointers: list[int] = field(default_factory=list)
    functions: list[tuple[int, str]] = field(default_factory=list)
    _arrays: dict[int, tuple[int, NDArray[Any]]] = field(default_factory=dict)

    def add_array(self, array: NDArray[Any]) -> int:
        """The place of an array; the same object has only one."""
        if id(array) not in self._arrays:
            self._arrays[id(array)] = self._add(canonical(array).tobytes()), array
        return self._arrays[id(array)][0]

    def add_call(self, arguments: tuple[Any, ...], addresses: Mapping[str, str]) -> int:
        """The place of a block of arguments.

        addresses: names of fields that hold the address of a kernel, and the names of the kernels.
        """
        slots = [
            slot
            for argument, kind in zip(arguments, types_of(arguments), strict=True)
            for slot in self._slots(argument, kind, addresses)
        ]
        place = self._add(bytes(FIRST_SLOT + SLOT * len(slots)))
        for number, (form, value) in enumerate(slots):
            at = place + FIRST_SLOT + SLOT * number
            if form == "pointer":
                self.pointers.append(at)
            elif form == "function":
                self.functions.append((at, value))
            if form != "function":
                packed = struct.pack("<d" if form == "number" else "<q", value)
                self.data[at : at + SLOT] = packed
        return place

    def _add(self, content: bytes) -> int:
        self.data += bytes(-len(self.data) % ALIGNED)
        place = len(self.data)
        self.data += content
        return place

    def _slots(
        self, value: Any, kind: Any, addresses: Mapping[str, str]
    ) -> Iterator[tuple[str, Any]]:
        """The members of an argument in the order of its data model, each with its form."""
        if isinstance(kind, _types.Array):
            yield from self._array_slots(value, kind)
        elif isinstance(kind, _types.BaseTuple):
            names = getattr(value, "_fields", None) or [""] * len(value)
            for name, part, inner in zip(names, value, kind.types, strict=True):
                if name in addresses:
                    yield ("function", addresses[name]) if part else ("whole", 0)
                else:
                    yield from self._slots(part, inner, addresses)
        elif isinstance(kind, (_types.Integer, _types.Boolean)):
            yield "whole", int(value)
        elif isinstance(kind, _types.Float):
            yield "number", float(value)
        else:
            raise WasmBuildError(f"an argument of type {kind} cannot be put into memory")

    def _array_slots(self, array: NDArray[Any], kind: Any) -> Iterator[tuple[str, Any]]:
        rows = canonical(array)
        known = {
            "meminfo": [("whole", 0)],
            "parent": [("whole", 0)],
            "nitems": [("whole", rows.size)],
            "itemsize": [("whole", rows.itemsize)],
            "data": [("pointer", self.add_array(array))],
            "shape": [("whole", side) for side in rows.shape],
            "strides": [("whole", side) for side in rows.strides],
        }
        for name in _datamodel.default_manager.lookup(kind)._fields:
            yield from known[name]
