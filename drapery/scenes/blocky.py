"""One banner four times: smooth, bent in few angles, of level texels, and of both."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.cloth import Gravity, Wind
from drapery.errors import counted
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Scene, View, frame_points
from drapery.scenes.banners import (
    BannerBlock,
    flag_cloth,
    flag_materials,
    flag_shell,
    flags_at_rest,
    wood_model,
)
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    wind_parameter,
)
from drapery.scenes.picture_grid import PictureGrid, panel_size
from drapery.style import FLAG_SIZE
from drapery.style.block import SCALE
from drapery.style.block_world import blocks, plateau
from drapery.style.scenery import SKY, shadow
from drapery.style.sheet import Sheet
from drapery.style.tailoring import ClothModel, garment
from drapery.styles.shape_steps import boards, voxels

BLOCK = BannerBlock((-0.5, 0, -0.5))
SIDE_ON = View(azimuth=42, elevation=10, fov=26)
LOOP = 4.0


@dataclass(frozen=True)
class BlockyParameters(SceneParameters):
    """What can be set of the scene `blocky`."""

    steps: int = parameter(4, "Bend angles in a right angle; 4 makes 22.5 degrees", (1, 90))
    pixel_snap: bool = parameter(True, "Whether two of the pictures keep texels level")
    design: str = parameter("white creeper:lime border:black", "Design of the banner")
    grid: tuple[int, int] = grid_parameter(
        (3, 6), "Particles across and down; all rows but one bend"
    )
    wind: float = wind_parameter(8.0)
    seed: int = seed_parameter()


def play(parameters: BlockyParameters, clip: Clip) -> Iterator[PictureGrid]:
    """Two or four pictures of the same motion."""
    packs = open_packs(())
    count = 2 if parameters.pixel_snap else 1
    size = panel_size(clip.size, 2, count)
    cloth, materials = flag_cloth(parameters.grid), flag_materials((parameters.design,), packs)
    shell = flag_shell(cloth)
    still = (*blocks(plateau(2, 2), packs), shadow((0, 0), 0.42), wood_model((BLOCK,), packs))
    camera = frame_points(SIDE_ON, _framed_points(), size[0] / size[1], margin=0.05)
    velocity = (0.25 * parameters.wind, 0.0, 0.97 * parameters.wind)
    forces = (Gravity(), Wind(velocity, gusts=0.5, seed=parameters.seed, period=LOOP))
    start = flags_at_rest(cloth, (BLOCK,))
    labels = ("smooth", counted(parameters.steps, "step"), "pixel-snap", "both")
    for state in motion(cloth, clip, forces=forces, start=start, settle=2 * LOOP, step=1 / 60):
        smooth = Sheet(state.positions[0], shell, SCALE, SCALE, FLAG_SIZE)
        sheets = smooth, boards(smooth, steps=parameters.steps)
        flags = [
            garment(shell, s.positions, SCALE, *materials, size=FLAG_SIZE, texel=SCALE)
            for s in sheets
        ]
        if parameters.pixel_snap:
            flags += [ClothModel(voxels(sheet), materials) for sheet in sheets]
        scenes = tuple(
            Scene((*still, flag), camera, size, background=SKY, samples=4) for flag in flags
        )
        yield PictureGrid(scenes, labels[: len(scenes)])


def _framed_points() -> Array:
    """What the camera frames: the banner and the ground below it [m]."""
    low = [[x, y, z] for x in (-0.9, 0.9) for y, z in ((-0.5, 0.9), (0, -0.9))]
    return np.array([*low, [-0.5, 1.95, 0], [0.5, 1.95, 0], [0.3, 1.0, 1.2]])
