"""A pixel-art cape on a hero who runs, jumps and lands: the plain method beside the tweaked one."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.banner import DYE_NAMES, DYES
from drapery.errors import OptionError
from drapery.render import Frame
from drapery.scenes.catalogue import Clip
from drapery.scenes.dots import CapeTweaks
from drapery.scenes.hero_cape import cape_dots, worn_dots
from drapery.scenes.hero_run import hero_at
from drapery.scenes.parameters import SceneParameters, parameter
from drapery.scenes.picture_grid import PictureGrid, panel_size
from drapery.scenes.pixel_landscape import GROUND_HEIGHT, landscape
from drapery.style.hero import sprite
from drapery.style.pixel import enlarged, fill_cloth, lay_sprite, with_works

CANVAS_WIDTH = 96
"""Width of the art in a panel [pixels], before it is enlarged by a whole number."""
PLAIN = CapeTweaks(False, False, False, False)


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


def play(parameters: CapePixelParameters, clip: Clip) -> Iterator[PictureGrid]:
    """The camera follows the hero; with `compare` the plain method is above."""
    p = parameters
    if p.dye not in DYES:
        raise OptionError(f"dye {p.dye!r} is not known; use one of: {', '.join(DYES)}")
    variants = {"as it is": PLAIN} if p.compare else {}
    variants["tweaked"] = CapeTweaks(p.air, p.turning, p.push, p.hooks)
    size = panel_size(clip.size, 1, len(variants))
    labels = tuple(variants) if p.compare else ("",)
    rows = (_frames(p, tweaks, size, clip) for tweaks in variants.values())
    for pictures in zip(*rows, strict=True):
        yield PictureGrid(pictures, labels, columns=1)


def _frames(
    p: CapePixelParameters, tweaks: CapeTweaks, size: tuple[int, int], clip: Clip
) -> Iterator[Frame]:
    scale = max(1, size[0] // CANVAS_WIDTH)
    width, height = -(-size[0] // scale), -(-size[1] // scale)
    cape = cape_dots(p.grid)
    for dots, time in worn_dots(cape, tweaks, p.passes, clip):
        hero = hero_at(time)
        feet = np.round(np.array([width * 0.55, height - GROUND_HEIGHT + hero.feet[1]]))
        canvas = landscape(width, height, hero.feet[0])
        fill_cloth(canvas, cape.shape, dots + feet, np.array(DYES[p.dye].rgb), p.hem)
        lay_sprite(canvas, sprite(hero.legs), feet + np.array([-6.0, -20.0]))
        large = enlarged(canvas, scale, size)
        if p.debug:
            large = with_works(large, cape.shape, dots + feet, cape.pairs, cape.pinned, scale)
        yield Frame(large)
