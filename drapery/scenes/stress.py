"""A cube of 17 x 17 x 17 banners, all simulated at once."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.banner import PATTERN_NAMES, Banner, Layer
from drapery.cloth import Gravity, Wind, grid, rest_state
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Material, Scene, View, frame_points
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion
from drapery.scenes.parameters import SceneParameters, parameter, seed_parameter, wind_parameter
from drapery.style import FLAG_MAPPING, FLAG_SIZE, cover_crowd, flag_material, make_shell
from drapery.style.block import SCALE
from drapery.style.scenery import SKY
from drapery.style.tailoring import ClothModel

RAINBOW = (
    *("red", "orange", "yellow", "lime", "green", "cyan", "light_blue", "blue"),
    *("purple", "magenta", "pink"),
)
VARIANTS = 6
"""Different banners in each colour of the rainbow."""
CORNER = View(azimuth=32, elevation=20, fov=32)


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
    cloth = grid(5, 9, *FLAG_SIZE)
    places = places_of(parameters)
    shell = make_shell(cloth.triangles, cloth.uvs, FLAG_MAPPING)
    materials = _materials(parameters)
    material_index = material_numbers(parameters.side)
    camera = frame_points(CORNER, places[:, None] + _framed_points(), clip.size[0] / clip.size[1])
    for positions in positions_of(parameters, clip, places):
        placed = (positions + places[:, None]).astype(np.float32)
        mesh = cover_crowd(shell, placed, SCALE)
        yield Scene(
            (ClothModel(mesh, materials, material_index),),
            camera,
            clip.size,
            background=SKY,
            samples=4,
        )


def positions_of(parameters: StressParameters, clip: Clip, places: Array) -> Iterator[Array]:
    """The positions of all flags at the moments of a clip [m], each [side³, particles, 3]."""
    cloth = grid(5, 9, *FLAG_SIZE)
    wind = Wind((0.4 * parameters.wind, 0.0, parameters.wind), seed=parameters.seed, origins=places)
    start, settle = rest_state(cloth, len(places), np.float32), parameters.settle
    forces = (Gravity(), wind)
    states = motion(cloth, clip, forces=forces, start=start, settle=settle, step=1 / 60)
    return (state.positions for state in states)


def places_of(parameters: StressParameters) -> Array:
    """Middles of the top edges of the flags [m], shape [side³, 3]."""
    steps = np.arange(parameters.side) - (parameters.side - 1) / 2
    corners = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    places: Array = corners * np.array(parameters.spacing)
    return places


def _framed_points() -> Array:
    """The space that one flag may fill: two corners of a box around its place [m]."""
    width, height = FLAG_SIZE
    low, high = np.array([-width, -height, -0.2]), np.array([width, 0.05, 0.9])
    return np.stack([low, high])


def material_numbers(side: int) -> NDArray[np.int32]:
    """The number of each banner's material, shape [side³]; colours change from corner to corner."""
    x, y, z = np.indices((side, side, side)).reshape(3, -1)
    band = (x + side - 1 - y + z) * len(RAINBOW) // (3 * side - 2)
    return (VARIANTS * band + (x + 2 * y + z) % VARIANTS).astype(np.int32)


def _materials(parameters: StressParameters) -> tuple[Material, ...]:
    """VARIANTS materials in each colour of the rainbow."""
    random = np.random.default_rng(parameters.seed)
    packs = open_packs(())
    return tuple(
        flag_material(_any_banner(dye, random, parameters.layers), packs)
        for dye in RAINBOW
        for _ in range(VARIANTS)
    )


def _any_banner(base: str, random: np.random.Generator, layers: int) -> Banner:
    """Random patterns in dyes beside the base dye in the rainbow, the last in black or white."""
    place = RAINBOW.index(base)
    neighbours = [RAINBOW[(place + step) % len(RAINBOW)] for step in (-1, 1, -2, 2)]
    dyes = [
        *(neighbours[step % 4] for step in range(layers - 1)),
        random.choice(["white", "black"]),
    ]
    patterns = random.choice(PATTERN_NAMES[1:], layers)
    pairs = zip(patterns, dyes, strict=False)
    return Banner(base, tuple(Layer(str(p), str(d)) for p, d in pairs))
