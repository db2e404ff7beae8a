"""What three scenes share: a level square of cloth that is pinned at corners and released."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from drapery.cloth import Cloth, SolverVerlet, State
from drapery.cloth.pins import PinName
from drapery.garments import GarmentPin, SewnCloth, find_garment, tailor
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Scene, View, contact_shadow, frame_points
from drapery.scenes.catalogue import Clip
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
from drapery.style.scenery import SKY, post
from drapery.style.tailoring import checked

HEIGHT = 2.4
"""Height of the pins [m]."""
CORNER_VIEW = View(azimuth=32, elevation=20, fov=28)
PINNED: dict[PinName, tuple[str, ...]] = {
    "corners": ("top-left", "top-right"),
    "three-corners": ("top-left", "top-right", "bottom-left"),
    "four-corners": ("corners",),
}
"""The edges of the garment at which each scene holds it."""
DRAG = 0.8
"""Drag of the air [1/s]."""


@dataclass(frozen=True)
class CornersParameters(SceneParameters):
    """What can be set of a cloth that is pinned at corners."""

    grid: tuple[int, int] = grid_parameter((10, 10), "Particles across and down the cloth")
    limit: float = parameter(1.1, "Longest length of a spring over its rest length", (1, 2))
    drag: float = parameter(DRAG, "Drag of the air", (0, MAX_DRAG), "1/s")
    thickness: float = thickness_in_metres(0.05)


def show(corners: PinName, parameters: CornersParameters, clip: Clip) -> Iterator[Scene]:
    """The cloth between posts at its pinned corners."""
    packs, sewn = open_packs(()), level_cloth(corners, parameters)
    wool = checked(packs.texture("block/white_wool"), ("cyan", "white"))
    (piece,) = sewn.pieces
    shell = make_shell(piece.shell.sheet, piece.shell.sheet_uvs, grid=piece.shell.grid)
    drawn = replace(sewn, pieces=(replace(piece, shell=shell, material=wool),))
    pins = sewn.start[sewn.cloth.inv_mass == 0]
    posts = tuple(post(pin * np.array([1, 0, 1]), HEIGHT + 0.06, packs) for pin in pins)
    still = (*blocks(plateau(4, 4), packs), *posts)
    camera = frame_points(CORNER_VIEW, _framed_points(), clip.size[0] / clip.size[1], margin=0.03)
    for state in cloth_states(sewn.cloth, parameters, clip):
        sheet = drawn.models(state.positions[0])
        shadow = contact_shadow((*posts, *sheet), 0.0, reach=HEIGHT)
        yield Scene((*still, shadow, *sheet), camera, clip.size, background=SKY, samples=4)


def level_cloth(pins: PinName, parameters: CornersParameters) -> SewnCloth:
    """The garment `corners`, held at some of its corners; its first row is at the back.

    A cloth that is pinned at that row alone swings, so its first row is over the middle of the
    ground.
    """
    found = find_garment("corners")
    piece = found.piece[0]
    x, y, z = piece.place
    place = (x, y, 0.0 if pins == "corners" else z)
    held = tuple(GarmentPin(piece=piece.name, at=corner) for corner in PINNED[pins])
    own = {
        "piece": (piece.model_copy(update={"points": parameters.grid, "place": place}),),
        "pin": held,
        "fabric": replace(found.fabric, drag=parameters.drag),
        "thickness": parameters.thickness / found.texel,
    }
    (sewn,) = tailor(found.model_copy(update=own), open_packs(()))
    return sewn


def cloth_states(cloth: Cloth, parameters: CornersParameters, clip: Clip) -> Iterator[State]:
    """The cloth at each frame after its release."""
    return motion(cloth, clip, solver=SolverVerlet(limit=parameters.limit))


def _framed_points() -> Array:
    """What the camera frames: the ground, and the height of the posts [m]."""
    return np.array([[x, y, z] for x in (-2, 2) for z in (-2, 2) for y in (-1, 0)] + [[0, 2.5, -1]])
