"""A flag on a tower, seen from afar: few bend points are enough for much wind."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from drapery.cloth import State, Wind
from drapery.garments import SewnCloth
from drapery.packs import open_packs
from drapery.render import Camera, Scene
from drapery.scenes.banners import flag_materials
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import in_wind, motion
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)
from drapery.scenes.stroll import cloths_of
from drapery.style.block_world import Cell, blocks
from drapery.style.scenery import SKY, post

LOOP = 4.0
RESOLUTION = 12
"""The flag is 4/3 as large as the garment."""
TOWER, POLE = 5, 6.0
"""Height of the tower [blocks] and of the pole on it [m]."""
FOOT = np.array([0.0, TOWER + 1.0, 0.0])
RAISED = FOOT + np.array([0.0, 0.8, 0.0])
"""From the garment's origin, so that the flag ends below the top of the pole [m]."""


@dataclass(frozen=True)
class FlagParameters(SceneParameters):
    """What can be set of the scene `flag`."""

    design: str = parameter(
        "white stripe_left:red stripe_right:red rhombus:yellow circle:red",
        "Design of a banner that lies on its side",
    )
    wind: float = wind_parameter(9.0)
    grid: tuple[int, int] = grid_parameter((4, 7), "Particles across and along the flag")
    thickness: float = thickness_parameter()
    seed: int = seed_parameter()


def play(parameters: FlagParameters, clip: Clip) -> Iterator[Scene]:
    """The tower on its hill; only the flag moves."""
    packs, sewn = open_packs(()), flag_cloth(parameters)
    still = (*blocks(_hill(), packs), post(FOOT, POLE, packs, 0.12))
    for state in flag_states(parameters, sewn, clip):
        flag = sewn.models(state.positions[0] + RAISED)
        yield Scene((*still, *flag), _camera(), clip.size, background=SKY, samples=4)


def flag_cloth(parameters: FlagParameters) -> SewnCloth:
    """The garment `flag` with another design."""
    (sewn,) = cloths_of("flag", parameters.thickness, parameters.grid, RESOLUTION)
    (material,) = flag_materials((parameters.design,), open_packs(()))
    return replace(sewn, pieces=(replace(sewn.pieces[0], material=material),))


def flag_states(parameters: FlagParameters, sewn: SewnCloth, clip: Clip) -> Iterator[State]:
    """The flag at each frame, in a wind from the left."""
    velocity = (0.97 * parameters.wind, 0.0, 0.24 * parameters.wind)
    wind = Wind(velocity, gusts=0.7, gust_size=2.5, seed=parameters.seed, period=LOOP)
    return motion(sewn.cloth, clip, forces=in_wind(sewn.cloth, wind), settle=LOOP)


def _hill() -> dict[Cell, str]:
    cells: dict[Cell, str] = {}
    for x in range(-9, 9):
        for z in range(-9, 9):
            radius = max(2.0, np.hypot(x + 0.5, z + 0.5) + 0.7 * ((x * 7 + z * 5) % 3 - 1))
            height = min(0, 1 - int(radius // 3.4))
            for y in range(-3, height - 1):
                cells[x, y, z] = "dirt"
            if height > -3:
                cells[x, height - 1, z] = "grass"
    cells.update(_tower())
    return cells


def _tower() -> dict[Cell, str]:
    """A tower with battlements, some of its blocks of older stone."""
    cells: dict[Cell, str] = {}
    for x in range(-2, 2):
        for z in range(-2, 2):
            for y in range(TOWER + 1):
                old = (5 * x + 3 * y + 7 * z) % 4 == 0
                cells[x, y, z] = "cobblestone" if old else "stone_bricks"
    for x in range(-3, 3):
        for z in range(-3, 3):
            if x in (-3, 2) or z in (-3, 2):
                cells[x, TOWER, z] = "stone_bricks"
                if (x + z) % 2 == 0:
                    cells[x, TOWER + 1, z] = "stone_bricks"
    return cells


def _camera() -> Camera:
    return Camera((15.0, 7.5, 36.0), (1.0, 6.3, 0.0), fov=22, near=5, far=90)
