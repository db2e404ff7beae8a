"""A hall with 32 banners on its walls, in a breeze and one strong gust."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.cloth import Cloth, Collider, Collisions, Gravity, Plane, State, Wind
from drapery.elementary import sine_of_turns
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Camera, Light, Scene
from drapery.scenes.banners import (
    BannerBlock,
    flag_cloth,
    flag_materials,
    flag_models,
    flag_shell,
    flags_at_rest,
    wood_model,
)
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    parameter,
    seed_parameter,
    wind_parameter,
)
from drapery.style.block import SCALE
from drapery.style.block_world import Cell, blocks

WIDTH, HEIGHT, BAYS = 4, 4, 16
"""Width and height of the hall [blocks], and the number of banners along each wall."""
BAY = 2
"""Length of a bay [blocks]: one for the banner, one for the pillar."""
TORCHLIGHT = Light(((0.3, 1.0, 0.5), (-0.3, 0.4, 1.0)), 0.42, 0.6, (1.0, 0.96, 0.88))
DESIGNS = (
    "red stripe_center:yellow border:black",
    "black skull:white curly_border:gray",
    "blue cross:white rhombus:light_blue",
    "green half_horizontal_bottom:lime flower:yellow border:green",
    "purple triangles_top:magenta circle:white",
    "white creeper:green border:gray",
    "orange gradient:red globe:brown",
    "cyan small_stripes:light_blue stripe_middle:white border:blue",
)


@dataclass(frozen=True)
class Gust:
    """A gust that moves down the hall, lifts the banners off the walls and makes them flutter.

    start: when it enters the hall [s]. speed: [m/s]. length: from its front to its end [m].
    strength: the acceleration in its middle [m/s²].
    """

    start: float = 0.3
    speed: float = 11.0
    length: float = 14.0
    strength: float = 6.0

    def acceleration(self, cloth: Cloth, state: State) -> Array:
        """The acceleration [m/s²], shape [B, N, 3]. The length of the hall is along -z."""
        x, depth = state.positions[..., 0], -state.positions[..., 2]
        front = (state.time - self.start) * self.speed
        inside = 2 * (front - depth) / self.length - 1
        swell = np.maximum(0, 1 - inside * inside) ** 2
        flutter = 0.6 + 0.4 * sine_of_turns(0.35 * depth - 2.1 * state.time)
        push = self.strength * swell * flutter
        return np.stack([-np.sign(x) * push, 0.15 * push, -0.6 * push], axis=-1)


@dataclass(frozen=True)
class HallParameters(SceneParameters):
    """What can be set of the scene `hall`."""

    breeze: float = wind_parameter(1.5, "Mean speed of the wind along the hall")
    gust: float = parameter(6.0, "Acceleration in the gust's middle", (0, 60), "m/s²")
    grid: tuple[int, int] = grid_parameter((5, 9), "Particles across and down each flag")
    seed: int = seed_parameter()


def play(parameters: HallParameters, clip: Clip) -> Iterator[Scene]:
    """The hall seen from its entrance."""
    packs = open_packs(())
    cloth = flag_cloth(parameters.grid)
    shell, materials = flag_shell(cloth), flag_materials(DESIGNS, packs)
    still = (*blocks(_walls(), packs), wood_model(banner_blocks(), packs))
    for state in flag_states(parameters, cloth, clip):
        models = (*still, flag_models(shell, state, materials))
        yield Scene(models, _camera(), clip.size, TORCHLIGHT, (206, 226, 246, 255), samples=4)


def flag_states(parameters: HallParameters, cloth: Cloth, clip: Clip) -> Iterator[State]:
    """All flags at each frame."""
    breeze = Wind((0.0, 0.0, -parameters.breeze), gusts=0.5, seed=parameters.seed)
    return motion(
        cloth,
        clip,
        forces=(Gravity(), breeze, Gust(strength=parameters.gust)),
        start=flags_at_rest(cloth, banner_blocks()),
        collisions=Collisions(walls(), SCALE, order=1),
        step=1 / 60,
    )


def banner_blocks() -> tuple[BannerBlock, ...]:
    """A banner at every second block of both walls, facing into the hall."""
    places = [(side, -BAY * bay - 1.0) for bay in range(BAYS) for side in (-1, 1)]
    half = WIDTH / 2
    return tuple(
        BannerBlock((-half if side < 0 else half - 1, 1.9, z), "wall", 270.0 if side < 0 else 90.0)
        for side, z in places
    )


def walls() -> tuple[Collider, ...]:
    """The walls behind the banners, as colliders."""
    return tuple(
        Collider(Plane(np.array([side * WIDTH / 2, 0, 0]), np.array([-side, 0, 0])))
        for side in (-1.0, 1.0)
    )


def _walls() -> dict[Cell, str]:
    half, length = WIDTH // 2, BAY * BAYS + 1
    cells: dict[Cell, str] = {}
    for z in range(-length, 1):
        for x in range(-half, half):
            carpet = x in (-1, 0)
            cells[x, -1, z] = "spruce_planks" if carpet else "stone"
        for y in range(HEIGHT):
            wall = "stone_bricks" if z % BAY else "oak_log"
            cells[-half - 1, y, z] = cells[half, y, z] = wall if y else "cobblestone"
        if z % BAY == 0:
            for x in range(-half, half):
                cells[x, HEIGHT, z] = "oak_planks"
    return cells


def _camera() -> Camera:
    return Camera((1.1, 1.9, 1.6), (-1.0, 1.75, -6.0), fov=58, near=0.1, far=80)
