"""Banners of small grids on their poles, waving in a breeze."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner.packs import open_packs
from drapery.cloth import Gravity, Wind
from drapery.mesh import Array
from drapery.render.scene import Model, Scene
from drapery.render.views import View, frame_points
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
from drapery.scenes.moving import motion
from drapery.style.block_world import blocks, plateau
from drapery.style.scenery import SKY, shadow

FRONT = View(azimuth=20, elevation=9, fov=28)
STANDS = (Stand((-1.8, 0, -0.5)), Stand((-0.5, 0, -0.5)), Stand((0.8, 0, -0.5)))
LOOP = 4.0
"""The wind repeats after this time [s], so a picture of 4 s has no seam."""
SETTLING = 2 * LOOP


@dataclass(frozen=True)
class Parameters:
    """left, middle, right: designs. left_grid and so on: particles across and down each flag.

    wind: its mean speed [m/s]. thickness: of the cloth, in texels.
    """

    left: str = "white creeper:lime border:black"
    middle: str = "blue gradient_up:light_blue rhombus:yellow flower:white border:orange"
    right: str = "red stripe_middle:white circle:white skull:black triangles_bottom:black"
    left_grid: tuple[int, int] = (3, 5)
    middle_grid: tuple[int, int] = (5, 9)
    right_grid: tuple[int, int] = (7, 13)
    wind: float = 5.0
    thickness: float = 1.0
    seed: int = 0


def play(parameters: Parameters, shot: Shot) -> Iterator[Scene]:
    """Three banners on a piece of ground."""
    packs = open_packs(())
    ground = blocks(plateau(4, 2), packs)
    still = (*ground, *(shadow((s.cell[0] + 0.5, 0), 0.42) for s in STANDS), wooden(STANDS, packs))
    camera = frame_points(FRONT, _room(), shot.size[0] / shot.size[1], margin=0.04)
    for waving in zip(*_flags(parameters, shot), strict=True):
        yield Scene((*still, *waving), camera, shot.size, background=SKY, samples=4)


def _flags(parameters: Parameters, shot: Shot) -> list[Iterator[Model]]:
    """Each flag at every frame; they differ in topology, so each is a motion of its own."""
    p = parameters
    designs, shapes = (p.left, p.middle, p.right), (p.left_grid, p.middle_grid, p.right_grid)
    return [
        _flag(parameters, stand, design, shape, shot)
        for stand, design, shape in zip(STANDS, designs, shapes, strict=True)
    ]


def _flag(
    parameters: Parameters, stand: Stand, design: str, shape: tuple[int, int], shot: Shot
) -> Iterator[Model]:
    cloth = flag_cloth(shape)
    shell, materials = flag_shell(cloth), flag_materials((design,), open_packs(()))
    velocity = (0.35 * parameters.wind, 0.0, 0.94 * parameters.wind)
    wind = Wind(velocity, gusts=0.5, seed=parameters.seed, period=LOOP)
    states = motion(
        cloth,
        shot,
        forces=(Gravity(), wind),
        start=hung(cloth, (stand,)),
        settle=SETTLING,
        step=1 / 60,
    )
    return (flags(shell, state, materials, parameters.thickness) for state in states)


def _room() -> Array:
    """What the camera frames: the ground and the height of the banners [m]."""
    return np.array(
        [[x, y, z] for x in (-2, 2) for y, z in ((-1, 1), (0, -1), (1.95, -0.5), (1.95, 0.5))]
    )
