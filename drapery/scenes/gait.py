"""How our figure walks: in place, over ground that moves past it.

In its own frame the air streams against it at the speed of its walk, so cloth behaves exactly as
on a figure that walks through still air.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from drapery.cloth import PinPath
from drapery.cloth.cloth import Cloth
from drapery.cloth.colliders import Box, Collider, Path, Pose, rotation_about
from drapery.cloth.exact import sine_of_turns
from drapery.mesh import Array
from drapery.style.figure import PARTS, TEXEL, Placed, to_metres

MAX_WALK = 10.0
"""The fastest walk [m/s]."""
LOOP = 4.0
"""After this time [s] a walk has come to a whole number of strides and of blocks."""
LEG, HALF_FOOT = 12 * TEXEL, 2 * TEXEL
ARM_SHARE = 0.6
"""Arms swing less than legs."""


@dataclass(frozen=True)
class Gait:
    """A steady walk. speed: over the ground [m/s]; period: of a stride, two steps [s]."""

    speed: float = 2.5
    period: float = 0.8

    @property
    def swing(self) -> float:
        """Of a leg to either side [degrees].

        In half a period the foot on the ground goes back by 2 L sin(swing), as the ground does.
        """
        return float(np.degrees(np.arcsin(min(self.speed * self.period / (4 * LEG), 0.9))))

    def poses(self, time: float) -> dict[str, Placed]:
        """Where each part of the figure is, by name."""
        return _poses(self, time)

    def turn(self, time: float) -> float:
        """How far the right leg is swung back [degrees]."""
        return self.swing * float(sine_of_turns(time / self.period))

    def lift(self, time: float) -> float:
        """Height of the hips over where they are at rest [m]: the lower foot stays on the ground.

        A leg of length L whose foot reaches h to either side stands L cos + h |sin| high.
        """
        turns = self.turn(time) / 360
        sine, cosine = float(sine_of_turns(turns)), float(sine_of_turns(turns + 0.25))
        return LEG * cosine + HALF_FOOT * abs(sine) - LEG

    def colliders(self, names: tuple[str, ...]) -> tuple[Collider, ...]:
        """The figure's parts of these names as moving boxes."""
        return tuple(
            Collider(Box(PARTS[name].centre, PARTS[name].extent), self._path(name))
            for name in names
        )

    def pins(self, cloth: Cloth) -> PinPath:
        """The path of a cloth's pins that are fastened to the body, from where they rest."""
        rest = cloth.rest_positions[cloth.inv_mass == 0]
        return lambda time: rest + np.array([0.0, self.lift(time), 0.0])

    def _path(self, name: str) -> Path:
        return lambda time: Pose(*self.poses(time)[name])


@lru_cache(maxsize=4)
def _poses(gait: Gait, time: float) -> dict[str, Placed]:
    """Kept for the moment: every part asks for it, at the end of a step and at its beginning."""
    angle = gait.turn(time)
    angles = {
        "head": 0.0,
        "body": 0.0,
        "right_leg": angle,
        "left_leg": -angle,
        "right_arm": -ARM_SHARE * angle,
        "left_arm": ARM_SHARE * angle,
    }
    lift = np.array([0.0, gait.lift(time), 0.0])
    return {name: _about_joint(name, degrees, lift) for name, degrees in angles.items()}


def _about_joint(name: str, degrees: float, lift: Array) -> Placed:
    rotation = rotation_about((1, 0, 0), degrees)
    joint = to_metres(np.array(PARTS[name].joint))
    return joint - (rotation * joint).sum(axis=1) + lift, rotation
