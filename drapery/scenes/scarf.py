"""A scarf of woollen squares: its two long thin tails stream behind a walking figure."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.cloth import State
from drapery.garments import SewnCloth
from drapery.packs import open_packs
from drapery.render import Model, Scene
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import looped_wind
from drapery.scenes.parameters import (
    SceneParameters,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)
from drapery.scenes.stroll import cloths_of, walk_scenes, worn_states
from drapery.scenes.variants import in_material
from drapery.stage.gait import MAX_WALK, Gait
from drapery.style import SheetMapping
from drapery.style.boxes import ModelBox, box_mesh, upright
from drapery.style.figure import SKINS, TEXEL
from drapery.style.tailoring import block_texels, squares

SQUARE = 4 * TEXEL
"""Edge of a square [m]: the width of the scarf. Each square shows the texture of one block."""
COLLAR, COLLAR_SHEET = ModelBox((-4.5, -25.5, -4.5), (9, 2.5, 9), (0, 0)), (48, 16)
"""The collar, and the size of its unfolded texture of three squares [texels]."""


@dataclass(frozen=True)
class ScarfParameters(SceneParameters):
    """What can be set of the scene `scarf`."""

    blocks: str = parameter(
        "orange yellow red", "Blocks or dyes of the squares, starting at the neck"
    )
    skin: str = parameter("traveller", "Skin of the figure", choices=SKINS)
    speed: float = parameter(2.5, "Speed of the walk", (0, MAX_WALK), "m/s")
    wind: float = wind_parameter(2.5, "Wind from ahead, added to the air that the walk meets")
    thickness: float = thickness_parameter(0.5)
    seed: int = seed_parameter()


def play(parameters: ScarfParameters, clip: Clip) -> Iterator[Scene]:
    """Seen from behind; the collar is stiff, the tails are cloth."""
    packs, gait = open_packs(()), Gait(parameters.speed)
    woven = [block_texels(name, packs) for name in parameters.blocks.split() or ["red"]]
    worn = []
    for sewn in tails(parameters):
        column = squares(woven, 1, round(sewn.pieces[0].size[1] / SQUARE))
        drawn = in_material(sewn, column, SheetMapping())
        worn.append((drawn, tail_states(parameters, sewn, gait, clip)))
    box = upright(box_mesh(COLLAR, COLLAR_SHEET), TEXEL, (0, 0, 0))
    collar = Model(box, (squares([woven[0][:16, :16]], 3, 1),), name="collar")
    return walk_scenes(parameters.skin, gait, clip, worn, tail=1.3, lifted=(collar,))


def tails(parameters: ScarfParameters) -> tuple[SewnCloth, ...]:
    """The tails of the garment `scarf`."""
    return cloths_of("scarf", parameters.thickness)[1:]


def tail_states(
    parameters: ScarfParameters, sewn: SewnCloth, gait: Gait, clip: Clip
) -> Iterator[State]:
    """One tail at each frame, in the figure's own frame."""
    speed = gait.speed + parameters.wind
    wind = looped_wind(speed, parameters.seed, (0.0, 0.0, -1.0), gusts=0.35, gust_size=1.0)
    return worn_states(sewn, gait, clip, wind)
