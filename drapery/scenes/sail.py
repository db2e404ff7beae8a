"""A sail billows on its raft; a script controls the wind."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from drapery.cloth import Collisions, Drag, Gravity, SolverVerlet, State
from drapery.packs import open_packs
from drapery.render import Scene, View
from drapery.scenes.backdrop import framing
from drapery.scenes.buildings import raft
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_in_metres,
)
from drapery.scenes.variants import dressed, in_material, varied
from drapery.stage.dressing import Dressed
from drapery.stage.wind_script import WindSetting, read_script, setting_at
from drapery.style.block_world import blocks
from drapery.style.scenery import sea
from drapery.style.tailoring import TEXEL, checked

STERN = View(azimuth=38, elevation=14, fov=30)
FRAMED = (
    *((x, -0.9, z) for x in (-2.2, 2.2) for z in (-3.2, 3.4)),
    *((0, 3.44, 0), (1.4, 2.94, 1), (-1.4, 2.94, 1)),
)
"""The raft, the mast, and the bulge of the sail [m]."""


@dataclass(frozen=True)
class SailParameters(SceneParameters):
    """What can be set of the scene `sail`."""

    script: str = parameter("", "A file of commands to the wind")
    grid: tuple[int, int] = grid_parameter((10, 10), "Particles across and down the sail")
    gusts: float = parameter(0.3, "Gusts of the wind over its speed", (0, 2))
    thickness: float = thickness_in_metres(0.05)
    seed: int = seed_parameter()


def play(parameters: SailParameters, clip: Clip) -> Iterator[Scene]:
    """From the start of the wind."""
    packs, settings = open_packs(()), read_script(parameters.script)
    rigged = rigged_sail(parameters)
    canvas = checked(packs.texture("block/white_wool"), ("white", "red"), 2)
    (sail,) = (in_material(sewn, canvas) for sewn in rigged.cloths)
    ship = (sea(24, -0.7), *blocks(raft(), packs), *rigged.fixed)
    backdrop = framing(STERN, FRAMED, clip.size, ship, margin=0.02)
    for state in sail_states(parameters, settings, rigged, clip):
        yield backdrop.scene(sail.models(state.positions[0]))


def rigged_sail(parameters: SailParameters) -> Dressed:
    """The garment `sail` with other numbers of particles and another thickness."""
    points, thickness = {"points": parameters.grid}, parameters.thickness / TEXEL
    return dressed(varied("sail", piece=points, thickness=thickness))


def sail_states(
    parameters: SailParameters, settings: Sequence[WindSetting], rigged: Dressed, clip: Clip
) -> Iterator[State]:
    """The sail at each frame. A command takes effect at the first frame at or after its time."""
    (sewn,) = rigged.cloths
    gusts, seed = parameters.gusts, parameters.seed
    return motion(
        sewn.cloth,
        clip,
        solver=SolverVerlet(),
        forces=lambda time: (Gravity(), Drag(0.4), setting_at(settings, time).wind(gusts, seed)),
        collisions=Collisions(rigged.colliders(sewn), sewn.distance, order=3),
        start=State(sewn.start[None], np.zeros_like(sewn.start)[None]),
    )
