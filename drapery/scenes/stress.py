"""A cube of 17 x 17 x 17 banners, all simulated at once: the mod's stress test."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.packs import open_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.cloth import Gravity, Wind, grid, rest_state, simulate
from drapery.mesh import Array, vertex_normals
from drapery.render.scene import Look, Model, Scene
from drapery.render.views import View, frame_points
from drapery.scenes.catalogue import Shot
from drapery.style.block import FLAG_SIZE, FLAG_SKIN, SCALE
from drapery.style.extrusion import make_shell
from drapery.style.layers import flag_look

CORNER = View(azimuth=32, elevation=20, fov=32)


@dataclass(frozen=True)
class Parameters:
    """side: banners along each edge of the cube. spacing: between them [m]. wind: [m/s].

    designs: how many different banners. layers: patterns on each. settle: time before the first
    picture [s].
    """

    side: int = 17
    spacing: tuple[float, float, float] = (1.1, 2.0, 1.1)
    wind: float = 5.0
    designs: int = 64
    layers: int = 4
    settle: float = 3.0
    seed: int = 0


def play(parameters: Parameters, shot: Shot) -> Iterator[Scene]:
    """The cube in a wind whose gusts travel through it."""
    cloth = grid(5, 9, *FLAG_SIZE)
    places = _places(parameters)
    shell = make_shell(cloth.triangles, cloth.uvs, FLAG_SKIN)
    looks = _looks(parameters)
    look_index = (np.arange(len(places)) % len(looks)).astype(np.int32)
    camera = frame_points(CORNER, places[:, None] + _room(), shot.size[0] / shot.size[1])
    for positions in _motion(parameters, shot, places):
        hung = (positions + places[:, None]).astype(np.float32)
        mesh = shell.cover(hung, vertex_normals(hung, cloth.triangles), SCALE)
        yield Scene((Model(mesh, looks, look_index),), camera, shot.size)


def _motion(parameters: Parameters, shot: Shot, places: Array) -> Iterator[Array]:
    cloth = grid(5, 9, *FLAG_SIZE)
    steps = max(1, round(60 / shot.fps))
    wind = Wind((0.4 * parameters.wind, 0.0, parameters.wind), seed=parameters.seed, origins=places)
    start = rest_state(cloth, len(places), np.float32)
    states = simulate(
        cloth, forces=(Gravity(), wind), dt=1 / (shot.fps * steps), every=steps, start=start
    )
    first = round(parameters.settle * shot.fps)
    return (state.positions for state in islice(states, first, first + shot.count))


def _places(parameters: Parameters) -> Array:
    """Middles of the top edges, shape [side³, 3]."""
    steps = np.arange(parameters.side) - (parameters.side - 1) / 2
    corners = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    places: Array = corners * np.array(parameters.spacing)
    return places


def _room() -> Array:
    """What one flag may fill [m], as the corners of a box around its place."""
    width, height = FLAG_SIZE
    low, high = np.array([-width, -height, -0.2]), np.array([width, 0.05, 0.9])
    return np.stack([low, high])


def _looks(parameters: Parameters) -> tuple[Look, ...]:
    random = np.random.default_rng(parameters.seed)
    packs = open_packs(())
    return tuple(
        flag_look(_any_banner(random, parameters.layers), packs) for _ in range(parameters.designs)
    )


def _any_banner(random: np.random.Generator, layers: int) -> Banner:
    dyes = random.choice(DYE_NAMES, layers + 1)
    patterns = random.choice(PATTERN_NAMES[1:], layers)
    pairs = zip(patterns, dyes[1:], strict=True)
    return Banner(str(dyes[0]), tuple(Layer(str(p), str(d)) for p, d in pairs))
