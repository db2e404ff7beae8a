"""The door: a banner becomes a frame or an animation."""

import warnings
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Unpack

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.packs import Packs, open_packs
from drapery.errors import DesignError
from drapery.render.frame import Animation, Frame, Pixels
from drapery.render.resize import enlarge
from drapery.render.scene import Scene
from drapery.settings import OPTIONS as TABLE
from drapery.settings import ROTATIONS, Options, Settings, check_format
from drapery.settings import frame_count as frame_count

if TYPE_CHECKING:
    from drapery.scenes.catalogue import Entry, Shot


def draw(banner: Banner | None = None, **options: Unpack[Options]) -> Frame:
    """Draw a banner as cloth; the options are those of `Settings`.

    banner: also a shield; None for a cape or elytra, whose texture is an option.
    Raises DesignError for what is no banner, OptionError, PackError or BackendError.
    """
    return draw_with(_design(banner), Settings(**options))


def draw_with(banner: Banner | None, settings: Settings) -> Frame:
    """`draw` with options that have been checked before."""
    from drapery.scenes.stager import still

    packs = open_packs(settings.packs, format=settings.format)
    (frame,) = _drawn([still(banner, packs, settings)], packs, settings)
    return frame


def draw_rotations(banner: Banner | None, settings: Settings) -> list[Frame]:
    """All sixteen rotations, as one camera sees them.

    Raises OptionError, PackError or BackendError.
    """
    from drapery.render.views import frame_view
    from drapery.scenes.stager import still

    packs = open_packs(settings.packs, format=settings.format)
    turned = [replace(settings, rotation=rotation) for rotation in range(ROTATIONS)]
    scenes = [still(banner, packs, each) for each in turned]
    meshes = [model.mesh for scene in scenes for model in scene.models]
    points = np.concatenate([mesh.positions.reshape(-1, 3) for mesh in meshes])
    camera = frame_view(settings.view, points, settings.size[0] / settings.size[1])
    return list(_drawn([replace(scene, camera=camera) for scene in scenes], packs, settings))


def animate(
    banner: Banner | None = None,
    *,
    seconds: float = 4.0,
    fps: float = 20.0,
    **options: Unpack[Options],
) -> Animation:
    """Draw a banner waving, as a seamless loop; the options are those of `Settings`.

    banner: see `draw`. What does not wave is shown from all around.
    seconds, fps: length of the loop [s] and its frames per second.
    Raises DesignError for what is no banner, OptionError, PackError or BackendError.
    """
    return Animation(tuple(frames(_design(banner), seconds, fps, Settings(**options))), fps)


def frames(
    banner: Banner | None, seconds: float, fps: float, settings: Settings
) -> Iterator[Frame]:
    """The frames of `animate`, one by one as they are drawn; see `frame_count`."""
    from drapery.scenes.stager import loop

    packs = open_packs(settings.packs, format=settings.format)
    count = frame_count(seconds, fps)
    return _drawn(loop(banner, packs, settings, count, fps), packs, settings)


def _design(given: object) -> Banner | None:
    if given is None or isinstance(given, Banner):
        return given
    raise DesignError(f"{str(given)[:40]!r} is no Banner; read a text with Banner.parse(text)")


def scene_frames(
    scene: "Entry", parameters: Any, shot: "Shot", backend: str = "auto", *, last: bool = False
) -> Iterator[Frame]:
    """The frames of a ready-made scene, or only its last, drawn one by one.

    Raises OptionError or BackendError.
    """
    from drapery.render.backends import backend as backend_named
    from drapery.scenes.panels import drawn

    TABLE["size"].check(shot.size)
    draw_scene = backend_named(backend)
    pictures = scene.play(parameters, shot)
    if last:
        pictures = iter([*deque(pictures, maxlen=1)])
    return (drawn(picture, draw_scene) for picture in pictures)


def draw_face(
    banner: Banner,
    *,
    packs: Sequence[str | Path] = (),
    format: int | None = None,
    scale: int = 8,
    side: Literal["front", "back"] = "front",
) -> Frame:
    """The plain face of a banner, 20 x 40 texels, each `scale` pixels wide in a 64 x 64 pack.

    format: the pack format of the game to be, as in `Settings`.
    Raises OptionError or PackError.
    """
    check_format(format)
    opened = open_packs(packs, format=format)
    pixels = face_pixels(banner, opened, scale, side)
    tell(opened)
    return Frame(pixels)


def face_pixels(
    banner: Banner, packs: Packs, scale: int, side: Literal["front", "back"] = "front"
) -> Pixels:
    """The plain face, shape [40 scale, 20 scale, 4], whatever the packs' sizes.

    Raises PackError.
    """
    from drapery.banner.sprites import face

    texels = face(banner, packs, side)
    # Packs of other sizes keep the picture's size: nearest texel at each pixel's centre.
    down = (np.arange(40 * scale) * 2 + 1) * texels.shape[0] // (80 * scale)
    across = (np.arange(20 * scale) * 2 + 1) * texels.shape[1] // (40 * scale)
    return np.ascontiguousarray(texels[down][:, across])


def _drawn(scenes: Iterable[Scene], packs: Packs, settings: Settings) -> Iterator[Frame]:
    from drapery.render.backends import backend

    draw_scene = backend(settings.backend)
    for number, scene in enumerate(scenes):
        frame = draw_scene(scene)
        yield frame if settings.pixel == 1 else enlarge(frame, settings.pixel)
        if number == 0:
            tell(packs)


def tell(packs: Packs) -> None:
    """Warn of what a pack lacks, once it has been asked for."""
    for line in packs.warnings():
        warnings.warn(line, UserWarning, stacklevel=4)


def draw_exploded(banner: Banner, packs: Packs, settings: Settings) -> Frame:
    """The banner's layers drawn apart along the normal. Raises PackError or BackendError."""
    from drapery.scenes.exploded import apart

    (frame,) = _drawn([apart(banner, packs, settings)], packs, settings)
    return frame
