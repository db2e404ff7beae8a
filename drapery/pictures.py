"""Functions from a banner to a picture, an animation, its plain face or a 3-D file."""

import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, Unpack

from drapery.arrays import Pixels
from drapery.banner.design import Banner
from drapery.banner.packs import Packs, open_packs
from drapery.banner.packs.stack import PackLike
from drapery.errors import DesignError, OptionError
from drapery.option import Output, one_of
from drapery.render.frame import Animation, Frame, enlarge
from drapery.render.scene import Scene
from drapery.settings import LoopSettings, Options, Settings, check_format, settled_for

if TYPE_CHECKING:
    from drapery.garments.model import Garment

ORIGINS = {"corner": (0.0, 0.0, 0.0), "centre": (0.5, 0.0, 0.5)}
"""Places that may be the origin of a 3-D file [m]."""

__all__ = ["animate", "draw", "draw_face", "draw_scenes", "iter_frames", "save_model"]


def draw(
    banner: "Banner | Garment | None" = None,
    settings: Settings | None = None,
    **options: Unpack[Options],
) -> Frame:
    """Draw a banner as cloth. Options of a garment's file count where no argument gives others.

    banner: a banner, shield or `Garment`; None for a cape or elytra, whose texture is an option.
    settings: the options of the picture; by default `Settings()`.
    options: fields of `Settings` by name, which override those of `settings`.

    Raises DesignError if `banner` is something else, OptionError, PackError or BackendError.
    """
    design, chosen = _checked(banner, settings, options, "still")
    from drapery.stage.subjects import still

    packs = open_packs(chosen.packs, format=chosen.format)
    (frame,) = draw_scenes([still(design, packs, chosen)], packs, chosen)
    return frame


def animate(
    banner: "Banner | Garment | None" = None,
    settings: Settings | None = None,
    *,
    seconds: float = 4.0,
    fps: float = 20.0,
    **options: Unpack[Options],
) -> Animation:
    """Draw a banner waving in the wind, as a seamless loop.

    A model that does not wave is shown from all sides.

    banner: what to draw, see `draw`.
    settings: the options of the pictures, see `draw`.
    seconds: length of the loop [s].
    fps: [frames/s].
    options: fields of `Settings` by name, which override those of `settings`.

    Raises DesignError if `banner` is something else, OptionError, PackError or BackendError.
    """
    frames = iter_frames(banner, settings, seconds=seconds, fps=fps, **options)
    return Animation(tuple(frames), fps)


def iter_frames(
    banner: "Banner | Garment | None" = None,
    settings: Settings | None = None,
    *,
    seconds: float = 4.0,
    fps: float = 20.0,
    on_moment: Callable[[int, int], object] | None = None,
    **options: Unpack[Options],
) -> Iterator[Frame]:
    """The frames of `animate`, each drawn when the iterator reaches it.

    All arguments are checked, all packs opened, and all cloth moved, before this returns.

    banner: what to draw, see `draw`.
    settings: the options of the pictures, see `draw`.
    seconds: length of the loop [s].
    fps: [frames/s].
    on_moment: called at each moment of the cloth's motion with its number and the number of the
        last one; it may raise to end the work.
    options: fields of `Settings` by name, which override those of `settings`.

    Raises DesignError, OptionError, PackError or BackendError, as `animate` does.
    """
    from drapery.stage.subjects import loop

    design, chosen = _checked(banner, settings, options, "loop")
    timing = LoopSettings(seconds, fps)
    packs = open_packs(chosen.packs, format=chosen.format)
    scenes = loop(design, packs, chosen, timing.count, fps, on_moment)
    return draw_scenes(scenes, packs, chosen, loop=True)


def save_model(
    banner: "Banner | Garment | None",
    path: str | Path,
    settings: Settings | None = None,
    *,
    seconds: float = 4.0,
    fps: float = 20.0,
    origin: Literal["corner", "centre"] = "corner",
    progress: Callable[[int, int], object] | None = None,
    on_moment: Callable[[int, int], object] | None = None,
    **options: Unpack[Options],
) -> None:
    """Write a banner as a 3-D file: a GLB waves, the other formats hold one pose.

    banner: what to write, see `draw`; the ground is not written.
    path: the file; its ending selects the format.
    settings: the options of the model, see `draw`.
    seconds: length of the loop [s]; 0 for one pose.
    fps: [frames/s] of the loop.
    origin: of the file: the lowest corner of the block in which a banner stands, to the west
        and north, or the middle of the block's floor.
    progress: called with the number of finished frames and of all; it may raise to end the work,
        and then there is no file.
    on_moment: see `iter_frames`; it may raise as `progress` may.
    options: fields of `Settings` by name, which override those of `settings`.

    Raises DesignError if `banner` is something else, OptionError, PackError or OutputError.
    """
    from drapery.render.encode import check_target
    from drapery.render.export import save_scenes
    from drapery.stage.subjects import loop, still

    design, chosen = _checked(banner, settings, options, "model")
    one_of("origin", origin, tuple(ORIGINS))
    moves = check_target(path, "model").moving and seconds != 0
    if moves:
        chosen = settled_for(design, chosen, "loop")
    chosen = chosen.changed(ground="none")
    packs = open_packs(chosen.packs, format=chosen.format)
    if moves:
        tick, total = progress or (lambda done, total: None), LoopSettings(seconds, fps).count
        scenes = loop(design, packs, chosen, total, fps, on_moment)
        save_scenes(_counted(scenes, total, tick), path, fps=fps, origin=ORIGINS[origin])
    else:
        save_scenes(still(design, packs, chosen), path, origin=ORIGINS[origin])
    _warn_of(packs)


