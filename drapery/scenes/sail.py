"""A sail billows on its raft; a script controls the wind."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from drapery.cloth import Collisions, Drag, Force, Gravity, SolverVerlet, State, Wind
from drapery.elementary import sine_of_turns
from drapery.garments import find_garment
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Scene, View, frame_points
from drapery.scenes.catalogue import Clip
from drapery.scenes.dressing import Dressed
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_in_metres,
)
from drapery.scenes.wind_script import WindSetting, parse_script, read_script
from drapery.style.block_world import Cell, blocks
from drapery.style.scenery import SKY, sea
from drapery.style.tailoring import checked

STERN = View(azimuth=38, elevation=14, fov=30)
TOP = 3.44
"""The height that the camera frames [m]."""
DEFAULT_SCRIPT = """
0.0 strength 7
1.3 direction 55
2.2 off
2.8 direction -35
2.8 strength 9
2.8 on
"""
"""The script unless another is given."""


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
    packs = open_packs(())
    settings, dressed = script_of(parameters), rigged_sail(parameters)
    (sewn,) = dressed.cloths
    canvas = checked(packs.texture("block/white_wool"), ("white", "red"), 2)
    drawn = replace(sewn, pieces=(replace(sewn.pieces[0], material=canvas),))
    ship = (sea(24, -0.7), *blocks(_raft(), packs), *dressed.fixed)
    camera = frame_points(STERN, _framed_points(), clip.size[0] / clip.size[1], margin=0.02)
    for state in sail_states(parameters, settings, dressed, clip):
        sail = drawn.models(state.positions[0])
        yield Scene((*ship, *sail), camera, clip.size, background=SKY, samples=4)


def script_of(parameters: SailParameters) -> tuple[WindSetting, ...]:
    """The settings of the wind. Raises OptionError."""
    return (
        read_script(parameters.script) if parameters.script else tuple(parse_script(DEFAULT_SCRIPT))
    )


def sail_states(
    parameters: SailParameters, settings: Sequence[WindSetting], dressed: Dressed, clip: Clip
) -> Iterator[State]:
    """The sail at each frame. A command takes effect at the first frame at or after its time."""
    times = [setting.time - 1e-9 for setting in settings]
    (sewn,) = dressed.cloths
    return motion(
        sewn.cloth,
        clip,
        solver=SolverVerlet(),
        forces=lambda time: _forces(parameters, settings[bisect_right(times, time) - 1]),
        collisions=Collisions(dressed.colliders(sewn), sewn.distance, order=3),
        start=State(sewn.start[None], np.zeros_like(sewn.start)[None]),
    )


def rigged_sail(parameters: SailParameters) -> Dressed:
    """The garment `sail` with other numbers of particles and another thickness."""
    found = find_garment("sail")
    pieces = tuple(each.model_copy(update={"points": parameters.grid}) for each in found.piece)
    own = {"piece": pieces, "thickness": parameters.thickness / found.texel}
    return Dressed(found.model_copy(update=own), open_packs(()), found.settings())


def _forces(parameters: SailParameters, setting: WindSetting) -> tuple[Force, ...]:
    turns = setting.direction / 360
    along = np.array([sine_of_turns(turns), 0.0, sine_of_turns(turns + 0.25)]) * setting.speed
    wind = Wind((along[0], 0.0, along[2]), gusts=parameters.gusts, seed=parameters.seed)
    return (Gravity(), Drag(0.4), wind)


def _raft() -> dict[Cell, str]:
    cells = {(x, -1, z): "oak_planks" for x in range(-2, 2) for z in range(-3, 3)}
    cells.update({(x, -1, z): "oak_log" for x in (-2, 1) for z in (-3, 2)})
    return cells


def _framed_points() -> Array:
    """What the camera frames [m]: the raft, the mast, and the bulge of the sail."""
    low = [[x, -0.9, z] for x in (-2.2, 2.2) for z in (-3.2, 3.4)]
    return np.array([*low, [0, TOP, 0], [1.4, TOP - 0.5, 1], [-1.4, TOP - 0.5, 1]])
