"""Two banners of fine grids as wireframes."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain

import numpy as np

from drapery.cloth import Cloth, Gravity, State, Wind
from drapery.render import Scene, View, frame_points
from drapery.scenes.banners import flag_cloth
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion, placed
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    wind_parameter,
)
from drapery.scenes.wires import DAYLIGHT, PAPER, paper, wired
from drapery.style import FLAG_SIZE

LOOP = 4.0
SIDE_ON = View(azimuth=30, elevation=4, fov=26)
FILL = paper((236, 233, 224))
SPACING = 1.1
"""From one banner to the next [m]."""


@dataclass(frozen=True)
class WireframeParameters(SceneParameters):
    """What can be set of the scene `wireframe`."""

    left: tuple[int, int] = grid_parameter((9, 17), "Particles across and down the left flag")
    right: tuple[int, int] = grid_parameter((17, 33), "The same of the right flag")
    wind: float = wind_parameter(6.0)
    springs: bool = parameter(
        False, "Shows all springs by kind: structural dark, shear orange, flexion green"
    )
    seed: int = seed_parameter()


def play(parameters: WireframeParameters, clip: Clip) -> Iterator[Scene]:
    """Two flags beside each other."""
    shapes = (parameters.left, parameters.right)
    cloths = [
        placed(flag_cloth(shape), np.array([SPACING * place, 0, 0]))
        for place, shape in enumerate(shapes)
    ]
    motions = [_waving(parameters, cloth, clip) for cloth in cloths]
    room = np.array(
        [[x, y, z] for x in (-0.45, 1.56) for y in (0.06, -FLAG_SIZE[1]) for z in (0, 0.6)]
    )
    camera = frame_points(SIDE_ON, room, clip.size[0] / clip.size[1], margin=0.04)
    for states in zip(*motions, strict=True):
        models = chain.from_iterable(
            wired(cloth, state.positions[0], camera, clip.size[1], FILL, parameters.springs)
            for cloth, state in zip(cloths, states, strict=True)
        )
        yield Scene(tuple(models), camera, clip.size, DAYLIGHT, PAPER, samples=4)


def _waving(parameters: WireframeParameters, cloth: Cloth, clip: Clip) -> Iterator[State]:
    velocity = (0.35 * parameters.wind, 0.0, 0.94 * parameters.wind)
    wind = Wind(velocity, gusts=0.5, gust_size=1.0, seed=parameters.seed, period=LOOP)
    return motion(cloth, clip, forces=(Gravity(), wind), settle=2 * LOOP, step=1 / 60)
