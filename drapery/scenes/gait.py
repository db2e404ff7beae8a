"""The walk of the figure: it walks in place, and the ground passes below.

In the figure's own frame the air comes from ahead at the speed of the walk, so cloth moves exactly
as on a figure that walks through still air.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from drapery.cloth.colliders import Box, Collider, Path, Pose
from drapery.elementary import sine_of_turn
from drapery.style.figure import PARTS, TEXEL, WING_JOINTS, FigurePart, Placed
from drapery.style.horse import HORSE_PARTS

MAX_WALK = 10.0
"""The fastest walk [m/s]."""
LOOP = 4.0
"""In this time a walk makes a whole number of strides and passes a whole number of blocks [s]."""
LEG, HALF_FOOT = 12 * TEXEL, 2 * TEXEL
"""Length of a leg, and half the length of its foot [m]."""
ARM_SHARE = 0.6
"""The swing of an arm over that of a leg."""
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

    @property
    def swing(self) -> float:
        """How far a leg swings to the front and to the back [degrees].

        In half a period the foot on the ground moves back by 2 L sin(swing), as the ground does.
        """
        return math.degrees(math.asin(min(self.speed * self.period / (4 * LEG), 0.9)))

    def poses(self, time: float) -> Mapping[str, Placed]:
        """Where each part of the figure is, by name."""
        return _poses(self, time)

    def turn(self, time: float) -> float:
        """How far the right leg is turned backwards [degrees]."""
        return self.swing * sine_of_turn(float(time) / self.period)

    def lift(self, time: float) -> float:
        """Height of the hips above their place at rest [m]; the lower foot stays on the ground.

        The hip of a leg of length L, whose foot has the half length h, is L cos + h |sin| high.
        """
        sine, cosine = _sine_cosine(self.turn(time))
        return LEG * cosine + HALF_FOOT * abs(sine) - LEG

    def colliders(self, names: tuple[str, ...]) -> tuple[Collider, ...]:
        """The figure's parts of these names as moving boxes."""
        return tuple(
            Collider(Box(self.parts[name].centre, self.parts[name].extent), self._path(name))
            for name in names
        )

    def _path(self, name: str) -> Path:
        return lambda time: Pose(*self.poses(time)[name])


@dataclass(frozen=True, eq=False)
class WalkPoses(Mapping[str, Placed]):
    """Where each part of a figure is, computed when it is asked for: pins of a cape need one part.

    parts: of the figure. angles: how far each is turned backwards [degrees]. lift: of all [m].
    """

    parts: Mapping[str, FigurePart]
    angles: Mapping[str, float]
    lift: float
    _found: dict[str, Placed] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Placed:
        if name not in self._found:
            turned = self.angles[name]
            # Wings follow the body.
            part = self.parts["body" if name in WING_JOINTS else name]
            self._found[name] = _about_joint(part, turned, self.lift)
        return self._found[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.angles)

    def __len__(self) -> int:
        return len(self.angles)


@lru_cache(maxsize=4)
def _poses(gait: Gait, time: float) -> WalkPoses:
    """Cached, since every part asks for the poses at the beginning and the end of a step."""
    angle = gait.turn(time)
    arms = ARM_SHARE if gait.figure == "player" else 1.0
    angles = {
        "head": 0.0,
        "body": 0.0,
        "right_leg": angle,
        "left_leg": -angle,
        "right_arm": -arms * angle,
        "left_arm": arms * angle,
    }
    if gait.figure == "player":
        angles |= dict.fromkeys(WING_JOINTS, 0.0)
    return WalkPoses(gait.parts, angles, gait.lift(time))


@lru_cache(maxsize=8)
def _sine_cosine(degrees: float) -> tuple[float, float]:
    return sine_of_turn(degrees / 360), sine_of_turn(degrees / 360 + 0.25)


def _about_joint(part: FigurePart, degrees: float, lift: float) -> Placed:
    """A part turned about the x axis, in numbers: arrays of three would take several times as long.

    The bits are those of `rotation_about`.
    """
    sine, cosine = _sine_cosine(degrees)
    along = cosine + (1 - cosine)
    x, y, z = part.pivot.tolist()
    place = x - along * x, y - (cosine * y - sine * z) + lift, z - (sine * y + cosine * z)
    rotation = np.array([[along, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    return np.array(place), rotation
