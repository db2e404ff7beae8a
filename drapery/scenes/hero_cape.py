"""A cape of dots on the back of the hero of pixels."""

from collections.abc import Iterator

import numpy as np

from drapery.mesh import Array
from drapery.scenes.catalogue import Clip
from drapery.scenes.dots import STEP, CapeTweaks, DotCloth, dot_grid, step
from drapery.scenes.hero_run import LOOP, HeroState, hero_at

ACROSS, DOWN = 2.6, 2.2
"""How far neighbouring dots may be apart [pixels]."""


def cape_dots(shape: tuple[int, int]) -> DotCloth:
    """The cape. shape: dots across and down."""
    return dot_grid(*shape, across=ACROSS, down=DOWN)


def worn_dots(
    dots: DotCloth, tweaks: CapeTweaks, passes: int, clip: Clip
) -> Iterator[tuple[Array, float]]:
    """At each frame the dots from the hero's feet [pixels], shape [N, 2], and the time [s].

    dots: the cape.
    tweaks: which additions to the plain method are on.
    passes: over all constraints in a step.
    """
    steps = round(LOOP / STEP)
    now = before = _rest(dots, tweaks)
    places = [now]
    # One loop to settle, then the frames of the clip.
    for number in range(1, steps + round((clip.count - 1) / clip.fps / STEP) + 1):
        hero = hero_at(number * STEP)
        hooks = hero.feet + hooks_of(dots, hero, tweaks)
        now, before = step(dots, now, before, hooks, hero.velocity, tweaks, passes), now
        np.minimum(now[:, 1], 0.0, out=now[:, 1])  # the ground is at 0, and y points down
        places.append(now)
    for frame in range(clip.count):
        number = steps + round(frame / clip.fps / STEP)
        yield places[number] - hero_at(number * STEP).feet, number * STEP


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