def draw_face(
    banner: Banner,
    *,
    packs: PackLike | Sequence[PackLike] = (),
    format: int | None = None,
    scale: int = 8,
    side: Literal["front", "back"] = "front",
    kind: Literal["auto", "banner", "shield"] = "auto",
) -> Frame:
    """The plain face of a banner, 20 x 40 texels, or of a shield, 12 x 22.

    banner: the design.
    packs: resource packs, see `open_packs`.
    format: pack format of the game's version, see `open_packs`.
    scale: the width of a texel of a 64 x 64 pack [pixels].
    side: of the cloth, or of the shield.
    kind: whose face; auto takes it from the design.

    Raises OptionError for a wrong argument, PackError for a pack that cannot be used.
    """
    check_format(format)
    opened = open_packs(packs, format=format)
    pixels = face_pixels(banner, opened, scale, side, banner.kind if kind == "auto" else kind)
    _warn_of(opened)
    return Frame(pixels)


def face_pixels(
    banner: Banner,
    packs: Packs,
    scale: int,
    side: Literal["front", "back"] = "front",
    kind: Literal["banner", "shield"] = "banner",
) -> Pixels:
    """The plain face of a banner, shape [40 scale, 20 scale, 4], for packs of any size.

    A shield's face has the shape [22 scale, 12 scale, 4]. Raises PackError.
    """
    from drapery.banner.sprites import (
        FLAG_REGIONS,
        SHIELD_REGIONS,
        composite,
        flag_layers,
        shield_layers,
    )

    if kind == "shield":
        return SHIELD_REGIONS[side].sample(composite(shield_layers(banner, packs)), scale)
    return FLAG_REGIONS[side].sample(composite(flag_layers(banner, packs)), scale)


def draw_scenes(
    scenes: Iterable[Scene], packs: Packs, settings: Settings, *, loop: bool = False
) -> Iterator[Frame]:
    """Draw scenes one by one with the backend, styles and size of pixels of the settings.

    loop: whether the scenes are the frames of a loop, which steps of styles may change together.
    After the first scene it warns of missing textures. Raises BackendError.
    """
    from drapery.render.backends import backend

    draw_scene = backend(settings.backend)
    frames: Iterable[Frame] = map(draw_scene, scenes)
    if settings.style:
        from drapery.styles import combined_style

        style = combined_style(settings.style)
        if loop:
            frames = style.draw_loop(scenes, draw_scene)
        else:
            frames = (style.draw(scene, draw_scene) for scene in scenes)
    return _drawn(frames, packs, settings)


def _drawn(frames: Iterable[Frame], packs: Packs, settings: Settings) -> Iterator[Frame]:
    for number, frame in enumerate(frames):
        yield frame if settings.pixel == 1 else enlarge(frame, settings.pixel)
        if number == 0:
            _warn_of(packs)


def _counted(
    scenes: Iterable[Scene], total: int, progress: Callable[[int, int], object]
) -> Iterator[Scene]:
    for number, scene in enumerate(scenes, 1):
        yield scene
        progress(number, total)


def _checked(
    banner: object, settings: object, options: Options, output: Output
) -> tuple["Banner | Garment | None", Settings]:
    if not (settings is None or isinstance(settings, Settings)):
        raise OptionError(f"settings {str(settings)[:40]!r} are not Settings; give options by name")
    chosen = (settings or Settings()).changed(**options)
    if banner is None or isinstance(banner, Banner):
        return banner, settled_for(banner, chosen, output)
    # Imported here: pictures of banners need no pydantic.
    from drapery.garments.model import Garment

    if not isinstance(banner, Garment):
        raise DesignError(
            f"{str(banner)[:40]!r} is not a Banner; read a text with Banner.parse(text)"
        )
    chosen = settled_for(banner, chosen, output)
    texture = chosen.texture_path
    return banner if texture is None else banner.with_texture(texture), chosen


def _warn_of(packs: Packs) -> None:
    for line in packs.warnings():
        warnings.warn(line, UserWarning, stacklevel=4)
