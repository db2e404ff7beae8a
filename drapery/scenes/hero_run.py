"""How the hero of pixels runs, jumps, lands and stands: a loop of a few seconds."""

from dataclasses import dataclass

import numpy as np

from drapery.mesh import Array
from drapery.style.hero import RUN

LOOP = 4.0
"""After this time the hero's motion repeats [s]."""
DISTANCE = 200
"""How far the hero runs in one loop [pixels]."""
RUNNING = ((0.0, 2.5), (3.3, 4.0))
"""When the hero runs, from and to [s]; it stands at other times."""
JUMP = (0.9, 1.7, 17.0)
"""Take-off and landing [s], and height [pixels]."""
FRAMES_PER_SECOND = 10
"""Frame rate of the running animation [1/s]."""


@dataclass(frozen=True)
class HeroState:
    """Where the hero is: its feet [pixels], how it moves [pixels/s], and its legs."""

    feet: Array
    velocity: Array
    legs: str


def hero_at(time: float) -> HeroState:
    """The hero at a time [s]."""
    rounds, moment = divmod(time + 1e-9, LOOP)
    spent = [min(max(moment - start, 0.0), end - start) for start, end in RUNNING]
    speed = DISTANCE / sum(end - start for start, end in RUNNING)
    runs = any(start <= moment < end for start, end in RUNNING)
    start, end, top = JUMP
    part = (moment - start) / (end - start)
    flies = 0 < part < 1
    height = 4 * top * part * (1 - part) if flies else 0.0
    climb = 4 * top * (1 - 2 * part) / (end - start) if flies else 0.0
    feet = np.array([DISTANCE * rounds + speed * sum(spent), -height])
    velocity = np.array([speed if runs else 0.0, -climb])
    return HeroState(feet, velocity, _legs(moment, runs, flies, climb))


def _legs(moment: float, runs: bool, flies: bool, climb: float) -> str:
    if flies:
        return "rise" if climb > 0 else "fall"
    return RUN[int(moment * FRAMES_PER_SECOND) % len(RUN)] if runs else "stand"
