"""A hall with 32 banners on its walls, in a breeze and one strong gust."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.cloth import Collider, Collisions, Plane, State, Wind
from drapery.packs import open_packs
from drapery.render import Camera, Light, Scene
from drapery.scenes import buildings
from drapery.scenes.backdrop import Backdrop
from drapery.scenes.banners import BannerBlock, Flags, hang_flags, wood_model
from drapery.scenes.catalogue import Clip
from drapery.scenes.gust import Gust
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    wind_parameter,
)
from drapery.style.block import SCALE
from drapery.style.block_world import blocks

WIDTH, HEIGHT, BAYS, BAY = 4, 4, 16, 2
"""Width and height of the hall [blocks], the banners along each wall, from one to the next [m]."""
ENTRANCE = Camera((1.1, 1.9, 1.6), (-1.0, 1.75, -6.0), fov=58, near=0.1, far=80)
TORCHLIGHT = Light(((0.3, 1.0, 0.5), (-0.3, 0.4, 1.0)), 0.42, 0.6, (1.0, 0.96, 0.88))
DAY = (206, 226, 246, 255)
DESIGNS = (
    "red stripe_center:yellow border:black",
    "black skull:white curly_border:gray",
    "blue cross:white rhombus:light_blue",
    "green half_horizontal_bottom:lime flower:yellow border:green",
    "purple triangles_top:magenta circle:white",
    "white creeper:green border:gray",
    "orange gradient:red globe:brown",
    "cyan small_stripes:light_blue stripe_middle:white border:blue",
)
BLOCKS = tuple(
    BannerBlock((x, 1.9, -BAY * bay - 1.0), "wall", facing)
    for bay in range(BAYS)
    for x, facing in ((-WIDTH / 2, 270.0), (WIDTH / 2 - 1, 90.0))
)
"""A banner in each bay of both walls, facing into the hall."""


@dataclass(frozen=True)
class HallParameters(SceneParameters):
    """What can be set of the scene `hall`."""

    breeze: float = wind_parameter(1.5, "Mean speed of the wind along the hall")
    gust: float = parameter(6.0, "Acceleration in the gust's middle", (0, 60), "m/s²")
    grid: tuple[int, int] = grid_parameter((9, 17), "Particles across and down each flag")
    seed: int = seed_parameter()


def play(parameters: HallParameters, clip: Clip) -> Iterator[Scene]:
    """The hall seen from its entrance."""
    packs = open_packs(())
    cells = buildings.hall(WIDTH, HEIGHT, BAYS, BAY)
    still = (*blocks(cells, packs), wood_model(BLOCKS, packs))
    backdrop = Backdrop(ENTRANCE, clip.size, still, TORCHLIGHT, DAY)
    flags = hang_flags(BLOCKS, parameters.grid, DESIGNS, packs)
    for state in flag_states(parameters, flags, clip):
        yield backdrop.scene([flags.model(state)])


def flag_states(parameters: HallParameters, flags: Flags, clip: Clip) -> Iterator[State]:
    """All flags at each frame; the walls stop them."""
    breeze = Wind((0.0, 0.0, -parameters.breeze), gusts=0.5, seed=parameters.seed)
    walls = [
        Collider(Plane(np.array([side * WIDTH / 2, 0, 0]), np.array([-side, 0, 0])))
        for side in (-1.0, 1.0)
    ]
    met = Collisions(walls, SCALE, order=1)
    return flags.motion(clip, breeze, Gust(strength=parameters.gust), collisions=met)
