"""What three scenes share: a level square of cloth that is pinned at corners and released."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.cloth import Cloth, SolverVerlet, State
from drapery.garments import GarmentPin, SewnCloth, tailor
from drapery.packs import open_packs
from drapery.render import Scene, View, contact_shadow
from drapery.scenes.backdrop import framing
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    SceneParameters,
    drag_parameter,
    grid_parameter,
    parameter,
    thickness_in_metres,
)
from drapery.scenes.variants import in_material, varied
from drapery.style import SheetMapping
from drapery.style.block_world import blocks, plateau
from drapery.style.scenery import post
from drapery.style.tailoring import TEXEL, checked

HEIGHT = 2.4
"""Height of the pins [m]."""
CORNER_VIEW = View(azimuth=32, elevation=20, fov=28)
FRAMED = (*((x, y, z) for x in (-2, 2) for z in (-2, 2) for y in (-1, 0)), (0, 2.5, -1))
"""The ground, and the height of the posts [m]."""


@dataclass(frozen=True)
class CornersParameters(SceneParameters):
    """What can be set of a cloth that is pinned at corners."""

    grid: tuple[int, int] = grid_parameter((10, 10), "Particles across and down the cloth")
    limit: float = parameter(1.1, "Longest length of a spring over its rest length", (1, 2))
    drag: float = drag_parameter(0.8)
    thickness: float = thickness_in_metres(0.05)


def show(
    parameters: CornersParameters, clip: Clip, held: tuple[str, ...], back: float = -1.0
) -> Iterator[Scene]:
    """The cloth between posts at its pinned corners; held, back: see `level_cloth`."""
    packs, sewn = open_packs(()), level_cloth(parameters, held, back)
    wool = checked(packs.texture("block/white_wool"), ("cyan", "white"))
    drawn = in_material(sewn, wool, SheetMapping())
    pins = sewn.start[sewn.cloth.inv_mass == 0]
    posts = tuple(post(pin * np.array([1, 0, 1]), HEIGHT + 0.06, packs) for pin in pins)
    ground = (*blocks(plateau(4, 4), packs), *posts)
    backdrop = framing(CORNER_VIEW, FRAMED, clip.size, ground, margin=0.03)
    for state in cloth_states(sewn.cloth, parameters, clip):
        sheet = drawn.models(state.positions[0])
        shadow = contact_shadow((*posts, *sheet), 0.0, reach=HEIGHT)
        yield backdrop.scene((shadow, *sheet))


def level_cloth(
    parameters: CornersParameters, held: tuple[str, ...], back: float = -1.0
) -> SewnCloth:
    """The garment `corners`, held at some of its edges. back: z of its first row [m]."""
    garment = varied(
        "corners",
        piece={"points": parameters.grid, "place": (0.0, HEIGHT / TEXEL, back / TEXEL)},
        fabric={"drag": parameters.drag},
        thickness=parameters.thickness / TEXEL,
        pin=tuple(GarmentPin(piece="cloth", at=edge) for edge in held),
    )
    (sewn,) = tailor(garment, open_packs(()))
    return sewn


def cloth_states(cloth: Cloth, parameters: CornersParameters, clip: Clip) -> Iterator[State]:
    """The cloth at each frame after its release."""
    return motion(cloth, clip, solver=SolverVerlet(limit=parameters.limit))
