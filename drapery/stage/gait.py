"""The walk of the figure: it walks in place, and the ground passes below.

In the figure's own frame the air comes from ahead at the speed of the walk, so cloth moves exactly
as on a figure that walks through still air.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from drapery.cloth import Box, Collider
from drapery.elementary import sine_of_turns
from drapery.garments.poses import BonePoses
from drapery.mesh import Array
from drapery.style.figure import PARTS, TEXEL, WING_JOINTS, FigurePart
from drapery.style.horse import HORSE_PARTS

MAX_WALK = 10.0
"""The fastest walk [m/s]."""
LEG, HALF_FOOT = 12 * TEXEL, 2 * TEXEL
"""Length of a leg, and half the length of its foot [m]."""
ARM_SHARE = 0.6
"""The swing of an arm over the swing of a leg."""
FIGURES: Mapping[str, Mapping[str, FigurePart]] = {"player": PARTS, "horse": HORSE_PARTS}
"""Who walks, by name."""


@dataclass(frozen=True)
class Gait:
    """A steady walk. speed: over the ground [m/s]. period: of a stride, which is two steps [s].

    figure: who walks, of FIGURES; the arms of a horse are its front legs.
    """

    speed: float = 2.5
    period: float = 0.8
    figure: str = "player"

    @property
    def parts(self) -> Mapping[str, FigurePart]:
        """The parts of the figure by name."""
        return FIGURES[self.figure]

    @cached_property
    def swing(self) -> float:
        """How far a leg swings to the front and to the back [degrees].

        In half a period the foot on the ground moves back by 2 L sin(swing), as the ground does.
        """
        return math.degrees(math.asin(min(self.speed * self.period / (4 * LEG), 0.9)))

    @cached_property
    def poses(self) -> BonePoses:
        """Where each part of the figure is; the wings of a player follow its body."""
        wings = WING_JOINTS if self.figure == "player" else ()
        return BonePoses((*self.parts, *wings), self._table)

    def turn(self, times: Any) -> Any:
        """How far the right leg is turned backwards [degrees] at a time or an array of them [s]."""
        return self.swing * sine_of_turns(np.asarray(times, float) / self.period)

    def lift(self, times: Any) -> Any:
        """Height of the hips above their place at rest [m] at a time or an array of them [s].

        The lower foot stays on the ground: the hip of a leg of length L, whose foot has the half
        length h, is L cos + h |sin| high.
        """
        sine, cosine = _sine_cosine(self.turn(times))
        return LEG * cosine + HALF_FOOT * abs(sine) - LEG

    def raised(self, time: float) -> Array:
        """How far what moves with the hips is from its place at rest [m], shape [3]."""
        return np.array([0, self.lift(time), 0])

    def colliders(self, names: tuple[str, ...]) -> tuple[Collider, ...]:
        """The figure's parts of these names as moving boxes."""
        return tuple(
            Collider(Box(self.parts[name].centre, self.parts[name].extent), self.poses.path(name))
            for name in names
        )

    def _table(self, times: Array) -> Array:
        """Place [m] and rotation matrix of each part at T times [s], shape [T, K, 12]."""
        bones, turn = self.poses.bones, self.turn(times)
        arms = ARM_SHARE if self.figure == "player" else 1.0
        shares = {"right_leg": 1.0, "left_leg": -1.0, "right_arm": -arms, "left_arm": arms}
        degrees = np.zeros((len(times), len(bones)))
        for name, share in shares.items():
            degrees[:, bones.index(name)] = share * turn
        return _about_joints(self._pivots, degrees, self.lift(times))

    @cached_property
    def _pivots(self) -> Array:
        bones = ("body" if name in WING_JOINTS else name for name in self.poses.bones)
        return np.array([self.parts[name].pivot for name in bones])


def _sine_cosine(degrees: Any) -> tuple[Any, Any]:
    return sine_of_turns(degrees / 360), sine_of_turns(degrees / 360 + 0.25)


def _about_joints(pivots: Array, degrees: Array, lift: Array) -> Array:
    """Place [m] and rotation matrix of parts that are turned about the x axis, shape [T, K, 12].

    The rotations are equal to those of `rotation_about`.
    pivots: joint of each part at rest [m], shape [K, 3].
    degrees: how far each is turned, shape [T, K].
    lift: of all of them [m], shape [T].
    """
    sine, cosine = _sine_cosine(degrees)
    along = cosine + (1 - cosine)
    x, y, z = pivots.T
    table = np.zeros((*degrees.shape, 12))
    table[..., 0] = x - along * x
    table[..., 1] = y - (cosine * y - sine * z) + lift[:, None]
    table[..., 2] = z - (sine * y + cosine * z)
    table[..., 3] = along
    table[..., 7], table[..., 8] = cosine, -sine
    table[..., 10], table[..., 11] = sine, cosine
    return table
