"""The door: a banner becomes a frame or an animation."""

import warnings
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Literal, Unpack

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.packs import Packs, open_packs
from drapery.render.frame import Animation, Frame
from drapery.render.scene import Scene
from drapery.settings import MAX_FRAMES, Options, Settings, within


def draw(banner: Banner, **options: Unpack[Options]) -> Frame:
    """Draw a banner as cloth; the options are those of `Settings`.

    Raises OptionError, PackError or BackendError.
    """
    return draw_with(banner, Settings(**options))


def draw_with(banner: Banner, settings: Settings) -> Frame:
    """`draw` with options that have been checked before."""
    from drapery.scenes.banner import still

    packs = open_packs(settings.packs)
    (frame,) = _drawn([still(banner, packs, settings)], packs, settings)
    return frame


def animate(
    banner: Banner, *, seconds: float = 4.0, fps: float = 20.0, **options: Unpack[Options]
) -> Animation:
    """Draw a banner waving, as a seamless loop; the options are those of `Settings`.

    seconds, fps: length of the loop [s] and its frames per second.
    Raises OptionError, PackError or BackendError.
    """
    return Animation(tuple(frames(banner, seconds, fps, Settings(**options))), fps)


def frames(banner: Banner, seconds: float, fps: float, settings: Settings) -> Iterator[Frame]:
    """The frames of `animate`, one by one as they are drawn; see `frame_count`."""
    from drapery.scenes.banner import loop

    within("fps", fps, 1, 120, "frames/s")
    within("seconds", seconds, 1 / fps, MAX_FRAMES / fps, f"s at {fps:g} frames/s")
    packs = open_packs(settings.packs)
    return _drawn(loop(banner, packs, settings, frame_count(seconds, fps), fps), packs, settings)


def frame_count(seconds: float, fps: float) -> int:
    """How many frames a loop of this length [s] has."""
    return max(1, round(seconds * fps))


def draw_face(
    banner: Banner,
    *,
    packs: Sequence[str | Path] = (),
    scale: int = 8,
    side: Literal["front", "back"] = "front",
) -> Frame:
    """The plain face of a banner, 20 x 40 texels, each `scale` pixels wide in a 64 x 64 pack.

    Raises PackError.
    """
    from drapery.banner.sprites import face

    opened = open_packs(packs)
    texels = face(banner, opened, side)
    _tell(opened)
    # Packs of other sizes keep the picture's size: nearest texel at each pixel's centre.
    down = (np.arange(40 * scale) * 2 + 1) * texels.shape[0] // (80 * scale)
    across = (np.arange(20 * scale) * 2 + 1) * texels.shape[1] // (40 * scale)
    return Frame(np.ascontiguousarray(texels[down][:, across]))


def _drawn(scenes: Iterable[Scene], packs: Packs, settings: Settings) -> Iterator[Frame]:
    from drapery.render.backends import backend

    draw_scene = backend(settings.backend)
    for number, scene in enumerate(scenes):
        yield draw_scene(scene)
        if number == 0:
            _tell(packs)


def _tell(packs: Packs) -> None:
    """Warn of what a pack lacks, once it has been asked for."""
    for line in packs.warnings():
        warnings.warn(line, UserWarning, stacklevel=4)


def draw_exploded(banner: Banner, packs: Packs, settings: Settings) -> Frame:
    """The banner's layers drawn apart along the normal. Raises PackError or BackendError."""
    from drapery.scenes.exploded import exploded

    (frame,) = _drawn([exploded(banner, packs, settings)], packs, settings)
    return frame
