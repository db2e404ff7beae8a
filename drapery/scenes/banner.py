"""Banners of small grids on their poles, waving in a breeze."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.packs import open_packs
from drapery.render import Scene, View
from drapery.scenes.backdrop import framing
from drapery.scenes.banners import BannerBlock, banner_ground, hang_flags, meeting
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import LOOP, looped_wind
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)

FRONT = View(azimuth=20, elevation=9, fov=28)
BLOCKS = (BannerBlock((-1.8, 0, -0.5)), BannerBlock((-0.5, 0, -0.5)), BannerBlock((0.8, 0, -0.5)))
SETTLING = 3 * LOOP
"""After this time the motion of flags that meet nearly repeats with the wind [s]."""
FRAMED = (
    *((x, y, z) for x in (-2, 2) for y, z in ((-1, 1), (0, -1), (1.95, -0.5), (1.95, 0.5))),
    (2.6, 1.0, 1.3),
)
"""The ground, the height of the banners, and where the wind swings the right one [m]."""


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
    """Three banners on a piece of ground, whose flags pass through nothing."""
    p, packs = parameters, open_packs(())
    designs, shapes = (p.left, p.middle, p.right), (p.left_grid, p.middle_grid, p.right_grid)
    ground = banner_ground(BLOCKS, (4, 2), packs)
    backdrop = framing(FRONT, FRAMED, clip.size, ground, margin=0.04)
    flags = [
        hang_flags((block,), shape, (design,), packs)
        for block, shape, design in zip(BLOCKS, shapes, designs, strict=True)
    ]
    wind = looped_wind(p.wind, p.seed)
    for states in meeting(flags, BLOCKS, clip, wind, thickness=p.thickness, settle=SETTLING):
        yield backdrop.scene(
            flag.model(state, p.thickness) for flag, state in zip(flags, states, strict=True)
        )
