"""Two banners of fine grids as wireframes."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.cloth import Gravity
from drapery.render import Scene, View
from drapery.scenes.backdrop import framing
from drapery.scenes.banners import FLAG_STEP, flag_cloth
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import LOOP, looped_wind, motion, placed
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    wind_parameter,
)
from drapery.scenes.wires import on_paper, paper, wired
from drapery.style import FLAG_SIZE

SIDE_ON = View(azimuth=30, elevation=4, fov=26)
FILL = paper((236, 233, 224))
PLACES = ((0.0, 0.0, 0.0), (1.1, 0.0, 0.0))
"""Of the middles of their top edges [m]."""
FRAMED = [[x, y, z] for x in (-0.45, 1.56) for y in (0.06, -FLAG_SIZE[1]) for z in (0, 0.6)]
"""Both flags in the wind [m]."""


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
    p, wind = parameters, looped_wind(parameters.wind, parameters.seed, gust_size=1.0)
    cloths = [
        placed(flag_cloth(shape), np.array(at))
        for shape, at in zip((p.left, p.right), PLACES, strict=True)
    ]
    settle = 2 * LOOP
    motions = [
        motion(cloth, clip, forces=(Gravity(), wind), settle=settle, step=FLAG_STEP)
        for cloth in cloths
    ]
    backdrop = on_paper(framing(SIDE_ON, FRAMED, clip.size, margin=0.04))
    for states in zip(*motions, strict=True):
        yield backdrop.scene(
            model
            for cloth, state in zip(cloths, states, strict=True)
            for model in wired(cloth, state.positions[0], backdrop, FILL, p.springs)
        )
