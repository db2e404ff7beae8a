"""A sail billows on its raft; a script controls the wind."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from drapery.banner.packs import Packs, open_packs
from drapery.cloth import Cloth, Drag, Fabric, Force, Gravity, State, Wind, grid
from drapery.cloth.colliders import Capsule, Collider
from drapery.cloth.collisions import Collisions
from drapery.cloth.exact import sine_of_turns
from drapery.cloth.solvers.verlet import SolverVerlet
from drapery.mesh import Array
from drapery.render.scene import Model, Scene
from drapery.render.views import View, frame_points
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion, placed
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    thickness_in_metres,
)
from drapery.scenes.wind_script import WindSetting, parse_script, read_script
from drapery.style.block_world import Cell, blocks
from drapery.style.extrusion import make_shell
from drapery.style.scenery import SKY, beam, post, sea
from drapery.style.tailoring import checked, garment

SIDE, SLACK = 2.6, 0.9
"""Side of the sail [m], and the distance of its pinned corners as a fraction of that."""
LOW = 0.7
"""Height of the sail's lower edge above the deck [m]."""
STERN = View(azimuth=38, elevation=14, fov=30)
CANVAS = Fabric(stretch=20.0, shear=6.0, flexion=1.0)
HALF = SIDE * SLACK / 2
HEAD, FOOT = LOW + 2 * HALF + 0.03, LOW - 0.03
"""Heights of the yards [m]."""
SPAR = 0.075
"""Radius of mast and yards as colliders [m]; they are drawn as squares of 0.12 m."""
MAST = np.array([0.0, 0.0, -0.06])
YARD_DEPTH = 0.03
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
    settings = script_of(parameters)
    cloth = square_sail(parameters.grid)
    shell = make_shell(cloth.triangles, cloth.uvs)
    canvas = checked(packs.texture("block/white_wool"), ("white", "red"), 2)
    ship = (sea(24, -0.7), *blocks(_raft(), packs), *_rigging(packs))
    camera = frame_points(STERN, _framed_points(), clip.size[0] / clip.size[1], margin=0.02)
    for state in sail_states(parameters, settings, cloth, clip):
        size = SIDE, SIDE
        sail = garment(shell, state.positions[0], parameters.thickness, canvas, size=size)
        yield Scene((*ship, sail), camera, clip.size, background=SKY, samples=4)


def script_of(parameters: SailParameters) -> tuple[WindSetting, ...]:
    """The settings of the wind. Raises OptionError."""
    return (
        read_script(parameters.script) if parameters.script else tuple(parse_script(DEFAULT_SCRIPT))
    )


def sail_states(
    parameters: SailParameters, settings: Sequence[WindSetting], cloth: Cloth, clip: Clip
) -> Iterator[State]:
    """The sail at each frame. A command takes effect at the first frame at or after its time."""
    times = [setting.time - 1e-9 for setting in settings]
    return motion(
        cloth,
        clip,
        solver=SolverVerlet(),
        forces=lambda time: _forces(parameters, settings[bisect_right(times, time) - 1]),
        collisions=Collisions(spars(), parameters.thickness, order=3),
    )


def spars() -> tuple[Collider, ...]:
    """The mast and the yards as colliders."""
    ends = [(MAST, MAST + np.array([0, HEAD + 0.4, 0]))] + [
        (np.array([-HALF, height, YARD_DEPTH]), np.array([HALF, height, YARD_DEPTH]))
        for height in (HEAD, FOOT)
    ]
    return tuple(Collider(Capsule(start, end, SPAR)) for start, end in ends)


def square_sail(shape: tuple[int, int]) -> Cloth:
    """A sail between its yards; its pinned corners are closer together than its side is long."""
    cloth = grid(*shape, SIDE, SIDE, pins="four-corners", fabric=CANVAS)
    return placed(cloth, np.array([0.0, LOW + 2 * HALF, 0.13]), SLACK * np.eye(3))


def _forces(parameters: SailParameters, setting: WindSetting) -> tuple[Force, ...]:
    turns = setting.direction / 360
    along = np.array([sine_of_turns(turns), 0.0, sine_of_turns(turns + 0.25)]) * setting.speed
    wind = Wind((along[0], 0.0, along[2]), gusts=parameters.gusts, seed=parameters.seed)
    return (Gravity(), Drag(0.4), wind)


def _raft() -> dict[Cell, str]:
    cells = {(x, -1, z): "oak_planks" for x in range(-2, 2) for z in range(-3, 3)}
    cells.update({(x, -1, z): "oak_log" for x in (-2, 1) for z in (-3, 2)})
    return cells


def _rigging(packs: Packs) -> tuple[Model, ...]:
    """The mast, and a yard at the head and the foot of the sail."""
    yards = [np.array([-HALF - 0.15, height, YARD_DEPTH]) for height in (HEAD, FOOT)]
    return post(MAST, HEAD + 0.4, packs), *(beam(yard, 2 * HALF + 0.3, packs) for yard in yards)


def _framed_points() -> Array:
    """What the camera frames [m]: the raft, the mast, and the bulge of the sail."""
    top = LOW + SIDE * SLACK + 0.4
    low = [[x, -0.9, z] for x in (-2.2, 2.2) for z in (-3.2, 3.4)]
    return np.array([*low, [0, top, 0], [1.4, top - 0.5, 1], [-1.4, top - 0.5, 1]])
