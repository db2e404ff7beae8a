"""Cloths fall on a beetle and on a fox of cubes, and drape over them."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.cloth import Collisions, SolverVerlet, State
from drapery.garments import SewnCloth
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
from drapery.scenes.variants import dressed, in_material, varied, with_side
from drapery.stage.dressing import Dressed
from drapery.style import SheetMapping
from drapery.style.block_world import blocks, plateau
from drapery.style.tailoring import TEXEL, checked

ABOVE = View(azimuth=22, elevation=20, fov=28)
FRAMED = (
    *((x, y, z) for x in (-2, 2) for z in (-1, 2) for y in (-1, 0)),
    *((-1.2, 2.1, 0), (1.2, 2.1, 0)),
)
"""The ground, and somewhat above the height from which the cloths fall [m]."""
DYES = (("lime", "white"), ("light_blue", "white"))
"""Of the squares of each cloth."""


@dataclass(frozen=True)
class FreefallParameters(SceneParameters):
    """What can be set of the scene `freefall`."""

    grid: tuple[int, int] = grid_parameter((20, 20), "Particles across and down each cloth")
    side: float = parameter(1.9, "Side of each cloth", (0.5, 4), "m")
    drag: float = drag_parameter(0.8)
    thickness: float = thickness_in_metres(0.04)
    friction: float = parameter(0.4, "Friction of the cloth on what it touches", (0, 2))


def play(parameters: FreefallParameters, clip: Clip) -> Iterator[Scene]:
    """From the moment when both cloths are released."""
    packs, subject = open_packs(()), falling(parameters)
    still = (*blocks(plateau(4, 3), packs), *subject.fixed, contact_shadow(subject.fixed, 0.0))
    backdrop = framing(ABOVE, FRAMED, clip.size, still, margin=0.03)
    wool = packs.texture("block/white_wool")
    drawn = [
        in_material(sewn, checked(wool, dyes), SheetMapping())
        for sewn, dyes in zip(subject.cloths, DYES, strict=True)
    ]
    motions = [cloth_states(subject, sewn, clip) for sewn in subject.cloths]
    for states in zip(*motions, strict=True):
        fallen = zip(drawn, states, strict=True)
        yield backdrop.scene(m for sewn, state in fallen for m in sewn.models(state.positions[0]))


def falling(parameters: FreefallParameters) -> Dressed:
    """The garment `freefall` with other cloths."""
    garment = varied(
        "freefall",
        piece={"points": parameters.grid},
        fabric={"drag": parameters.drag, "friction": parameters.friction},
        thickness=parameters.thickness / TEXEL,
    )
    return dressed(with_side(garment, parameters.side / TEXEL))


def cloth_states(subject: Dressed, sewn: SewnCloth, clip: Clip) -> Iterator[State]:
    """One cloth at each frame."""
    met = Collisions(subject.colliders(sewn), sewn.distance)
    return motion(sewn.cloth, clip, solver=SolverVerlet(), collisions=met)
