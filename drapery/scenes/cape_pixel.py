"""A pixel-art cape on a hero who runs, jumps and lands: the plain method beside the tweaked one."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw

from drapery.banner import DYE_NAMES, DYES
from drapery.errors import OptionError
from drapery.mesh import Array
from drapery.render import Frame, Pixels
from drapery.scenes.catalogue import Clip
from drapery.scenes.dots import STEP, CapeTweaks, DotCloth, dot_grid, step
from drapery.scenes.parameters import SceneParameters, parameter
from drapery.scenes.picture_grid import PictureGrid, panel_size
from drapery.style.hero import RUN, sprite
from drapery.style.pixel import bounding_box, fill_polygon, outline

CANVAS_WIDTH = 96
"""Width of the art in a panel [pixels], before it is enlarged by a whole number."""
LOOP = 4.0
DISTANCE = 200
"""How far the hero runs in one loop, after which the ground repeats [pixels]."""
RUNNING = ((0.0, 2.5), (3.3, 4.0))
"""When the hero runs, from and to [s]; it stands at other times."""
JUMP = (0.9, 1.7, 17.0)
"""Take-off and landing [s], and height [pixels]."""
SKY_PIXEL, HILL, GRASS, EARTH = (146, 192, 232), (122, 172, 206), (104, 162, 84), (120, 86, 62)
ACROSS, DOWN = 2.6, 2.2
"""How far neighbouring dots may be apart [pixels]."""
GROUND_HEIGHT = 8
"""Height of the ground in the picture [pixels]."""
FRAMES_PER_SECOND = 10
"""Frame rate of the running animation [1/s]."""


@dataclass(frozen=True)
class CapePixelParameters(SceneParameters):
    """What can be set of the scene `cape-pixel`."""

    air: bool = parameter(True, "Whether the air resists")
    turning: bool = parameter(True, "Whether the cape's turning is damped")
    push: bool = parameter(True, "Whether the cape is pushed opposite to the hero's motion")
    hooks: bool = parameter(True, "Whether the pins move with the hero's animation")
    compare: bool = parameter(True, "Whether the plain method is shown too")
    debug: bool = parameter(
        False, "Shows dots green, constraints blue, pins red and the bounding box orange"
    )
    dye: str = parameter("red", "Dye of the cape", choices=DYE_NAMES)
    hem: bool = parameter(True, "Whether the lower edge has a second tone")
    grid: tuple[int, int] = parameter((3, 6), "Dots across and down the cape", (2, 32), "dots")
    passes: int = parameter(3, "Passes over all constraints in a step", (0, 64))


@dataclass(frozen=True)
class HeroState:
    """Where the hero is: its feet [pixels], how it moves [pixels/s], and its legs."""

    feet: Array
    velocity: Array
    legs: str


def play(parameters: CapePixelParameters, clip: Clip) -> Iterator[PictureGrid]:
    """The camera follows the hero; with `compare` the plain method is above."""
    if parameters.dye not in DYES:
        raise OptionError(f"dye {parameters.dye!r} is not known; use one of: {', '.join(DYES)}")
    tweaks = CapeTweaks(parameters.air, parameters.turning, parameters.push, parameters.hooks)
    variants = {"as it is": CapeTweaks(False, False, False, False)} if parameters.compare else {}
    variants["tweaked"] = tweaks
    size = panel_size(clip.size, 1, len(variants))
    labels = tuple(variants) if parameters.compare else ("",)
    rows = (_frames(parameters, variant, size, clip) for variant in variants.values())
    for pictures in zip(*rows, strict=True):
        yield PictureGrid(pictures, labels, columns=1)


def motion(
    parameters: CapePixelParameters, tweaks: CapeTweaks, clip: Clip
) -> Iterator[tuple[Array, float]]:
    """At each frame the dots from the hero's feet [pixels], shape [N, 2], and the time [s]."""
    dots = dot_grid(*parameters.grid, across=ACROSS, down=DOWN)
    steps = round(LOOP / STEP)
    now = before = _rest(dots, tweaks)
    places = [now]
    # One loop to settle, then the frames of the clip.
    for number in range(1, steps + round((clip.count - 1) / clip.fps / STEP) + 1):
        hero = hero_at(number * STEP)
        hooks = hero.feet + hooks_of(dots, hero, tweaks)
        now, before = step(dots, now, before, hooks, hero.velocity, tweaks, parameters.passes), now
        np.minimum(now[:, 1], 0.0, out=now[:, 1])  # the ground is at 0, and y points down
        places.append(now)
    for frame in range(clip.count):
        number = steps + round(frame / clip.fps / STEP)
        yield places[number] - hero_at(number * STEP).feet, number * STEP


def hero_at(time: float) -> HeroState:
    """The hero at a time [s]."""
    rounds, moment = divmod(time + 1e-9, LOOP)
    spent = [min(max(moment - start, 0.0), end - start) for start, end in RUNNING]
    speed = DISTANCE / sum(end - start for start, end in RUNNING)
    runs = any(start <= moment < end for start, end in RUNNING)
    start, end, top = JUMP
    part = (moment - start) / (end - start)
    flies = 0 < part < 1
    height = 4 * top * part * (1 - part) if flies else 0.0
    climb = 4 * top * (1 - 2 * part) / (end - start) if flies else 0.0
    feet = np.array([DISTANCE * rounds + speed * sum(spent), -height])
    velocity = np.array([speed if runs else 0.0, -climb])
    return HeroState(feet, velocity, _legs(moment, runs, flies, climb))


