"""The game's own stiff banner and cape, and the same as cloth beside them."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner.packs import Packs, open_packs
from drapery.cloth import Gravity, Wind
from drapery.mesh import Array
from drapery.render.scene import Model, Scene
from drapery.render.views import View, frame_points
from drapery.scenes import cape
from drapery.scenes.banners import (
    Stand,
    flag_cloth,
    flag_materials,
    flag_shell,
    flags,
    hung,
    wooden,
)
from drapery.scenes.catalogue import Shot
from drapery.scenes.gait import LOOP, Gait
from drapery.scenes.moving import motion
from drapery.scenes.panels import Panels, panel_size
from drapery.scenes.stroll import camera, ground, walker
from drapery.style.block import stiff_flag
from drapery.style.block_world import blocks, plateau
from drapery.style.board import moved
from drapery.style.figure import figure_material
from drapery.style.scenery import SKY, shadow
from drapery.style.sway import cape_lean, stiff_cape, sway_phase
from drapery.style.tailoring import dyed

STAND = Stand((-0.5, 0, -0.5))
SIDE_ON = View(azimuth=38, elevation=10, fov=26)


@dataclass(frozen=True)
class Parameters:
    """design: of the banner. dye: of the cape. speed: of the walk [m/s]. wind: at the banner
    [m/s]. block: where the banner stands in its world, for the phase of its sway."""

    design: str = "white creeper:lime border:black"
    dye: str = "red"
    speed: float = 2.5
    wind: float = 5.0
    block: tuple[int, int, int] = (0, 0, 0)
    seed: int = 0


def play(parameters: Parameters, shot: Shot) -> Iterator[Panels]:
    """Banners above, capes below; the game's on the left."""
    packs = open_packs(())
    rows = (_banners(parameters, packs, shot), _capes(parameters, packs, shot))
    for above, below in zip(*rows, strict=True):
        yield Panels((*above, *below), ("the game's", "as cloth", "the game's", "as cloth"))


def _banners(parameters: Parameters, packs: Packs, shot: Shot) -> Iterator[tuple[Scene, Scene]]:
    size = panel_size(shot.size, 2, 2)
    still = (*blocks(plateau(2, 2), packs), shadow((0, 0), 0.42), wooden((STAND,), packs))
    cloth, materials = flag_cloth((5, 9)), flag_materials((parameters.design,), packs)
    shell = flag_shell(cloth)
    camera = frame_points(SIDE_ON, _banner_room(), size[0] / size[1], margin=0.06)
    velocity = (0.35 * parameters.wind, 0.0, 0.94 * parameters.wind)
    forces = (Gravity(), Wind(velocity, gusts=0.5, seed=parameters.seed, period=LOOP))
    start = hung(cloth, (STAND,))
    states = motion(cloth, shot, forces=forces, start=start, settle=2 * LOOP, step=1 / 60)
    for frame, state in enumerate(states):
        board = stiff_flag("standing", sway_phase(parameters.block, frame / shot.fps))
        stiff = Model(moved(board, np.array(STAND.cell)), materials)
        soft = flags(shell, state, materials)
        left, right = (
            Scene((*still, flag), camera, size, background=SKY, samples=4) for flag in (stiff, soft)
        )
        yield left, right


def _capes(parameters: Parameters, packs: Packs, shot: Shot) -> Iterator[tuple[Scene, Scene]]:
    size = panel_size(shot.size, 2, 2)
    worn = cape.Parameters(dye=parameters.dye, speed=parameters.speed, seed=parameters.seed)
    gait, cloth = Gait(parameters.speed), cape.cape_cloth(worn.grid)
    shell, wool = cape.cape_shell(cloth), dyed(packs.texture("entity/player/cape"), worn.dye)
    skin, causeway = figure_material(worn.skin, packs), ground(packs)
    view = camera(size)
    for frame, state in enumerate(cape.walk(worn, cloth, gait, shot)):
        stiff = Model(stiff_cape(cape_lean(parameters.speed, frame / shot.fps)), (wool,))
        lifted = moved(stiff.mesh, np.array([0, gait.lift(state.time), 0]))
        soft = cape.worn(shell, state, 1.0, wool)
        figure = walker(gait, state.time, skin, causeway)
        left, right = (
            Scene((*figure, back), view, size, background=SKY, samples=4)
            for back in (Model(lifted, stiff.materials), soft)
        )
        yield left, right


def _banner_room() -> Array:
    """What the camera frames: the banner and the ground below it [m]."""
    return np.array(
        [[x, y, z] for x in (-0.9, 0.9) for y, z in ((-0.5, 0.9), (1.95, 0), (0, -0.9))]
    )
