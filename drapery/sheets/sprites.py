"""Sprites of games: a loop from each of several directions, by one camera."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.packs import open_packs
from drapery.errors import OptionError
from drapery.pictures import draw_scenes
from drapery.render import Frame, frame_view
from drapery.settings import ROTATIONS, LoopSettings, Settings
from drapery.stage.subjects import loop

if TYPE_CHECKING:
    from drapery.garments.model import Garment

POINTS = (
    *("south", "south-southwest", "southwest", "west-southwest"),
    *("west", "west-northwest", "northwest", "north-northwest"),
    *("north", "north-northeast", "northeast", "east-northeast"),
    *("east", "east-southeast", "southeast", "south-southeast"),
)
"""Where a banner of each rotation looks to."""


def draw_sprites(
    banner: "Banner | Garment | None",
    settings: Settings,
    *,
    directions: int = 8,
    seconds: float = 1.0,
    fps: float = 8.0,
    on_direction: Callable[[int, int], object] | None = None,
) -> dict[str, tuple[Frame, ...]]:
    """The loop of a standing banner or a garment as it looks to each of some directions, by name.

    The motion is the same in all, and one camera shows them at one scale. Where a style draws large
    pixels, a picture has one pixel for each: the sprites of 128 x 128 pixels in `pixel-art` have 64
    x 64.

    banner: what to draw, see `drapery.draw`.
    settings: the options of the pictures; the rotation is chosen here.
    directions: 1, 2, 4, 8 or 16, south first, then clockwise as seen from above.
    seconds: length of each loop [s].
    fps: [frames/s] of each loop.
    on_direction: called with the number of finished directions and of all.

    Raises OptionError, PackError or BackendError, as `drapery.draw` does.
    """
    if directions not in (1, 2, 4, 8, 16):
        raise OptionError(f"directions {directions!r}: give 1, 2, 4, 8 or 16")
    count = LoopSettings(seconds, fps).count
    packs = open_packs(settings.packs, format=settings.format)
    rotations = range(0, ROTATIONS, ROTATIONS // directions)
    turned = [settings.changed(rotation=rotation) for rotation in rotations]
    loops = [list(loop(banner, packs, each, count, fps)) for each in turned]
    models = [model for scenes in loops for scene in scenes for model in scene.models]
    points = np.concatenate([model.mesh.positions.reshape(-1, 3) for model in models])
    camera = frame_view(settings.view, points, settings.size[0] / settings.size[1])
    drawn = []
    for number, scenes in enumerate(loops, 1):
        framed = [replace(scene, camera=camera) for scene in scenes]
        drawn.append(list(draw_scenes(framed, packs, settings, loop=True)))
        if on_direction is not None:
            on_direction(number, directions)
    side = large_pixel([frame for frames in drawn for frame in frames])
    return {
        POINTS[rotation]: tuple(Frame(frame.pixels[::side, ::side].copy()) for frame in frames)
        for rotation, frames in zip(rotations, drawn, strict=True)
    }


def large_pixel(frames: Sequence[Frame]) -> int:
    """The side of the largest squares of one colour of which all pictures consist [pixels]."""
    side = 0
    for frame in frames:
        for pixels in (frame.pixels, frame.pixels.swapaxes(0, 1)):
            changes = 1 + np.flatnonzero((pixels[1:] != pixels[:-1]).any(axis=(1, 2)))
            side = math.gcd(side, *map(int, changes))
    return side or 1
