"""Cloths fall on a beetle and on a fox of cubes, and drape over them."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from drapery.cloth import Collisions, SolverVerlet, State
from drapery.garments import GridPiece, SewnCloth, find_garment
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Scene, Texels, View, contact_shadow, frame_points
from drapery.scenes.catalogue import Clip
from drapery.scenes.dressing import Dressed
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    MAX_DRAG,
    SceneParameters,
    grid_parameter,
    parameter,
    thickness_in_metres,
)
from drapery.style import make_shell
from drapery.style.block_world import blocks, plateau
from drapery.style.scenery import SKY
from drapery.style.tailoring import checked

ABOVE = View(azimuth=22, elevation=20, fov=28)
HEIGHT = 1.9
"""From where the cloths fall [m]."""
DYES = (("lime", "white"), ("light_blue", "white"))
"""Of the squares of each cloth."""


@dataclass(frozen=True)
class FreefallParameters(SceneParameters):
    """What can be set of the scene `freefall`."""

    grid: tuple[int, int] = grid_parameter((20, 20), "Particles across and down each cloth")
    side: float = parameter(1.9, "Side of each cloth", (0.5, 4), "m")
    drag: float = parameter(0.8, "Drag of the air", (0, MAX_DRAG), "1/s")
    thickness: float = thickness_in_metres(0.04)
    friction: float = parameter(0.4, "Friction of the cloth on what it touches", (0, 2))


def play(parameters: FreefallParameters, clip: Clip) -> Iterator[Scene]:
    """From the moment when both cloths are released."""
    packs, dressed = open_packs(()), falling(parameters)
    still = (*blocks(plateau(4, 3), packs), *dressed.fixed, contact_shadow(dressed.fixed, 0.0))
    wool = packs.texture("block/white_wool")
    drawn = [_chequered(*pair, wool) for pair in zip(dressed.cloths, DYES, strict=True)]
    camera = frame_points(ABOVE, _framed_points(), clip.size[0] / clip.size[1], margin=0.03)
    motions = [cloth_states(dressed, sewn, clip) for sewn in dressed.cloths]
    for states in zip(*motions, strict=True):
        fallen = (
            model
            for sewn, state in zip(drawn, states, strict=True)
            for model in sewn.models(state.positions[0])
        )
        yield Scene((*still, *fallen), camera, clip.size, background=SKY, samples=4)


def _chequered(sewn: SewnCloth, dyes: tuple[str, str], wool: Texels) -> SewnCloth:
    """A cloth of squares of two dyes."""
    (piece,) = sewn.pieces
    shell = make_shell(piece.shell.sheet, piece.shell.sheet_uvs, grid=piece.shell.grid)
    drawn = replace(piece, shell=shell, material=checked(wool, dyes))
    return replace(sewn, pieces=(drawn,))


def falling(parameters: FreefallParameters) -> Dressed:
    """The garment `freefall` with other cloths."""
    found = find_garment("freefall")
    pieces = (each for each in found.piece if isinstance(each, GridPiece))
    own = {
        "piece": tuple(_sized(each, parameters, found.texel) for each in pieces),
        "fabric": replace(found.fabric, drag=parameters.drag, friction=parameters.friction),
        "thickness": parameters.thickness / found.texel,
    }
    return Dressed(found.model_copy(update=own), open_packs(()), found.settings())


def _sized(piece: GridPiece, parameters: FreefallParameters, texel: float) -> GridPiece:
    """A level cloth with other numbers of particles and another side, about the same middle."""
    side = parameters.side / texel
    further, turn = (side - piece.size[1]) / 2, math.radians(piece.turn[1])
    x, y, z = piece.place
    place = (x - further * math.sin(turn), y, z - further * math.cos(turn))
    return piece.model_copy(
        update={"points": parameters.grid, "size": (side, side), "place": place}
    )


def cloth_states(dressed: Dressed, sewn: SewnCloth, clip: Clip) -> Iterator[State]:
    """One cloth at each frame."""
    met = Collisions(dressed.colliders(sewn), sewn.distance)
    return motion(sewn.cloth, clip, solver=SolverVerlet(), collisions=met)


def _framed_points() -> Array:
    """What the camera frames [m]."""
    low = [[x, y, z] for x in (-2, 2) for z in (-1, 2) for y in (-1, 0)]
    return np.array([*low, [-1.2, HEIGHT + 0.2, 0], [1.2, HEIGHT + 0.2, 0]])
