"""A body before the camera: its cloth simulated or stiff, its parts beside it, the view framed.

A panel of cloth is simulated in its own frame, its top edge along x through the origin, and hung
in its place afterwards. All moments of an animation are simulated first, as one batch of meshes,
so the camera can frame them together.
"""

import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import islice
from typing import TypeAlias

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.cloth import Cloth, Gravity, Wind, grid, rest_state, simulate
from drapery.cloth.solvers.registry import solver
from drapery.mesh import Array, Mesh, vertex_normals
from drapery.render.camera import Camera
from drapery.render.light import UNLIT, Light, lit_at
from drapery.render.scene import Model, Scene
from drapery.render.shadow import contact_shadow
from drapery.render.views import VIEWS, frame_view, turntable
from drapery.settings import Pins, Settings, background_colour
from drapery.style.block import turn
from drapery.style.body import Body, Panel
from drapery.style.extrusion import make_shell
from drapery.style.kinds import body_of

STEP = 1.0 / 60.0
"""The longest time step [s]: the seed's, one for each of its frames."""
SETTLING = 8.0
"""A loop is recorded after the cloth has hung in the wind at least this long [s]."""
BREEZE = (0.35, 0.0, 1.0)
"""Where the wind blows to, before all is turned: out to the front, and a little sideways."""
MAX_KEPT = 16 << 20
"""The largest motion that is remembered [bytes]."""


def still(design: Banner | None, packs: Packs, settings: Settings) -> Scene:
    """What it looks like after it has hung in the wind for `settings.time` seconds.

    design: None for a cape or elytra. Raises OptionError or PackError.
    """
    body = body_of(design, packs, settings)
    if settings.pose == "vanilla":
        cloths = [
            _stiff(panel, settings, np.array([_phase(panel, settings.time)]))
            for panel in body.panels
        ]
    else:
        cloths = [_dress(panel, settings, _hang(panel, settings)[None]) for panel in body.panels]
    return next(_scenes(body, settings, cloths, [settings.time]))


def loop(
    design: Banner | None, packs: Packs, settings: Settings, count: int, fps: float
) -> Iterator[Scene]:
    """`count` scenes of a seamless loop: the last is followed by the first.

    The wind repeats after the loop's length; cloth has settled into that period. What does not
    move is shown from all around. Raises OptionError or PackError.
    """
    body = body_of(design, packs, settings)
    if settings.pose == "vanilla":
        cloths = [_stiff(panel, settings, _phases(panel, count, fps)) for panel in body.panels]
    else:
        cloths = [
            _dress(panel, settings, _wave(panel, settings, count, fps)) for panel in body.panels
        ]
    return _scenes(body, settings, cloths, texture_times(body.period, count, fps))


def texture_times(period: float, count: int, fps: float) -> list[float]:
    """When each frame of a loop shows its textures [s]: whole periods of theirs fill the loop.

    A period longer than one and a half loops keeps its pace; then the loop's seam shows, which
    is warned of.
    """
    length = count / fps
    periods = round(length / period) if period else 0
    if period and not periods:
        warnings.warn(
            f"the textures repeat after {period:g} s, the loop after {length:g} s, so its seam"
            f" shows; use seconds {period:g}",
            UserWarning,
            stacklevel=2,
        )
    pace = periods * period / length if periods else 1.0
    return [pace * frame / fps for frame in range(count)]


def _scenes(
    body: Body, settings: Settings, cloths: Sequence[Mesh], times: Sequence[float]
) -> Iterator[Scene]:
    """One scene for each moment of the cloths, positions [F, V, 3]; a view frames all alike."""
    parts = [_turned(part.mesh, settings) for part in body.parts]
    cloths = [_turned(cloth, settings) for cloth in cloths]
    points = np.concatenate([mesh.positions.reshape(-1, 3) for mesh in (*parts, *cloths)])
    material_getters = [part.material_at for part in body.parts] + [
        panel.material_at for panel in body.panels
    ]
    cameras = _cameras(body, settings, points, len(times))
    floor = min(0.0, float(points[:, 1].min()))
    for frame, (time, camera) in enumerate(zip(times, cameras, strict=True)):
        meshes = [*parts, *(_moment(cloth, frame) for cloth in cloths)]
        models = [
            Model(mesh, (at(time),)) for mesh, at in zip(meshes, material_getters, strict=True)
        ]
        if settings.shadow:
            models.insert(0, contact_shadow(models, floor))
        yield Scene(
            tuple(models),
            camera,
            settings.drawn_size,
            _light(body, settings),
            background_colour(settings.background),
            settings.samples,
        )


def _light(body: Body, settings: Settings) -> Light:
    """What falls on the body: its own light where the world's has these levels."""
    light = UNLIT if settings.light == "flat" else body.light
    return lit_at(light, settings.block_light, settings.sky_light, settings.daylight)


def _turned(mesh: Mesh, settings: Settings) -> Mesh:
    return turn(mesh, settings.turned) if settings.turned else mesh


def _moment(cloth: Mesh, frame: int) -> Mesh:
    return replace(cloth, positions=cloth.positions[frame], normals=cloth.normals[frame])


