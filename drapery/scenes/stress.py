"""A cube of 17 x 17 x 17 banners, all simulated at once."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.cloth import Gravity, Wind, rest_state
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Scene, View
from drapery.scenes.backdrop import framing
from drapery.scenes.banners import FLAG_STEP, flag_cloth
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion
from drapery.scenes.parameters import SceneParameters, parameter, seed_parameter, wind_parameter
from drapery.scenes.rainbow import numbers_in_cube, rainbow_banners
from drapery.style import FLAG_MAPPING, FLAG_SIZE, cover_crowd, flag_material, make_shell
from drapery.style.block import SCALE
from drapery.style.tailoring import ClothModel

CLOTH = (5, 9)
"""Particles across and down each flag."""
CORNER = View(azimuth=32, elevation=20, fov=32)
ROOM = ((-FLAG_SIZE[0], -FLAG_SIZE[1], -0.2), (FLAG_SIZE[0], 0.05, 0.9))
"""The space that one flag may fill: two corners of a box around its place [m]."""


@dataclass(frozen=True)
class StressParameters(SceneParameters):
    """What can be set of the scene `stress`."""

    side: int = parameter(17, "Banners along each edge of the cube", (1, 24))
    spacing: tuple[float, float, float] = parameter(
        (1.9, 1.9, 1.9), "Distances of neighbouring banners", (0.1, 100), "m"
    )
    wind: float = wind_parameter(5.0)
    layers: int = parameter(4, "Patterns on each banner", (1, 16))
    settle: float = parameter(3.0, "Time before the first picture", (0, 60), "s")
    seed: int = seed_parameter()


def play(parameters: StressParameters, clip: Clip) -> Iterator[Scene]:
    """The cube in a wind whose gusts pass through it."""
    cloth, places, packs = flag_cloth(CLOTH), places_of(parameters), open_packs(())
    shell = make_shell(cloth.triangles, cloth.uvs, FLAG_MAPPING)
    banners = rainbow_banners(parameters.layers, parameters.seed)
    materials = tuple(flag_material(banner, packs) for banner in banners)
    numbers = numbers_in_cube(parameters.side)
    backdrop = framing(CORNER, places[:, None] + np.array(ROOM), clip.size)
    for positions in positions_of(parameters, clip, places):
        placed = (positions + places[:, None]).astype(np.float32)
        meshes = cover_crowd(shell, placed, SCALE)
        yield backdrop.scene([ClothModel(meshes, materials, numbers, name="banner/cloth")])


def positions_of(parameters: StressParameters, clip: Clip, places: Array) -> Iterator[Array]:
    """The positions of all flags at the moments of a clip [m], each [side³, particles, 3]."""
    cloth = flag_cloth(CLOTH)
    wind = Wind((0.4 * parameters.wind, 0.0, parameters.wind), seed=parameters.seed, origins=places)
    start, settle = rest_state(cloth, len(places), np.float32), parameters.settle
    forces = (Gravity(), wind)
    states = motion(cloth, clip, forces=forces, start=start, settle=settle, step=FLAG_STEP)
    return (state.positions for state in states)


def places_of(parameters: StressParameters) -> Array:
    """Middles of the top edges of the flags [m], shape [side³, 3]."""
    steps = np.arange(parameters.side) - (parameters.side - 1) / 2
    corners = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    places: Array = corners * np.array(parameters.spacing)
    return places
