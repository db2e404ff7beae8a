"""Pinned particles, and the paths they follow."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Integers, Mask, Matrices, Vectors
from drapery.errors import OptionError, counted
from drapery.mesh import Array

PinName = Literal["none", "top", "corners", "three-corners", "four-corners"]
Predicate = Callable[[Vectors], Mask]
Pins = PinName | Predicate | Sequence[int] | Integers
"""Which particles are held: the name of some of a grid's, the particles' numbers, or a function
from the rest positions [m], shape [N, 3], to bools, shape [N]."""


class PinPath(Protocol):
    """A function that says where the pinned particles are.

    It takes a time [s] and returns positions [m], shape [P, 3] or [B, P, 3]. The P pins are in the
    order of the particles' numbers.
    """

    def __call__(self, time: float, /) -> Vectors: ...


class PosePath(Protocol):
    """A function that says where a rigid body is.

    It takes a time [s] and returns a rotation, shape [3, 3], and a translation [m], shape [3].
    """

    def __call__(self, time: float, /) -> tuple[Matrices, Vectors]: ...


@dataclass(frozen=True, eq=False)
class PinTable:
    """A `PinPath` that a solver asks for many times at once.

    at: positions of the P pins [m] at T times [s]: from shape [T] to [T, P, 3].
    """

    at: Callable[[Array], Array]

    def __call__(self, time: float) -> Array:
        """Positions of the pins [m] at one time [s], shape [P, 3]."""
        places: Array = self.at(np.array([time]))[0]
        return places


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
            raise OptionError(
                f"pins predicate must return {counted(len(rest), 'boolean')}, one a particle"
            )
        chosen: NDArray[np.int64] = np.flatnonzero(mask)
        return chosen
    try:
        numbers = np.asarray(pins)
    except ValueError:
        numbers = np.empty(1)
    return _numbered(numbers, len(rest))


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
    sorted_numbers: NDArray[np.int64] = unique.astype(np.int64)
    return sorted_numbers


def _named(name: str, rest: Array, grid_shape: tuple[int, int] | None) -> NDArray[np.int64]:
    if name == "none":
        return np.empty(0, np.int64)
    if name == "top":
        heights = rest[:, 1]
        slack = 1e-6 * float(np.ptp(rest, axis=0).max())
        top: NDArray[np.int64] = np.flatnonzero(heights >= heights.max() - slack)
        return top
    if name not in ("corners", "three-corners", "four-corners"):
        known = "none, top, corners, three-corners, four-corners"
        raise OptionError(f"pins {name!r} is not known; use one of: {known}")
    if grid_shape is None:
        raise OptionError(f"pins {name!r} needs a grid; give particle numbers or a predicate")
    rows, columns = grid_shape
    count = {"corners": 2, "three-corners": 3, "four-corners": 4}[name]
    return np.array([0, columns - 1, (rows - 1) * columns, rows * columns - 1], np.int64)[:count]


def carried(cloth_positions: Vectors, pinned: Integers, pose: PosePath) -> PinPath:
    """A path of pins that move with a rigid body.

    cloth_positions: of all particles at rest [m], shape [N, 3].
    pinned: the indices of those that are pinned, shape [P].
    pose: rotation, shape [3, 3], and translation [m], shape [3], of the body at a time [s]; the
        identity and 0 leave the pins at their positions.
    """
    places = cloth_positions[pinned]

    def path(time: float) -> Array:
        rotation, translation = pose(time)
        # Summed in a fixed order: the bits of a BLAS product differ between machines.
        turned: Array = (places[:, None, :] * np.asarray(rotation)[None]).sum(axis=-1)
        return turned + np.asarray(translation)

    return path
