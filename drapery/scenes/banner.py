"""Banners of small grids on their poles, waving in a breeze."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.cloth import Gravity, Wind
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Model, Scene, View, frame_points
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
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)
from drapery.style.block_world import blocks, plateau
from drapery.style.scenery import SKY, shadow

FRONT = View(azimuth=20, elevation=9, fov=28)
BLOCKS = (BannerBlock((-1.8, 0, -0.5)), BannerBlock((-0.5, 0, -0.5)), BannerBlock((0.8, 0, -0.5)))
LOOP = 4.0
"""The wind repeats after this time [s], so a picture of 4 s has no seam."""
SETTLING = 2 * LOOP


@dataclass(frozen=True)
class BannerParameters(SceneParameters):
    """What can be set of the scene `banner`."""

    left: str = parameter("white creeper:lime border:black", "Design of the left banner")
    middle: str = parameter(
        "blue gradient_up:light_blue rhombus:yellow flower:white border:orange",
        "Design of the middle banner",
    )
    right: str = parameter(
        "red stripe_middle:white circle:white skull:black triangles_bottom:black",
        "Design of the right banner",
    )
    left_grid: tuple[int, int] = grid_parameter((3, 5), "Particles across and down the left flag")
    middle_grid: tuple[int, int] = grid_parameter((5, 9), "The same of the middle flag")
    right_grid: tuple[int, int] = grid_parameter((7, 13), "The same of the right flag")
    wind: float = wind_parameter(5.0)
    thickness: float = thickness_parameter()
    seed: int = seed_parameter()


def play(parameters: BannerParameters, clip: Clip) -> Iterator[Scene]:
    """Three banners on a piece of ground."""
    packs = open_packs(())
    ground = blocks(plateau(4, 2), packs)
    still = (
        *ground,
        *(shadow((s.cell[0] + 0.5, 0), 0.42) for s in BLOCKS),
        wood_model(BLOCKS, packs),
    )
    camera = frame_points(FRONT, _framed_points(), clip.size[0] / clip.size[1], margin=0.04)
    for waving in zip(*_flags(parameters, clip), strict=True):
        yield Scene((*still, *waving), camera, clip.size, background=SKY, samples=4)


def _flags(parameters: BannerParameters, clip: Clip) -> list[Iterator[Model]]:
    """Each flag at every frame. The flags differ in topology, so each is simulated alone."""
    p = parameters
    designs, shapes = (p.left, p.middle, p.right), (p.left_grid, p.middle_grid, p.right_grid)
    return [
        _flag(parameters, block, design, shape, clip)
        for block, design, shape in zip(BLOCKS, designs, shapes, strict=True)
    ]


def _flag(
    parameters: BannerParameters,
    block: BannerBlock,
    design: str,
    shape: tuple[int, int],
    clip: Clip,
) -> Iterator[Model]:
    cloth = flag_cloth(shape)
    shell, materials = flag_shell(cloth), flag_materials((design,), open_packs(()))
    velocity = (0.35 * parameters.wind, 0.0, 0.94 * parameters.wind)
    wind = Wind(velocity, gusts=0.5, seed=parameters.seed, period=LOOP)
    states = motion(
        cloth,
        clip,
        forces=(Gravity(), wind),
        start=flags_at_rest(cloth, (block,)),
        settle=SETTLING,
        step=1 / 60,
    )
    return (flag_models(shell, state, materials, parameters.thickness) for state in states)


def _framed_points() -> Array:
    """What the camera frames: the ground, the height of the banners, and where the wind swings the
    right one [m]."""
    standing = [
        (x, y, z) for x in (-2, 2) for y, z in ((-1, 1), (0, -1), (1.95, -0.5), (1.95, 0.5))
    ]
    return np.array([*standing, (2.6, 1.0, 1.3)])
