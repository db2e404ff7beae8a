"""A skirt moved by walking legs: a ring of cloth that lies in folds, pinned at the waist."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.banner import DYE_NAMES
from drapery.cloth import State
from drapery.garments import SewnCloth
from drapery.packs import open_packs
from drapery.render import Scene
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import looped_wind
from drapery.scenes.parameters import (
    SceneParameters,
    parameter,
    seed_parameter,
    thickness_parameter,
)
from drapery.scenes.pleats import SIDES_ON_TEXTURE, pleated
from drapery.scenes.stroll import BEFORE, cloths_of, walk_scenes, worn_states
from drapery.scenes.variants import in_material
from drapery.stage.gait import MAX_WALK, Gait
from drapery.style.figure import SKINS


@dataclass(frozen=True)
class SkirtParameters(SceneParameters):
    """What can be set of the scene `skirt`."""

    panels: int = parameter(24, "Panels around the skirt", (4, 64))
    rows: int = parameter(5, "Rows of bend points from waist to hem", (1, 32))
    dye: str = parameter("red", "Dye of the outside", choices=DYE_NAMES)
    lining: str = parameter("pink", "Dye of the inside", choices=DYE_NAMES)
    trim: str = parameter("white", "Dye of the hem", choices=DYE_NAMES)
    sides: str = parameter("outside inside hem", "Which sides are visible")
    skin: str = parameter("dancer", "Skin of the figure", choices=SKINS)
    speed: float = parameter(2.0, "Speed of the walk", (0, MAX_WALK), "m/s")
    thickness: float = thickness_parameter()
    seed: int = seed_parameter()


def play(parameters: SkirtParameters, clip: Clip) -> Iterator[Scene]:
    """Seen from the front."""
    gait, sewn = Gait(parameters.speed), skirt_cloth(parameters)
    dyes = parameters.dye, parameters.lining, parameters.trim
    wool = pleated(open_packs(()), dyes, parameters.sides)
    drawn = in_material(sewn, wool, SIDES_ON_TEXTURE)
    worn = [(drawn, skirt_states(parameters, sewn, gait, clip))]
    return walk_scenes(parameters.skin, gait, clip, worn, view=BEFORE, tail=0.6)


def skirt_cloth(parameters: SkirtParameters) -> SewnCloth:
    """The garment `skirt` with other numbers of particles, `panels` in each row."""
    (sewn,) = cloths_of("skirt", parameters.thickness, (parameters.panels, parameters.rows + 1))
    return sewn


def skirt_states(
    parameters: SkirtParameters, sewn: SewnCloth, gait: Gait, clip: Clip
) -> Iterator[State]:
    """The skirt at each frame, in the figure's own frame."""
    wind = looped_wind(gait.speed, parameters.seed, (0.0, 0.0, -1.0), gusts=0.3)
    return worn_states(sewn, gait, clip, wind, order=3)
