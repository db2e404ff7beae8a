"""A scarf of woollen squares: its two long thin tails stream behind a walking figure."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner.dyes import DYES
from drapery.banner.packs import Packs, open_packs
from drapery.banner.sprites import tint
from drapery.cloth import Cloth, Fabric, Gravity, State, Wind, grid
from drapery.cloth.colliders import rotation_about
from drapery.cloth.collisions import Collisions
from drapery.render.scene import Material, Model, Scene, Texels, TextureLayer
from drapery.scenes.catalogue import Clip
from drapery.scenes.gait import LOOP, MAX_WALK, Gait
from drapery.scenes.moving import motion, placed
from drapery.scenes.parameters import (
    SceneParameters,
    parameter,
    seed_parameter,
    thickness_parameter,
    wind_parameter,
)
from drapery.scenes.stroll import camera, ground, walker
from drapery.style.boxes import ModelBox, box_mesh, upright
from drapery.style.extrusion import make_shell
from drapery.style.figure import SKINS, TEXEL, figure_material
from drapery.style.scenery import SKY, moved
from drapery.style.tailoring import garment

SQUARE = 4 * TEXEL
"""Edge of a square [m]: the width of the scarf. Each square shows the texture of one block."""
ROWS_PER_SQUARE = 2
TAILS = ((-2.2, 6), (2.2, 4))
"""Of each tail: its distance from the middle of the neck [texels] and its number of squares."""
BODY = ("head", "body", "right_arm", "left_arm", "right_leg", "left_leg")
COLLAR = ModelBox((-4.5, -25.5, -4.5), (9, 2.5, 9), (0, 0))


@dataclass(frozen=True)
class ScarfParameters(SceneParameters):
    """What can be set of the scene `scarf`."""

    blocks: str = parameter(
        "orange yellow red", "Blocks or dyes of the squares, starting at the neck"
    )
    skin: str = parameter("traveller", "Skin of the figure", choices=SKINS)
    speed: float = parameter(2.5, "Speed of the walk", (0, MAX_WALK), "m/s")
    wind: float = wind_parameter(2.5, "Wind from ahead, added to that of the walk")
    thickness: float = thickness_parameter(0.5)
    seed: int = seed_parameter()


def play(parameters: ScarfParameters, clip: Clip) -> Iterator[Scene]:
    """Seen from behind; the collar is stiff, the tails are cloth."""
    packs, gait = open_packs(()), Gait(parameters.speed)
    squares = [_texels(name, packs) for name in parameters.blocks.split()] or [
        _texels("red", packs)
    ]
    skin, causeway = figure_material(parameters.skin, packs), ground(packs)
    collar = Model(
        upright(box_mesh(COLLAR, (36, 16)), TEXEL, (0, 0, 0)), (_collar_material(squares),)
    )
    cloths = [tail(*place) for place in TAILS]
    shells = [make_shell(cloth.triangles, cloth.uvs) for cloth in cloths]
    materials = [_material(squares, count) for _, count in TAILS]
    motions = [tail_states(parameters, cloth, gait, clip) for cloth in cloths]
    view = camera(clip.size, tail=1.3)
    for states in zip(*motions, strict=True):
        time = states[0].time
        tails = (
            garment(shell, state.positions[0], parameters.thickness * TEXEL, material)
            for shell, state, material in zip(shells, states, materials, strict=True)
        )
        lifted = moved((collar,), np.array([0, gait.lift(time), 0]))
        models = (*walker(gait, time, skin, causeway), *lifted, *tails)
        yield Scene(models, view, clip.size, background=SKY, samples=4)


def tail(aside: float, squares: int) -> Cloth:
    """One tail, pinned by its top row at the back of the neck; it is three particles wide."""
    rows = ROWS_PER_SQUARE * squares + 1
    cloth = grid(3, rows, SQUARE, squares * SQUARE, fabric=Fabric(density=0.2))
    neck = np.array([aside * TEXEL, 25 * TEXEL, -5.2 * TEXEL])
    return placed(cloth, neck, rotation_about((0, 1, 0), 180))


def tail_states(
    parameters: ScarfParameters, cloth: Cloth, gait: Gait, clip: Clip
) -> Iterator[State]:
    """One tail at each frame, in the figure's own frame."""
    speed = gait.speed + parameters.wind
    wind = Wind((0.0, 0.0, -speed), gusts=0.35, gust_size=1.0, seed=parameters.seed, period=LOOP)
    return motion(
        cloth,
        clip,
        forces=(Gravity(), wind),
        collisions=Collisions(gait.colliders(BODY), parameters.thickness * TEXEL),
        pins=gait.pins(cloth),
        settle=LOOP,
    )


def _texels(name: str, packs: Packs) -> Texels:
    """A block's texture, or wool of a dye."""
    if name in DYES:
        return tint(packs.texture("block/white_wool"), DYES[name].rgb)
    return packs.texture(f"block/{name}")


def _material(squares: list[Texels], count: int) -> Material:
    """`count` squares below one another; the given ones repeat."""
    column = [squares[place % len(squares)] for place in range(count)]
    return Material((TextureLayer(np.ascontiguousarray(np.vstack(column))),))


def _collar_material(squares: list[Texels]) -> Material:
    """The unfolded collar, 36 x 16 texels, from the first square."""
    wool = np.tile(squares[0][:16, :16], (1, 3, 1))
    return Material((TextureLayer(np.ascontiguousarray(wool[:, :36])),))
