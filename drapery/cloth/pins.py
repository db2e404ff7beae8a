"""Which particles are held, and the paths they follow."""

from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError
from drapery.mesh import Array

PinName = Literal["none", "top", "corners", "three-corners", "four-corners"]
Predicate = Callable[[Array], NDArray[np.bool_]]
Pins = PinName | Predicate | Sequence[int] | NDArray[np.integer]

PinPath = Callable[[float], Array]
"""Where the pinned particles are at a time [s]: positions [m], shape [P, 3] or [B, P, 3].

The order is that of the particles' numbers.
"""


def pinned_particles(
    pins: Pins, rest: Array, grid_shape: tuple[int, int] | None
) -> NDArray[np.int64]:
    """The sorted numbers of the pinned particles.

    pins: particle numbers; a predicate of the rest positions [N, 3] that returns a mask [N]; or
    a name: `none`; `top`, all particles at the greatest height; and for grids `corners` (the two
    on top), `three-corners` (all but the bottom right one), `four-corners`.
    Raises OptionError.
    """
    if isinstance(pins, str):
        return _named(pins, rest, grid_shape)
    if callable(pins):
        mask = np.asarray(pins(rest))
        if mask.shape != (len(rest),) or mask.dtype != np.bool_:
            raise OptionError(f"pins predicate must return {len(rest)} booleans, one a particle")
        return np.flatnonzero(mask)
    return _numbered(np.asarray(pins), len(rest))


def _numbered(numbers: NDArray[np.integer], count: int) -> NDArray[np.int64]:
    if numbers.size == 0:
        return np.empty(0, np.int64)
    if numbers.ndim != 1 or not np.issubdtype(numbers.dtype, np.integer):
        raise OptionError("pins must be whole particle numbers, a name or a predicate")
    outside = numbers[(numbers < 0) | (numbers >= count)]
    if outside.size:
        raise OptionError(f"pin {outside[0]} is not a particle; use 0 to {count - 1}")
    unique, uses = np.unique(numbers, return_counts=True)
    if (uses > 1).any():
        raise OptionError(f"pin {unique[uses > 1][0]} is given twice; name each particle once")
    return unique.astype(np.int64)


def _named(name: str, rest: Array, grid_shape: tuple[int, int] | None) -> NDArray[np.int64]:
    if name == "none":
        return np.empty(0, np.int64)
    if name == "top":
        heights = rest[:, 1]
        slack = 1e-6 * float(np.ptp(rest, axis=0).max())
        return np.flatnonzero(heights >= heights.max() - slack)
    if name not in ("corners", "three-corners", "four-corners"):
        known = "none, top, corners, three-corners, four-corners"
        raise OptionError(f"pins {name!r} is not known; use one of: {known}")
    if grid_shape is None:
        raise OptionError(f"pins {name!r} needs a grid; give particle numbers or a predicate")
    rows, columns = grid_shape
    corners = [0, columns - 1, (rows - 1) * columns, rows * columns - 1]
    return np.array(corners[: {"corners": 2, "three-corners": 3, "four-corners": 4}[name]])
