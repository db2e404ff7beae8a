"""A cape on a walking figure: thick cloth held at the shoulders, moved by back, arms and legs."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.banner import DYE_NAMES
from drapery.cloth import State
from drapery.garments import SewnCloth
from drapery.packs import open_packs
from drapery.render import Scene
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import LOOP, looped_wind
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)
from drapery.scenes.stroll import cloths_of, walk_scenes, worn_states
from drapery.scenes.variants import in_material
from drapery.stage.gait import MAX_WALK, Gait
from drapery.style.figure import SKINS
from drapery.style.tailoring import dyed

SETTLING = 2 * LOOP
"""After this time the motion of a cape repeats with the walk [s]."""


@dataclass(frozen=True)
class CapeParameters(SceneParameters):
    """What can be set of the scene `cape`."""

    skin: str = parameter("traveller", "Skin of the figure", choices=SKINS)
    dye: str = parameter("red", "Dye of the cape", choices=DYE_NAMES)
    speed: float = parameter(2.5, "Speed of the walk", (0, MAX_WALK), "m/s")
    wind: float = wind_parameter(0.5, "Wind from ahead, added to the air that the walk meets")
    grid: tuple[int, int] = grid_parameter((11, 11), "Particles across and down the cape")
    thickness: float = thickness_parameter()
    seed: int = seed_parameter()


def play(parameters: CapeParameters, clip: Clip) -> Iterator[Scene]:
    """The figure walks in place; the causeway passes below."""
    gait, sewn = Gait(parameters.speed), cape_cloth(parameters)
    worn = [(sewn, cape_states(parameters, sewn, gait, clip))]
    return walk_scenes(parameters.skin, gait, clip, worn)


def cape_cloth(parameters: CapeParameters) -> SewnCloth:
    """The garment `cape` in another dye."""
    (sewn,) = cloths_of("cape", parameters.thickness, parameters.grid)
    wool = dyed(open_packs(()).texture("entity/player/cape"), parameters.dye)
    return in_material(sewn, wool)


def cape_states(
    parameters: CapeParameters, sewn: SewnCloth, gait: Gait, clip: Clip
) -> Iterator[State]:
    """The cape's state at each frame, in the figure's own frame."""
    ahead = gait.speed + parameters.wind
    wind = looped_wind(ahead, parameters.seed, (0.0, 0.0, -1.0), gusts=0.4)
    return worn_states(sewn, gait, clip, wind, settle=SETTLING)
