"""A scarf of woollen squares: its two long thin tails stream behind a walking figure."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from drapery.banner import DYES
from drapery.banner.sprites import tint
from drapery.cloth import State, Wind
from drapery.garments import SewnCloth
from drapery.packs import Packs, open_packs
from drapery.render import Material, Model, Scene, Texels, TextureLayer
from drapery.scenes.catalogue import Clip
from drapery.scenes.gait import LOOP, MAX_WALK, Gait
from drapery.scenes.parameters import (
    SceneParameters,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)
from drapery.scenes.stroll import cloths_of, walk_scenes, worn_states
from drapery.style import make_shell
from drapery.style.boxes import ModelBox, box_mesh, upright
from drapery.style.figure import SKINS, TEXEL

SQUARE = 4 * TEXEL
"""Edge of a square [m]: the width of the scarf. Each square shows the texture of one block."""
COLLAR = ModelBox((-4.5, -25.5, -4.5), (9, 2.5, 9), (0, 0))


@dataclass(frozen=True)
class ScarfParameters(SceneParameters):
    """What can be set of the scene `scarf`."""

    blocks: str = parameter(
        "orange yellow red", "Blocks or dyes of the squares, starting at the neck"
    )
    skin: str = parameter("traveller", "Skin of the figure", choices=SKINS)
    speed: float = parameter(2.5, "Speed of the walk", (0, MAX_WALK), "m/s")
    wind: float = wind_parameter(2.5, "Wind from ahead, added to that of the walk")
    thickness: float = thickness_parameter(0.5)
    seed: int = seed_parameter()


def play(parameters: ScarfParameters, clip: Clip) -> Iterator[Scene]:
    """Seen from behind; the collar is stiff, the tails are cloth."""
    packs, gait = open_packs(()), Gait(parameters.speed)
    squares = [_texels(name, packs) for name in parameters.blocks.split()] or [
        _texels("red", packs)
    ]
    box = upright(box_mesh(COLLAR, (36, 16)), TEXEL, (0, 0, 0))
    worn = []
    for sewn in tails(parameters):
        (piece,) = sewn.pieces
        shell = make_shell(piece.shell.sheet, piece.shell.sheet_uvs)
        drawn = replace(piece, shell=shell, material=_material(squares, sewn))
        states = tail_states(parameters, sewn, gait, clip)
        worn.append((replace(sewn, pieces=(drawn,)), states))
    collar = (Model(box, (_collar_material(squares),)),)
    return walk_scenes(parameters.skin, gait, clip, worn, tail=1.3, lifted=collar)


def tails(parameters: ScarfParameters) -> tuple[SewnCloth, ...]:
    """The tails of the garment `scarf`."""
    return cloths_of("scarf", parameters.thickness)[1:]


def tail_states(
    parameters: ScarfParameters, sewn: SewnCloth, gait: Gait, clip: Clip
) -> Iterator[State]:
    """One tail at each frame, in the figure's own frame."""
    speed = gait.speed + parameters.wind
    wind = Wind((0.0, 0.0, -speed), gusts=0.35, gust_size=1.0, seed=parameters.seed, period=LOOP)
    return worn_states(sewn, gait, clip, wind)


def _texels(name: str, packs: Packs) -> Texels:
    """A block's texture, or wool of a dye."""
    if name in DYES:
        return tint(packs.texture("block/white_wool"), DYES[name].rgb)
    return packs.texture(f"block/{name}")


def _material(squares: list[Texels], sewn: SewnCloth) -> Material:
    """Squares below one another, as many as the tail is long; the given ones repeat."""
    length = sewn.pieces[0].size
    count = 1 if length is None else round(length[1] / SQUARE)
    column = [squares[place % len(squares)] for place in range(count)]
    return Material((TextureLayer(np.ascontiguousarray(np.vstack(column))),))


def _collar_material(squares: list[Texels]) -> Material:
    """The unfolded collar, 36 x 16 texels, from the first square."""
    wool = np.tile(squares[0][:16, :16], (1, 3, 1))
    return Material((TextureLayer(np.ascontiguousarray(wool[:, :36])),))
