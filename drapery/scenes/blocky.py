"""One banner four times: smooth, bent in few angles, of level texels, and of both."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner.packs import open_packs
from drapery.cloth import Gravity, Wind
from drapery.errors import OptionError
from drapery.mesh import Array
from drapery.render.scene import Material, Model, Scene
from drapery.render.views import View, frame_points
from drapery.scenes.banners import Stand, flag_cloth, flag_materials, flag_shell, hung, wooden
from drapery.scenes.catalogue import Shot
from drapery.scenes.moving import motion
from drapery.scenes.panels import Panels, panel_size
from drapery.style.block import FLAG_MAPPING, SCALE
from drapery.style.block_world import blocks, plateau
from drapery.style.blocky import pixelled, stepped
from drapery.style.scenery import SKY, shadow
from drapery.style.tailoring import garment

STAND = Stand((-0.5, 0, -0.5))
SIDE_ON = View(azimuth=42, elevation=10, fov=26)
LOOP = 4.0
TEXELS = (20, 40)
"""Of a flag, across and down."""


@dataclass(frozen=True)
class Parameters:
    """steps: of bend angles in a right angle; 4 makes multiples of 22.5 degrees. pixel_snap:
    whether two of the pictures keep texels level. grid: bend points are its rows but the first.
    wind: [m/s]."""

    steps: int = 4
    pixel_snap: bool = True
    design: str = "white creeper:lime border:black"
    grid: tuple[int, int] = (3, 6)
    wind: float = 8.0
    seed: int = 0


def play(parameters: Parameters, shot: Shot) -> Iterator[Panels]:
    """All of the same motion."""
    if not 1 <= parameters.steps <= 90:
        raise OptionError(f"steps {parameters.steps} is out of range; use 1 to 90")
    packs = open_packs(())
    count = 2 if parameters.pixel_snap else 1
    size = panel_size(shot.size, 2, count)
    cloth, materials = flag_cloth(parameters.grid), flag_materials((parameters.design,), packs)
    shell, shape = flag_shell(cloth), (parameters.grid[1], parameters.grid[0])
    still = (*blocks(plateau(2, 2), packs), shadow((0, 0), 0.42), wooden((STAND,), packs))
    camera = frame_points(SIDE_ON, _room(), size[0] / size[1], margin=0.05)
    velocity = (0.25 * parameters.wind, 0.0, 0.97 * parameters.wind)
    forces = (Gravity(), Wind(velocity, gusts=0.5, seed=parameters.seed, period=LOOP))
    start = hung(cloth, (STAND,))
    labels = ("smooth", f"{parameters.steps} steps", "pixel-snap", "both")
    for state in motion(cloth, shot, forces=forces, start=start, settle=2 * LOOP, step=1 / 60):
        smooth = state.positions[0]
        few = stepped(smooth, shape, parameters.steps)
        flags = [garment(shell, sheet, SCALE, *materials) for sheet in (smooth, few)]
        if parameters.pixel_snap:
            flags += [_pixels(sheet, shape, materials) for sheet in (smooth, few)]
        scenes = tuple(
            Scene((*still, flag), camera, size, background=SKY, samples=4) for flag in flags
        )
        yield Panels(scenes, labels[: len(scenes)])


def _pixels(sheet: Array, shape: tuple[int, int], materials: tuple[Material, ...]) -> Model:
    return Model(pixelled(sheet, shape, TEXELS, FLAG_MAPPING, SCALE), materials)


def _room() -> Array:
    """What the camera frames: the banner and the ground below it [m]."""
    low = [[x, y, z] for x in (-0.9, 0.9) for y, z in ((-0.5, 0.9), (0, -0.9))]
    return np.array([*low, [-0.5, 1.95, 0], [0.5, 1.95, 0], [0.3, 1.0, 1.2]])
