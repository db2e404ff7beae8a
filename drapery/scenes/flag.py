"""A flag on a tower, seen from afar: few bend points are enough for much wind."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner.packs import open_packs
from drapery.cloth import Cloth, Drag, Fabric, Gravity, State, Wind, grid
from drapery.cloth.colliders import rotation_about
from drapery.render.camera import Camera
from drapery.render.scene import Scene
from drapery.scenes.banners import flag_materials, flag_shell
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion, placed
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)
from drapery.style.block import FLAG_SIZE, SCALE
from drapery.style.block_world import Cell, blocks
from drapery.style.scenery import SKY, post
from drapery.style.tailoring import garment

LOOP = 4.0
GROWN = 2.2
"""The flag is this many times as large as a banner; the banner's top edge is at the pole."""
TOWER, POLE = 5, 6.0
"""Height of the tower [blocks] and of the pole on it [m]."""
BUNTING = Fabric(stretch=10.0, shear=4.0, flexion=0.6)
"""Stiffness of the flag's springs [N/m], high enough that its free end does not crumple."""
FRICTION = 1.8
"""Friction of the air along the flag [1/s]; the wind itself presses only on faces."""
GROWN_SIZE = FLAG_SIZE[0] * GROWN, FLAG_SIZE[1] * GROWN
FOOT = np.array([0.0, TOWER + 1.0, 0.0])


@dataclass(frozen=True)
class FlagParameters(SceneParameters):
    """What can be set of the scene `flag`."""

    design: str = parameter(
        "white stripe_left:red stripe_right:red rhombus:yellow circle:red",
        "Design of a banner that lies on its side",
    )
    wind: float = wind_parameter(9.0)
    grid: tuple[int, int] = grid_parameter((4, 7), "Particles across and along the flag")
    thickness: float = thickness_parameter()
    seed: int = seed_parameter()


def play(parameters: FlagParameters, clip: Clip) -> Iterator[Scene]:
    """The tower on its hill; only the flag moves."""
    packs = open_packs(())
    cloth = banner_on_its_side(parameters.grid)
    shell, materials = flag_shell(cloth), flag_materials((parameters.design,), packs)
    still = (*blocks(_hill(), packs), post(FOOT, POLE, packs, 0.12))
    for state in flag_states(parameters, cloth, clip):
        sheet = state.positions[0]
        thick = parameters.thickness * SCALE * GROWN
        flag = garment(shell, sheet, thick, *materials, size=GROWN_SIZE, texel=SCALE * GROWN)
        yield Scene((*still, flag), _camera(), clip.size, background=SKY, samples=4)


def banner_on_its_side(shape: tuple[int, int]) -> Cloth:
    """The flag, its hoist along the top of the pole."""
    cloth = grid(*shape, *GROWN_SIZE, fabric=BUNTING)
    top = FOOT + np.array([0.1, POLE - 0.1 - GROWN_SIZE[0] / 2, 0.0])
    return placed(cloth, top, rotation_about((0, 0, 1), 90))


def flag_states(parameters: FlagParameters, cloth: Cloth, clip: Clip) -> Iterator[State]:
    """The flag at each frame, in a wind from the left."""
    velocity = (0.97 * parameters.wind, 0.0, 0.24 * parameters.wind)
    wind = Wind(velocity, gusts=0.7, gust_size=2.5, seed=parameters.seed, period=LOOP)
    # Friction in moving air, rate * (wind - v), is a constant push, plus drag in still air.
    push = Gravity((FRICTION * velocity[0], 0.0, FRICTION * velocity[2]))
    forces = (Gravity(), wind, push, Drag(FRICTION))
    return motion(cloth, clip, forces=forces, settle=LOOP)


def _hill() -> dict[Cell, str]:
    cells: dict[Cell, str] = {}
    for x in range(-9, 9):
        for z in range(-9, 9):
            radius = max(2.0, np.hypot(x + 0.5, z + 0.5) + 0.7 * ((x * 7 + z * 5) % 3 - 1))
            height = min(0, 1 - int(radius // 3.4))
            for y in range(-3, height - 1):
                cells[x, y, z] = "dirt"
            if height > -3:
                cells[x, height - 1, z] = "grass"
    cells.update(_tower())
    return cells


def _tower() -> dict[Cell, str]:
    """A tower with battlements, some of its blocks of older stone."""
    cells: dict[Cell, str] = {}
    for x in range(-2, 2):
        for z in range(-2, 2):
            for y in range(TOWER + 1):
                old = (5 * x + 3 * y + 7 * z) % 4 == 0
                cells[x, y, z] = "cobblestone" if old else "stone_bricks"
    for x in range(-3, 3):
        for z in range(-3, 3):
            if x in (-3, 2) or z in (-3, 2):
                cells[x, TOWER, z] = "stone_bricks"
                if (x + z) % 2 == 0:
                    cells[x, TOWER + 1, z] = "stone_bricks"
    return cells


def _camera() -> Camera:
    return Camera((15.0, 7.5, 36.0), (1.0, 6.3, 0.0), fov=22, near=5, far=90)
