"""Where a collider is: a rigid pose, and a path of poses through time."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from drapery.arrays import Floats, Matrices, Vectors
from drapery.elementary import sine_of_turns
from drapery.errors import OptionError
from drapery.mesh import Array


@dataclass(frozen=True, eq=False)
class Pose:
    """A rigid pose: the point p of a shape is at rotation · p + position in the world.

    position: [m], shape [3].
    rotation: rotation matrix, shape [3, 3].
    """

    position: Vectors = field(default_factory=lambda: np.zeros(3))
    rotation: Matrices = field(default_factory=lambda: np.eye(3))


Path = Callable[[float], Pose]
"""The pose at a time [s]; it is called for the start and the end of every step."""


@dataclass(frozen=True, eq=False)
class TablePath:
    """The `Path` of one of K bodies that move together, which contact asks for many times at once.

    table: place [m] and rotation matrix of each body at T times [s]: from shape [T] to [T, K, 12].
    body: its number.
    """

    table: Callable[[Array], Array]
    body: int

    def __call__(self, time: float) -> Pose:
        """The pose at one time [s]."""
        row = self.at(np.array([time]))[0]
        return Pose(row[:3], row[3:].reshape(3, 3))

    def at(self, times: Array) -> Array:
        """Place [m] and rotation matrix at T times [s], shape [T, 12]."""
        rows: Array = self.table(times)[:, self.body]
        return rows


STILL = Pose()


def at_rest(time: float) -> Pose:
    """The path of a collider that does not move."""
    return STILL


def straight(velocity: tuple[float, float, float]) -> Path:
    """The path of a collider that moves from the origin at time 0 with this velocity [m/s]."""
    step = np.asarray(velocity, float)
    return lambda time: Pose(position=step * time)


def swinging(pivot: tuple[float, float, float], swing: float, period: float, phase: float) -> Path:
    """The path of a walking leg, which swings about the x axis.

    pivot: the point about which it swings [m].
    swing: largest angle to either side [degrees].
    period: [s], above 0.
    phase: fraction of a period, 0 to 1.

    Raises OptionError for a period that is not above 0.
    """
    centre = np.asarray(pivot, float)
    if not period > 0:
        raise OptionError(f"period {period} s is out of range; use a number of seconds above 0")

    def pose(time: float) -> Pose:
        rotation = rotation_about((1, 0, 0), swing * float(sine_of_turns(time / period + phase)))
        return Pose(centre - (rotation * centre).sum(axis=1), rotation)

    return pose


def rotation_about(axis: tuple[float, float, float], angle: float | Floats) -> Matrices:
    """Rotation matrices about an axis by Rodrigues' formula, one an angle, shape [..., 3, 3].

    axis: its direction, of any length above 0.
    angle: [degrees], a number or an array of any shape [...].

    Raises OptionError for an axis without a direction.
    """
    length = float(np.sqrt(np.square(axis).sum()))
    if not (np.isfinite(length) and length > 0):
        raise OptionError(f"axis {axis} has no direction; use finite numbers that are not all 0")
    x, y, z = unit = np.asarray(axis, float) / length
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turns = np.asarray(angle, float)[..., None, None] / 360
    sine, cosine = sine_of_turns(turns), sine_of_turns(turns + 0.25)
    rotation: Array = cosine * np.eye(3) + sine * cross + (1 - cosine) * np.outer(unit, unit)
    return rotation
