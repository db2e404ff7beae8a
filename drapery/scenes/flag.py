"""A flag on a tower, seen from afar: few bend points are enough for much wind."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.cloth import State
from drapery.garments import SewnCloth
from drapery.packs import open_packs
from drapery.render import Camera, Scene
from drapery.scenes.backdrop import Backdrop
from drapery.scenes.banners import design_materials
from drapery.scenes.buildings import tower_on_hill
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import LOOP, looped_wind, motion
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)
from drapery.scenes.stroll import cloths_of
from drapery.scenes.variants import in_material
from drapery.stage.forces import in_wind
from drapery.style.block_world import blocks
from drapery.style.scenery import post

RESOLUTION = 12
"""The flag is 4/3 as large as the garment."""
TOWER, POLE = 5, 6.0
"""Height of the tower [blocks] and of the pole on it [m]."""
FOOT = np.array([0.0, TOWER + 1.0, 0.0])
FAR = Camera((15.0, 7.5, 36.0), (1.0, 6.3, 0.0), fov=22, near=5, far=90)
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
    still = (*blocks(tower_on_hill(TOWER), packs), post(FOOT, POLE, packs, 0.12))
    backdrop = Backdrop(FAR, clip.size, still)
    for state in flag_states(parameters, sewn, clip):
        yield backdrop.scene(sewn.models(state.positions[0] + RAISED))


def flag_cloth(parameters: FlagParameters) -> SewnCloth:
    """The garment `flag` with another design."""
    (sewn,) = cloths_of("flag", parameters.thickness, parameters.grid, RESOLUTION)
    (material,) = design_materials((parameters.design,), open_packs(()))
    return in_material(sewn, material)


def flag_states(parameters: FlagParameters, sewn: SewnCloth, clip: Clip) -> Iterator[State]:
    """The flag at each frame, in a wind from the left."""
    aside = (0.97, 0.0, 0.24)
    wind = looped_wind(parameters.wind, parameters.seed, aside, gusts=0.7, gust_size=2.5)
    return motion(sewn.cloth, clip, forces=in_wind(sewn.cloth, wind), settle=LOOP)
