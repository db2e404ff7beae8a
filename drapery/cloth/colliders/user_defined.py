"""Shapes that a user defines by a signed distance function.

The function is compiled once, when the first collider with it is made, and the kernels call it by
its address. So the kernels are compiled once for all shapes. The time of a step depends on the
time of the function.
"""

import inspect
import re
import threading
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, Protocol, TypeGuard

import numpy as np
from numpy.typing import ArrayLike

from drapery.arrays import Floats
from drapery.cloth.colliders.fields import USER_DEFINED, Field
from drapery.cloth.colliders.vectors import Vector
from drapery.errors import OptionError
from drapery.jit import numba_name
from drapery.mesh import Array

DistanceFunction = Callable[[Vector, Floats], float]
GradientFunction = Callable[[Vector, Floats], Vector]


class SignedDistance(Protocol):
    """What an object needs to be the shape of a `Collider`. No base class is needed.

    signed_distance: a function of (point, parameters), as a static method or an attribute, that
        numba can compile: it uses only numbers, `math` and `numpy`. The point is a tuple x, y, z
        [m] in the shape's frame, the parameters are the array below. It returns the distance to
        the surface [m], negative inside. A value below the true distance is correct but slower; a
        value above it lets points pass through the shape. `check_collider` tests this.
    parameters: numbers that the function reads, shape [K]; K may be 0.
    bounds: low and high corner [m], shape [2, 3], of a box in the shape's frame that contains the
        whole surface; infinite where the shape is unbounded.

    An optional attribute `gradient`, a function of (point, parameters) that returns the outward
    unit direction (x, y, z), replaces central differences of the distance.

    Compiled functions stay in memory until the program ends. Use one function with different
    parameters, not a new function for each collider.
    """

    @property
    def signed_distance(self) -> DistanceFunction: ...

    @property
    def parameters(self) -> Sequence[float] | Floats: ...

    @property
    def bounds(self) -> ArrayLike: ...


class _Compiled(NamedTuple):
    """Compiled functions; they must live as long as their addresses are in use."""

    distance: Any
    gradient: Any


_CALLS = "drapery.cloth.colliders.user_calls"
call_distance = numba_name(_CALLS, "call_distance")
call_gradient = numba_name(_CALLS, "call_gradient")
_compiled: dict[tuple[DistanceFunction, GradientFunction | None], _Compiled] = {}
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_lock = threading.Lock()
"""The lock while a function is looked up or compiled, so that each has one address."""


def is_user_defined(shape: object) -> TypeGuard[SignedDistance]:
    """Whether a shape defines its signed distance."""
    return hasattr(shape, "signed_distance")


def pack_user_defined(shape: SignedDistance) -> Field:
    """A shape as the kernels read it. Raises OptionError."""
    name = f"collider {type(shape).__name__}"
    for wanted in ("parameters", "bounds"):
        if not hasattr(shape, wanted):
            raise OptionError(f"{name} has no {wanted}; add them, see SignedDistance")
    parameters, bounds = _parameters(name, shape.parameters), _bounds(name, shape.bounds)
    gradient: GradientFunction | None = getattr(shape, "gradient", None)
    _try(name, shape.signed_distance, parameters)
    with _lock:
        key = shape.signed_distance, gradient
        if key not in _compiled:
            _compiled[key] = _compile(name, *key)
        made = _compiled[key]
    field = Field(
        USER_DEFINED,
        parameters,
        bounds,
        0.0,
        distance_address=made.distance.address,
        gradient_address=made.gradient.address if made.gradient else 0,
    )
    _check_samples(name, made.distance, field)
    return field


def _parameters(name: str, value: Sequence[float] | Array) -> Array:
    try:
        numbers = np.array(value, float)
    except (TypeError, ValueError):
        raise OptionError(f"{name}: parameters {value!r} are not numbers") from None
    if numbers.ndim != 1 or not np.isfinite(numbers).all():
        raise OptionError(f"{name}: parameters {value!r} are out of range; give finite numbers [K]")
    return numbers


def _bounds(name: str, value: ArrayLike) -> Array:
    try:
        corners = np.array(value, float)
    except (TypeError, ValueError):
        corners = np.zeros(0)
    if corners.shape != (2, 3) or not (corners[0] < corners[1]).all():
        raise OptionError(
            f"{name}: bounds {value!r} are not a box; give its low and high corner [2, 3]"
        )
    return corners


def _try(name: str, function: DistanceFunction, parameters: Array) -> None:
    """Call the function in Python first: its errors are clearer than the compiler's."""
    if inspect.ismethod(function):
        raise OptionError(f"{name}: signed_distance is a method; make it a static method")
    plain = getattr(function, "py_func", function)
    try:
        distance = plain((0.125, 0.25, 0.5), parameters)
    except Exception as fault:
        reason = f"{type(fault).__name__}: {fault}"
        raise OptionError(
            f"{name}: signed_distance(point, parameters) raised {_line(reason)}"
        ) from fault
    if np.ndim(distance) != 0 or not np.isreal(distance):
        raise OptionError(
            f"{name}: signed_distance returned {_line(repr(distance))}; return one number"
        )


def _compile(name: str, distance: DistanceFunction, gradient: GradientFunction | None) -> _Compiled:
    # Imported here: most collisions need no numba.
    from drapery.cloth.colliders.user_calls import compile_distance, compile_gradient

    return _Compiled(
        _callable(name, "signed_distance", distance, compile_distance),
        _callable(name, "gradient", gradient, compile_gradient) if gradient else None,
    )


def _callable(name: str, what: str, function: Any, compile: Callable[[Any], Any]) -> Any:
    from numba.core.errors import NumbaError

    try:
        return compile(function)
    except NumbaError as fault:
        raise OptionError(
            f"{name}: numba cannot compile its {what} ({_reason(fault)}); "
            "use numbers, math and numpy only"
        ) from fault


def _check_samples(name: str, compiled: Any, field: Field) -> None:
    """Raises OptionError unless the distance is finite over the bounds."""
    low, high = np.clip(field.bounds, -10.0, 10.0)
    first = field.numbers.ctypes.data_as(compiled.ctypes.argtypes[3])
    for part in np.ndindex(5, 5, 5):
        x, y, z = (float(c) for c in low + (high - low) * (np.array(part) + 0.01) / 4.02)
        distance = compiled.ctypes(x, y, z, first, field.numbers.size)
        if not np.isfinite(distance):
            raise OptionError(
                f"{name}: signed_distance at ({x:g}, {y:g}, {z:g}) m is {distance}; "
                "return a finite number everywhere"
            )


def _reason(fault: Exception) -> str:
    """The first line of numba's message that is about the function."""
    lines = [_COLOUR.sub("", line).strip() for line in str(fault).splitlines()]
    lines = [line for line in lines if line and not line.startswith("Failed in nopython mode")]
    return _line(lines[0] if lines else type(fault).__name__)


def _line(text: str) -> str:
    return " ".join(text.split())[:160]
