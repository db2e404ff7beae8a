"""The banner block with its flag of cloth, or with the game's own stiff board.

A flag is simulated in its own frame, its top edge along x through the origin, and hung on the
block afterwards. All moments of an animation are simulated first, as one batch of meshes, so the
camera can frame them together.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from itertools import islice

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.packs import Packs, open_packs
from drapery.cloth import Cloth, Gravity, Wind, grid, rest_state, simulate
from drapery.mesh import Array, Mesh, vertex_normals
from drapery.render.scene import Model, Scene
from drapery.render.views import frame_view
from drapery.scenes.catalogue import Shot
from drapery.settings import LayerMode, Placement, Pose, Settings, background_colour
from drapery.style.block import (
    FLAG_SIZE,
    FLAG_SKIN,
    SCALE,
    SWAY_PERIOD,
    flag_origin,
    stiff_flag,
    wood,
)
from drapery.style.extrusion import make_shell
from drapery.style.layers import flag_look, wood_look

STEP = 1.0 / 60.0
"""The longest time step [s]: the seed's, one for each of its frames."""
SETTLING = 8.0
"""A loop is recorded after the flag has hung in the wind at least this long [s]."""
BREEZE = (0.35, 0.0, 1.0)
"""Where the wind blows to: out from the pole, and a little along the flag."""


@dataclass(frozen=True)
class Parameters:
    """A design and what `drapery animate` can be asked of it; see `Settings`."""

    design: str = "white creeper:lime border:black"
    pose: Pose = "cloth"
    placement: Placement = "standing"
    view: str = "hero"
    grid: tuple[int, int] = (5, 9)
    wind: float = 4.0
    seed: int = 0
    layers: LayerMode = "stacked"
    thickness: float = 1.0


def play(parameters: Parameters, shot: Shot) -> Iterator[Scene]:
    """A seamless loop of the banner."""
    options = {f.name: getattr(parameters, f.name) for f in fields(parameters)}
    banner = Banner.parse(options.pop("design"))
    settings = Settings(**options, size=shot.size)
    return loop(banner, open_packs(()), settings, shot.count, shot.fps)


def still(banner: Banner, packs: Packs, settings: Settings) -> Scene:
    """The banner after it has hung in the wind for `settings.time` seconds."""
    if settings.pose == "vanilla":
        flags = _stiff(settings, np.array([settings.time / SWAY_PERIOD]))
    else:
        flags = _dress(settings, _hang(settings)[None])
    return next(_scenes(banner, packs, settings, flags))


def loop(
    banner: Banner, packs: Packs, settings: Settings, count: int, fps: float
) -> Iterator[Scene]:
    """`count` scenes of a seamless loop: the last is followed by the first.

    The wind repeats after the loop's length; the flag has settled into that period.
    """
    if settings.pose == "vanilla":
        sways = max(1, round(count / fps / SWAY_PERIOD))
        flags = _stiff(settings, sways * np.arange(count) / count)
    else:
        flags = _dress(settings, _wave(settings, count, fps))
    return _scenes(banner, packs, settings, flags)


def _scenes(banner: Banner, packs: Packs, settings: Settings, flags: Mesh) -> Iterator[Scene]:
    """One scene for each moment of the flag, positions [F, V, 3], all framed alike."""
    frame = Model(wood(settings.placement), (wood_look(packs),))
    # One tuple for all moments: the renderer prepares what does not change only once.
    looks = (flag_look(banner, packs, settings.layers),)
    everything = np.concatenate([frame.mesh.positions, flags.positions.reshape(-1, 3)])
    width, height = settings.size
    camera = frame_view(settings.view, everything, width / height)
    for positions, normals in zip(flags.positions, flags.normals, strict=True):
        flag = replace(flags, positions=positions, normals=normals)
        yield Scene(
            (frame, Model(flag, looks)),
            camera,
            settings.size,
            background=background_colour(settings.background),
        )


def _stiff(settings: Settings, phases: Array) -> Mesh:
    boards = [stiff_flag(settings.placement, phase, settings.thickness) for phase in phases]
    return replace(
        boards[0],
        positions=np.stack([board.positions for board in boards]),
        normals=np.stack([board.normals for board in boards]),
    )


def _dress(settings: Settings, positions: Array) -> Mesh:
    """Thin flags [F, N, 3] in their own frame -> thick textured flags on the block."""
    cloth = _cloth(settings)
    hung = positions + flag_origin(settings.placement)
    normals = vertex_normals(hung, cloth.triangles)
    shell = make_shell(cloth.triangles, cloth.uvs, FLAG_SKIN)
    return shell.cover(hung, normals, settings.thickness * SCALE)


def _cloth(settings: Settings) -> Cloth:
    columns, rows = settings.grid
    return grid(columns, rows, *FLAG_SIZE)


def _wind(settings: Settings, period: float | None = None) -> Wind:
    direction = np.array(BREEZE) / np.linalg.norm(BREEZE)
    return Wind(tuple(settings.wind * direction), seed=settings.seed, period=period)


def _hang(settings: Settings) -> Array:
    """The flag after `time` seconds, shape [N, 3]."""
    cloth = _cloth(settings)
    steps = math.ceil(settings.time / STEP)
    if steps == 0:
        return rest_state(cloth).positions[0]
    forces = (Gravity(), _wind(settings))
    states = simulate(cloth, forces=forces, dt=settings.time / steps, every=steps)
    return next(islice(states, 1, None)).positions[0]


def _wave(settings: Settings, count: int, fps: float) -> Array:
    """One period of the flag's motion in a periodic wind, shape [count, N, 3]."""
    period = count / fps
    steps = math.ceil(1 / (fps * STEP))
    forces = (Gravity(), _wind(settings, period))
    states = simulate(_cloth(settings), forces=forces, dt=1 / (fps * steps), every=steps)
    first = math.ceil(SETTLING / period) * count
    recorded = [state.positions[0] for state in islice(states, first, first + count + 1)]
    return close_loop(np.stack(recorded))


def close_loop(motion: Array) -> Array:
    """Make a recorded motion [F + 1, ...] end where it began; returns its first F moments.

    What is left of the difference between the last moment and the first is taken back evenly
    over the loop, so no step between two moments differs from its neighbours by more than
    1/F of it.
    """
    count = len(motion) - 1
    share = np.arange(count).reshape(-1, *[1] * (motion.ndim - 1)) / count
    closed: Array = motion[:-1] + share * (motion[0] - motion[-1])
    return closed
