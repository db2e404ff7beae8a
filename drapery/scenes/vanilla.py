"""The game's own stiff banner and cape, and the same as cloth beside them."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner import DYE_NAMES
from drapery.packs import Packs, open_packs
from drapery.render import Scene, View
from drapery.scenes.backdrop import Backdrop, framing
from drapery.scenes.banners import BannerBlock, banner_ground, hang_flags
from drapery.scenes.cape import CapeParameters, cape_cloth, cape_states
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import LOOP, looped_wind
from drapery.scenes.parameters import SceneParameters, parameter, seed_parameter, wind_parameter
from drapery.scenes.picture_grid import PictureGrid, panel_size
from drapery.scenes.stroll import camera, ground, walker
from drapery.stage.gait import MAX_WALK, Gait
from drapery.style.block import stiff_flag
from drapery.style.board import moved
from drapery.style.figure import figure_material
from drapery.style.sway import cape_lean, stiff_cape, sway_phase
from drapery.style.tailoring import ClothModel

BLOCK = BannerBlock((-0.5, 0, -0.5))
SIDE_ON = View(azimuth=38, elevation=10, fov=26)
FRAMED = [(x, y, z) for x in (-0.9, 0.9) for y, z in ((-0.5, 0.9), (1.95, 0), (0, -0.9))]
"""The banner and the ground below it [m]."""


@dataclass(frozen=True)
class VanillaParameters(SceneParameters):
    """What can be set of the scene `vanilla`."""

    design: str = parameter("white creeper:lime border:black", "Design of the banner")
    dye: str = parameter("red", "Dye of the cape", choices=DYE_NAMES)
    speed: float = parameter(2.5, "Speed of the walk", (0, MAX_WALK), "m/s")
    wind: float = wind_parameter(5.0, "Mean speed of the wind at the banner")
    block: tuple[int, int, int] = parameter(
        (0, 0, 0),
        "Block of the banner in its world, which sets the phase of its sway",
        (-30_000_000, 30_000_000),
    )
    seed: int = seed_parameter()


def play(parameters: VanillaParameters, clip: Clip) -> Iterator[PictureGrid]:
    """Banners above, capes below; those of the game on the left."""
    rows = (side(parameters, open_packs(()), clip) for side in (_banners, _capes))
    for above, below in zip(*rows, strict=True):
        yield PictureGrid((*above, *below), ("the game's", "as cloth", "the game's", "as cloth"))


def _banners(p: VanillaParameters, packs: Packs, clip: Clip) -> Iterator[list[Scene]]:
    size = panel_size(clip.size, 2, 2)
    backdrop = framing(SIDE_ON, FRAMED, size, banner_ground((BLOCK,), (2, 2), packs), margin=0.06)
    flag = hang_flags((BLOCK,), (5, 9), (p.design,), packs)
    for frame, state in enumerate(flag.motion(clip, looped_wind(p.wind, p.seed), settle=2 * LOOP)):
        board = stiff_flag("standing", sway_phase(p.block, frame / clip.fps))
        stiff = ClothModel(moved(board, np.array(BLOCK.cell)), flag.materials, name="banner/flag")
        yield [backdrop.scene([each]) for each in (stiff, flag.model(state))]


def _capes(p: VanillaParameters, packs: Packs, clip: Clip) -> Iterator[list[Scene]]:
    own = CapeParameters(dye=p.dye, speed=p.speed, seed=p.seed)
    gait, sewn = Gait(p.speed), cape_cloth(own)
    skin, causeway = figure_material(own.skin, packs), ground(packs)
    size = panel_size(clip.size, 2, 2)
    backdrop = Backdrop(camera(size), size)
    for frame, state in enumerate(cape_states(own, sewn, gait, clip)):
        board = moved(stiff_cape(cape_lean(p.speed, frame / clip.fps)), gait.raised(state.time))
        stiff = ClothModel(board, (sewn.pieces[0].material_at(0.0),), name="cape")
        figure = walker(gait, state.time, skin, causeway)
        capes = (stiff, *sewn.models(state.positions[0]))
        yield [backdrop.scene((*figure, each)) for each in capes]
