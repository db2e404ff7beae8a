"""A cape on a walking figure: thick cloth held at the shoulders, moved by back, arms and legs."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner.dyes import DYE_NAMES
from drapery.banner.packs import open_packs
from drapery.cloth import Cloth, Gravity, State, Wind, grid
from drapery.cloth.colliders import rotation_about
from drapery.cloth.collisions import Collisions
from drapery.render.scene import Material, Model, Scene
from drapery.scenes.catalogue import Clip
from drapery.scenes.gait import LOOP, MAX_WALK, Gait
from drapery.scenes.moving import motion, placed
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)
from drapery.scenes.stroll import camera, ground, walker
from drapery.style.extrusion import Shell, make_shell
from drapery.style.figure import (
    CAPE_SIZE,
    SKIN_SHEET,
    SKINS,
    TEXEL,
    cape_mapping,
    figure_material,
)
from drapery.style.scenery import SKY
from drapery.style.tailoring import dyed, garment

SETTLING = 2 * LOOP
"""After this time the motion of a cape repeats with the walk [s]."""
BODY = ("body", "right_arm", "left_arm", "right_leg", "left_leg")


@dataclass(frozen=True)
class CapeParameters(SceneParameters):
    """What can be set of the scene `cape`."""

    skin: str = parameter("traveller", "Skin of the figure", choices=SKINS)
    dye: str = parameter("red", "Dye of the cape", choices=DYE_NAMES)
    speed: float = parameter(2.5, "Speed of the walk", (0, MAX_WALK), "m/s")
    wind: float = wind_parameter(0.5, "Wind from ahead, added to that of the walk")
    grid: tuple[int, int] = grid_parameter((6, 9), "Particles across and down the cape", least=4)
    thickness: float = thickness_parameter()
    seed: int = seed_parameter()


def play(parameters: CapeParameters, clip: Clip) -> Iterator[Scene]:
    """The figure walks in place; the causeway passes below."""
    packs = open_packs(())
    gait, cloth = Gait(parameters.speed), cape_cloth(parameters.grid)
    shell, wool = cape_shell(cloth), dyed(packs.texture("entity/player/cape"), parameters.dye)
    skin, causeway = figure_material(parameters.skin, packs), ground(packs)
    for state in cape_states(parameters, cloth, gait, clip):
        models = (
            *walker(gait, state.time, skin, causeway),
            cape_model(shell, state, parameters.thickness, wool),
        )
        yield Scene(models, camera(clip.size), clip.size, background=SKY, samples=4)


def cape_model(shell: Shell, state: State, thickness: float, wool: Material) -> Model:
    """The cape of a state. thickness: in texels."""
    return garment(shell, state.positions[0], thickness * TEXEL, wool, size=CAPE_SIZE)


def cape_shell(cloth: Cloth) -> Shell:
    """How a thick cape follows the cloth."""
    return make_shell(cloth.triangles, cloth.uvs, cape_mapping(SKIN_SHEET))


def cape_states(
    parameters: CapeParameters, cloth: Cloth, gait: Gait, clip: Clip
) -> Iterator[State]:
    """The cape's state at each frame, in the figure's own frame."""
    wind = Wind((0.0, 0.0, -gait.speed - parameters.wind), seed=parameters.seed, period=LOOP)
    return motion(
        cloth,
        clip,
        forces=(Gravity(), wind),
        collisions=Collisions(gait.colliders(BODY), parameters.thickness * TEXEL),
        pins=gait.pins(cloth),
        settle=SETTLING,
    )


def cape_cloth(shape: tuple[int, int]) -> Cloth:
    """A cape on the figure's back, facing backwards, pinned by two particles at each shoulder."""
    columns, rows = shape
    shoulders = [0, 1, columns - 2, columns - 1]
    cloth = grid(columns, rows, *CAPE_SIZE, pins=shoulders)
    back = np.array([0.0, 24 * TEXEL, -2.6 * TEXEL])
    return placed(cloth, back, rotation_about((0, 1, 0), 180))
