"""One banner four times: smooth, bent in few angles, of level texels, and of both."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.errors import counted
from drapery.packs import open_packs
from drapery.render import View
from drapery.scenes.backdrop import framing
from drapery.scenes.banners import BannerBlock, banner_ground, hang_flags
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import LOOP, looped_wind
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
from drapery.style.piece import Piece
from drapery.style.tailoring import ClothModel
from drapery.styles.shape_steps import boards, voxels

BLOCK = BannerBlock((-0.5, 0, -0.5))
SIDE_ON = View(azimuth=42, elevation=10, fov=26)
FRAMED = (
    *((x, y, z) for x in (-0.9, 0.9) for y, z in ((-0.5, 0.9), (0, -0.9))),
    *((-0.5, 1.95, 0), (0.5, 1.95, 0), (0.3, 1.0, 1.2)),
)
"""The banner and the ground below it [m]."""


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
    p, packs = parameters, open_packs(())
    size = panel_size(clip.size, 2, 2 if p.pixel_snap else 1)
    backdrop = framing(SIDE_ON, FRAMED, size, banner_ground((BLOCK,), (2, 2), packs))
    flag = hang_flags((BLOCK,), p.grid, (p.design,), packs)
    piece = Piece(flag.shell, SCALE, SCALE, FLAG_SIZE)
    labels = ("smooth", counted(p.steps, "step"), "pixel-snap", "both")
    wind = looped_wind(p.wind, p.seed, (0.25, 0.0, 0.97))
    for state in flag.motion(clip, wind, settle=2 * LOOP):
        smooth = piece, state.positions[0]
        shapes = smooth, boards(*smooth, steps=p.steps)
        models = [
            ClothModel(each.mesh(at), flag.materials, thin=(each, at), name="banner/cloth")
            for each, at in shapes
        ]
        if p.pixel_snap:
            models += [
                ClothModel(voxels(*shape), flag.materials, name="banner/cloth") for shape in shapes
            ]
        yield PictureGrid(tuple(backdrop.scene([model]) for model in models), labels[: len(models)])