def hooks_of(dots: DotCloth, hero: HeroState, tweaks: CapeTweaks) -> Array:
    """Where the top row is fastened, relative to the feet [pixels], shape [P, 2].

    The hooks lie along the shoulders. While the hero runs or falls, the tweak `hooks` lowers those
    at the back, so that a cape that streams behind keeps some height.
    """
    count = len(dots.pinned)
    part = np.linspace(0, 1, count)  # 0 at the back
    places = np.stack([-6.0 + 5.0 * part, np.full(count, -12.5)], axis=1)
    if tweaks.hooks and hero.velocity[0] > 0 and hero.velocity[1] >= 0:
        places[:, 0] += 1.5 * (1 - part)
        places[:, 1] += 5.5 * (1 - part)
    return places


def _rest(dots: DotCloth, tweaks: CapeTweaks) -> Array:
    rows, columns = dots.shape
    hooks = hooks_of(dots, hero_at(0.0), tweaks)
    down = np.arange(rows)[:, None, None] * np.array([0.0, 2.0])
    return np.reshape(hooks[None] + down, (rows * columns, 2))


def _legs(moment: float, runs: bool, flies: bool, climb: float) -> str:
    if flies:
        return "rise" if climb > 0 else "fall"
    return RUN[int(moment * FRAMES_PER_SECOND) % len(RUN)] if runs else "stand"


def _frames(
    parameters: CapePixelParameters, tweaks: CapeTweaks, size: tuple[int, int], clip: Clip
) -> Iterator[Frame]:
    scale = max(1, size[0] // CANVAS_WIDTH)
    width, height = -(-size[0] // scale), -(-size[1] // scale)
    dots = dot_grid(*parameters.grid, across=ACROSS, down=DOWN)
    for places, time in motion(parameters, tweaks, clip):
        hero = hero_at(time)
        feet = np.round(np.array([width * 0.55, height - GROUND_HEIGHT + hero.feet[1]]))
        canvas = _landscape(width, height, hero.feet[0])
        _draw_cape(canvas, parameters, dots, places + feet)
        _lay(canvas, sprite(hero.legs), feet + np.array([-6.0, -20.0]))
        large = canvas.repeat(scale, axis=0).repeat(scale, axis=1)[: size[1], : size[0]]
        if parameters.debug:
            large = _debug(large, dots, places + feet, scale)
        yield Frame(np.ascontiguousarray(large))


def _draw_cape(
    canvas: Pixels, parameters: CapePixelParameters, dots: DotCloth, places: Array
) -> None:
    """Fill the outline of the cape, and its last row of cells in the second tone."""
    height, width = canvas.shape[:2]
    rgb = np.array(DYES[parameters.dye].rgb)
    canvas[fill_polygon(places[outline(*dots.shape)], width, height), :3] = rgb
    if parameters.hem and dots.shape[0] > 2:
        low = places[(dots.shape[0] - 2) * dots.shape[1] :]
        canvas[fill_polygon(low[outline(2, dots.shape[1])], width, height), :3] = rgb * 2 // 3


def _landscape(width: int, height: int, ran: float) -> Pixels:
    """Sky, hills that move at half the speed, and ground with stones. ran: the distance run."""
    canvas = np.empty((height, width, 4), np.uint8)
    canvas[..., 3] = 255
    canvas[..., :3] = SKY_PIXEL
    x, y = np.arange(width), np.arange(height)[:, None]
    top = height - GROUND_HEIGHT
    far = (x + round(ran / 2)) % (DISTANCE // 2) / (DISTANCE // 2)
    near = (x + round(ran)) % 20
    hills = top - 5 - np.round(16 * np.abs(far - 0.5)) - np.round(6 * np.abs(far * 3 % 1 - 0.5))
    canvas[y >= hills, :3] = HILL
    canvas[top:, :, :3] = EARTH
    tufts = np.array([3, 2, 2, 3, 4, 3, 2, 2, 3, 3, 2, 4, 3, 2, 2, 2, 3, 4, 3, 2])[near]
    canvas[(y >= top) & (y < top + tufts), :3] = GRASS
    stone = (y >= top + 6) & (y < top + 8) & np.isin(near, (5, 6, 7))
    canvas[stone, :3] = np.array(EARTH) * 3 // 4
    return canvas


def _lay(canvas: Pixels, texels: Pixels, corner: Array) -> None:
    """Put a sprite on the canvas where it is not transparent; the part outside is cut off."""
    left, top = (int(value) for value in corner)
    rows, columns = np.nonzero(texels[..., 3])
    y, x = rows + top, columns + left
    seen = (y >= 0) & (y < canvas.shape[0]) & (x >= 0) & (x < canvas.shape[1])
    canvas[y[seen], x[seen]] = texels[rows[seen], columns[seen]]


def _debug(pixels: Pixels, dots: DotCloth, places: Array, scale: int) -> Pixels:
    """The enlarged picture with dots, constraints, pins and bounding box drawn over it."""
    image = Image.fromarray(pixels)
    pen = ImageDraw.Draw(image)
    at = [(float(x), float(y)) for x, y in places * scale]
    box = bounding_box(places[outline(*dots.shape)], pixels.shape[1], pixels.shape[0])
    pen.rectangle([value * scale for value in box], outline=(240, 150, 40))
    for i, j in dots.pairs.tolist():
        pen.line((*at[i], *at[j]), fill=(60, 110, 230))
    for number, (x, y) in enumerate(at):
        pinned = number in dots.pinned
        radius = max(2, scale - 1) if pinned else max(1, scale // 2)
        colour = (220, 40, 40) if pinned else (60, 200, 80)
        pen.ellipse((x - radius, y - radius, x + radius, y + radius), fill=colour)
    return np.asarray(image)
