"""Run kernels as the Python functions that they are written as, so that NumPy checks each index.

Import this before anything of `drapery.cloth`: it replaces the decorators of `drapery.jit`. numba
takes minutes to compile the kernels of all solvers with their indices checked; a few particles move
a few steps in Python in seconds.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from drapery import jit
from drapery.jit.arguments import pack

_at_address: list[tuple[Callable[..., Any], list[str]]] = []
"""The functions that are called by address, and the types for which each is compiled."""
_called: set[int] = set()


def _as_it_is(function: Callable[..., Any]) -> Callable[..., Any]:
    return function


def _types(arguments: tuple[Any, ...]) -> list[str]:
    """The types that compiled kernels see: numbers of NumPy are those of Python."""
    plain = {"|b1": "bool", "<i4": "int64", "<i8": "int64", "<f8": "float64"}
    return [plain.get(kind, kind) for kind in pack(arguments).types]


def _address_of(function: Callable[..., Any], example: tuple[Any, ...]) -> int:
    _at_address.append((function, _types(example)))
    return len(_at_address) - 1


def _call_by_address(
    result: type | None, example: tuple[Any, ...] | None = None
) -> Callable[..., Any]:
    """A call whose first arguments are of the types of the example: code for others would read
    wrong memory. Raises TypeError."""

    def call(address: Any, arguments: tuple[Any, ...]) -> Any:
        function, wanted = _at_address[address]
        if address not in _called:
            _called.add(address)
            if (types := _types(arguments)) != wanted:
                raise TypeError(f"{function.__name__} is compiled for {wanted}, not for {types}")
        return function(*arguments)

    return call


def _lane_count(array: Any) -> int:
    return int(jit.REGISTER // array.itemsize)


def _register(array: Any, row: Any, lane: Any) -> Any:
    """The numbers of a register, a view. Raises IndexError unless all are inside of the array."""
    rows, lanes = array.shape
    if not (0 <= row < rows and 0 <= lane <= lanes - _lane_count(array)):
        raise IndexError(f"a register at [{row}, {lane}] of {array.shape}")
    return array[row, lane : lane + _lane_count(array)]


def _load(array: Any, row: Any, lane: Any) -> Any:
    return _register(array, row, lane).copy()


def _store(array: Any, row: Any, lane: Any, value: Any) -> None:
    _register(array, row, lane)[:] = value


def _flush_denormals(value: Any, least: Any) -> Any:
    return np.where(np.abs(value) < least, value.dtype.type(0), value)


def _fill(number: Any) -> Any:
    return np.full(jit.REGISTER // number.itemsize, number)


def _filter_velocities(both: Any, filter: Any, pins: Any) -> None:
    from drapery.cloth import filters, kernels

    by_band = isinstance(filter, filters.BandFilter)
    (kernels.filter_by_band if by_band else kernels.filter_by_products)(both, filter, pins)


def _restore_angular_momentum(g: Any, x: Any, v: Any, spin: Any, work: Any) -> None:
    from drapery.cloth import kernels
    from drapery.cloth.spin import NoSpin

    by_nothing = isinstance(spin, NoSpin)
    (kernels.no_correction if by_nothing else kernels.subtract_spin)(g, x, v, spin, work)


_NAMES: dict[str, Callable[..., Any]] = {
    "fill": _fill,
    "filter_velocities": _filter_velocities,
    "flush_denormals": _flush_denormals,
    "lane_count": _lane_count,
    "load": _load,
    "maximum": lambda a, b: np.where(a > b, a, b),
    "minimum": lambda a, b: np.where(a < b, a, b),
    "restore_angular_momentum": _restore_angular_momentum,
    "sqrt": np.sqrt,
    "store": _store,
}


def _numba_name(module: str, name: str, plain: str | None = None) -> Any:
    return _NAMES.get(name)


for name, replacement in {
    "kernel": _as_it_is,
    "borrowing_kernel": _as_it_is,
    "entry_point": _as_it_is,
    "numba_name": _numba_name,
    "call_by_address": _call_by_address,
    "address_of": _address_of,
}.items():
    setattr(jit, name, replacement)
