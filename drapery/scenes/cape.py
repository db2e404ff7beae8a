"""A cape on a walking figure: thick cloth held at the shoulders, moved by back, arms and legs."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner.packs import open_packs
from drapery.cloth import Cloth, Gravity, State, Wind, grid
from drapery.cloth.colliders import rotation_about
from drapery.cloth.collisions import Collisions
from drapery.render.scene import Material, Model, Scene
from drapery.scenes.catalogue import Shot
from drapery.scenes.gait import LOOP, Gait
from drapery.scenes.moving import motion, placed
from drapery.scenes.stroll import camera, ground, walker
from drapery.style.extrusion import Shell, make_shell
from drapery.style.figure import CAPE_MAPPING, CAPE_SIZE, TEXEL, figure_material
from drapery.style.scenery import SKY
from drapery.style.tailoring import dyed, garment

SETTLING = LOOP
BODY = ("body", "right_arm", "left_arm", "right_leg", "left_leg")


@dataclass(frozen=True)
class Parameters:
    """skin: of the figure. dye: of the cape. speed: of the walk [m/s]. wind: a breeze from ahead,
    besides [m/s]. grid: particles across and down the cape. thickness: in texels."""

    skin: str = "traveller"
    dye: str = "red"
    speed: float = 2.5
    wind: float = 0.5
    grid: tuple[int, int] = (6, 9)
    thickness: float = 1.0
    seed: int = 0


def play(parameters: Parameters, shot: Shot) -> Iterator[Scene]:
    """The figure walks in place; the causeway passes below."""
    packs = open_packs(())
    gait, cloth = Gait(parameters.speed), cape_cloth(parameters.grid)
    shell, wool = cape_shell(cloth), dyed(packs.texture("entity/player/cape"), parameters.dye)
    skin, causeway = figure_material(parameters.skin, packs), ground(packs)
    for state in walk(parameters, cloth, gait, shot):
        models = (
            *walker(gait, state.time, skin, causeway),
            worn(shell, state, parameters.thickness, wool),
        )
        yield Scene(models, camera(shot.size), shot.size, background=SKY, samples=4)


def worn(shell: Shell, state: State, thickness: float, wool: Material) -> Model:
    """The cape of a state; its thickness in texels."""
    return garment(shell, state.positions[0], thickness * TEXEL, wool)


def cape_shell(cloth: Cloth) -> Shell:
    """How a thick cape follows the cloth."""
    return make_shell(cloth.triangles, cloth.uvs, CAPE_MAPPING)


def walk(parameters: Parameters, cloth: Cloth, gait: Gait, shot: Shot) -> Iterator[State]:
    """The cape's state at each frame, in the figure's own frame."""
    wind = Wind((0.0, 0.0, -gait.speed - parameters.wind), seed=parameters.seed, period=LOOP)
    return motion(
        cloth,
        shot,
        forces=(Gravity(), wind),
        collisions=Collisions(gait.colliders(BODY), parameters.thickness * TEXEL),
        pins=gait.pins(cloth),
        settle=SETTLING,
    )


def cape_cloth(shape: tuple[int, int]) -> Cloth:
    """A cape on the figure's back, facing backwards, held by two particles at each shoulder."""
    columns, rows = shape
    shoulders = [0, 1, columns - 2, columns - 1]
    cloth = grid(columns, rows, *CAPE_SIZE, pins=shoulders)
    back = np.array([0.0, 24 * TEXEL, -2.6 * TEXEL])
    return placed(cloth, back, rotation_about((0, 1, 0), 180))