def _cameras(body: Body, settings: Settings, points: Array, count: int) -> list[Camera]:
    if body.camera is not None:
        return [body.camera] * count
    aspect = settings.size[0] / settings.size[1]
    camera = frame_view(settings.view, points, aspect)
    if count == 1 or _moves(body, settings):
        return [camera] * count
    return turntable(VIEWS[settings.view], points, aspect, count)


def _moves(body: Body, settings: Settings) -> bool:
    return any(settings.pose == "cloth" or panel.sway for panel in body.panels)


def _phase(panel: Panel, time: float) -> float:
    return time / panel.sway if panel.sway else 0.0


def _phases(panel: Panel, count: int, fps: float) -> Array:
    """Phases of the game's sway, a whole number of which fills the loop, shape [count]."""
    sways = max(1, round(_phase(panel, count / fps)))
    phases: Array = sways * np.arange(count) / count
    return phases


def _stiff(panel: Panel, settings: Settings, phases: Array) -> Mesh:
    boards = [panel.board(phase, settings.thickness) for phase in phases]
    return replace(
        boards[0],
        positions=np.stack([board.positions for board in boards]),
        normals=np.stack([board.normals for board in boards]),
    )


def _dress(panel: Panel, settings: Settings, positions: Array) -> Mesh:
    """Thin cloths [F, N, 3] in their own frame -> thick textured ones in their place."""
    cloth = _cloth(panel, settings)
    hung = positions + panel.origin
    normals = vertex_normals(hung, cloth.triangles)
    shell = make_shell(cloth.triangles, cloth.uvs, panel.uv_mapping)
    return shell.cover(hung, normals, settings.thickness * panel.texel)


_ClothKey: TypeAlias = tuple[int, int, float, float, Pins, str]
"""What a cloth is made of, so that equal motions are known again."""
_WindKey: TypeAlias = tuple[float, float | None, float, int]
"""What moves it: speed, direction, gusts, seed."""


def _cloth_key(panel: Panel, settings: Settings) -> _ClothKey:
    return (*settings.grid, *panel.size, settings.pins or panel.pins, settings.solver)


def _wind_key(settings: Settings) -> _WindKey:
    return settings.wind, settings.direction, settings.gusts, settings.seed


def _keyed_cloth(key: _ClothKey) -> Cloth:
    columns, rows, width, height, pins, _ = key
    return grid(columns, rows, width, height, pins=pins)


def _cloth(panel: Panel, settings: Settings) -> Cloth:
    return _keyed_cloth(_cloth_key(panel, settings))


def flow(speed: float, direction: float | None) -> tuple[float, float, float]:
    """The mean wind on what is not turned [m/s]; see `Settings` for its direction [degrees]."""
    along = np.array(BREEZE) / np.linalg.norm(BREEZE)
    if direction is not None:
        heading = math.radians(direction)
        along = np.array([math.sin(heading), 0.0, math.cos(heading)])
    x, y, z = speed * along
    return float(x), float(y), float(z)


def _wind(key: _WindKey, period: float | None = None) -> Wind:
    speed, direction, gusts, seed = key
    return Wind(flow(speed, direction), gusts=gusts, seed=seed, period=period)


def _hang(panel: Panel, settings: Settings) -> Array:
    """The cloth after `time` seconds, shape [N, 3]."""
    return _hung(_cloth_key(panel, settings), _wind_key(settings), settings.time)


def _wave(panel: Panel, settings: Settings, count: int, fps: float) -> Array:
    """One period of the cloth's motion in a periodic wind, shape [count, N, 3]."""
    size = count * math.prod(settings.grid) * 3 * np.dtype(float).itemsize
    waved = _waved if size <= MAX_KEPT else _waved.__wrapped__
    return waved(_cloth_key(panel, settings), _wind_key(settings), count, fps)


# Many banners in a row often move alike, since no design weighs anything: what was simulated
# last is remembered.


@lru_cache(maxsize=8)
def _hung(cloth_key: _ClothKey, wind_key: _WindKey, time: float) -> Array:
    cloth = _keyed_cloth(cloth_key)
    steps = math.ceil(time / STEP)
    if steps == 0:
        rest: Array = rest_state(cloth).positions[0]
        return _kept(rest)
    forces = (Gravity(), _wind(wind_key))
    method = solver(cloth_key[-1])
    states = simulate(cloth, method, forces, time / steps, every=steps)
    return _kept(next(islice(states, 1, None)).positions[0])


@lru_cache(maxsize=8)
def _waved(cloth_key: _ClothKey, wind_key: _WindKey, count: int, fps: float) -> Array:
    period = count / fps
    steps = math.ceil(1 / (fps * STEP))
    forces = (Gravity(), _wind(wind_key, period))
    cloth = _keyed_cloth(cloth_key)
    method = solver(cloth_key[-1])
    states = simulate(cloth, method, forces, 1 / (fps * steps), every=steps)
    first = math.ceil(SETTLING / period) * count
    recorded = [state.positions[0] for state in islice(states, first, first + count + 1)]
    return _kept(close_loop(np.stack(recorded)))


def _kept(positions: Array) -> Array:
    positions.flags.writeable = False
    return positions


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
