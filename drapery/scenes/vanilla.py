"""The game's own stiff banner and cape, and the same as cloth beside them."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner import DYE_NAMES
from drapery.cloth import Gravity, Wind
from drapery.mesh import Array
from drapery.packs import Packs, open_packs
from drapery.render import Scene, View, frame_points
from drapery.scenes import cape
from drapery.scenes.banners import (
    BannerBlock,
    flag_cloth,
    flag_materials,
    flag_models,
    flag_shell,
    flags_at_rest,
    wood_model,
)
from drapery.scenes.catalogue import Clip
from drapery.scenes.gait import LOOP, MAX_WALK, Gait
from drapery.scenes.moving import motion
from drapery.scenes.parameters import SceneParameters, parameter, seed_parameter, wind_parameter
from drapery.scenes.picture_grid import PictureGrid, panel_size
from drapery.scenes.stroll import camera, ground, walker
from drapery.style.block import stiff_flag
from drapery.style.block_world import blocks, plateau
from drapery.style.board import moved
from drapery.style.figure import figure_material
from drapery.style.scenery import SKY, shadow
from drapery.style.sway import cape_lean, stiff_cape, sway_phase
from drapery.style.tailoring import ClothModel

BLOCK = BannerBlock((-0.5, 0, -0.5))
SIDE_ON = View(azimuth=38, elevation=10, fov=26)


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
    packs = open_packs(())
    rows = (_banners(parameters, packs, clip), _capes(parameters, packs, clip))
    for above, below in zip(*rows, strict=True):
        yield PictureGrid((*above, *below), ("the game's", "as cloth", "the game's", "as cloth"))


def _banners(
    parameters: VanillaParameters, packs: Packs, clip: Clip
) -> Iterator[tuple[Scene, Scene]]:
    size = panel_size(clip.size, 2, 2)
    still = (*blocks(plateau(2, 2), packs), shadow((0, 0), 0.42), wood_model((BLOCK,), packs))
    cloth, materials = flag_cloth((5, 9)), flag_materials((parameters.design,), packs)
    shell = flag_shell(cloth)
    camera = frame_points(SIDE_ON, _framed_points(), size[0] / size[1], margin=0.06)
    velocity = (0.35 * parameters.wind, 0.0, 0.94 * parameters.wind)
    forces = (Gravity(), Wind(velocity, gusts=0.5, seed=parameters.seed, period=LOOP))
    start = flags_at_rest(cloth, (BLOCK,))
    states = motion(cloth, clip, forces=forces, start=start, settle=2 * LOOP, step=1 / 60)
    for frame, state in enumerate(states):
        board = stiff_flag("standing", sway_phase(parameters.block, frame / clip.fps))
        stiff = ClothModel(moved(board, np.array(BLOCK.cell)), materials)
        soft = flag_models(shell, state, materials)
        left, right = (
            Scene((*still, flag), camera, size, background=SKY, samples=4) for flag in (stiff, soft)
        )
        yield left, right


def _capes(
    parameters: VanillaParameters, packs: Packs, clip: Clip
) -> Iterator[tuple[Scene, Scene]]:
    size = panel_size(clip.size, 2, 2)
    cape_parameters = cape.CapeParameters(
        dye=parameters.dye, speed=parameters.speed, seed=parameters.seed
    )
    gait, sewn = Gait(parameters.speed), cape.cape_cloth(cape_parameters)
    wool = sewn.pieces[0].material
    skin, causeway = figure_material(cape_parameters.skin, packs), ground(packs)
    view = camera(size)
    for frame, state in enumerate(cape.cape_states(cape_parameters, sewn, gait, clip)):
        stiff = ClothModel(stiff_cape(cape_lean(parameters.speed, frame / clip.fps)), (wool,))
        lifted = moved(stiff.mesh, np.array([0, gait.lift(state.time), 0]))
        (soft,) = sewn.models(state.positions[0])
        figure = walker(gait, state.time, skin, causeway)
        left, right = (
            Scene((*figure, back), view, size, background=SKY, samples=4)
            for back in (ClothModel(lifted, stiff.materials), soft)
        )
        yield left, right


def _framed_points() -> Array:
    """What the camera frames: the banner and the ground below it [m]."""
    return np.array(
        [[x, y, z] for x in (-0.9, 0.9) for y, z in ((-0.5, 0.9), (1.95, 0), (0, -0.9))]
    )
