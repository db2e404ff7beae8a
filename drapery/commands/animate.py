"""`drapery animate`: a banner waving in the wind, as a seamless loop."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, progress, say
from drapery.errors import OptionError
from drapery.file_formats import DESTINATIONS, endings_of

if TYPE_CHECKING:
    from drapery import Banner
    from drapery.settings import Settings

OutOption = Annotated[
    str,
    typer.Option(
        "-o",
        "--out",
        metavar="TARGET",
        help=f"The animation: {', '.join(endings_of('loop')[:-1])}, or a folder of frames.",
    ),
]


ForOption = Annotated[
    str | None,
    typer.Option(
        "--for",
        metavar="DESTINATION",
        help="Where it is posted: size, frames/s and quality are chosen so that it fits, unless"
        f" they are given. One of: {', '.join(DESTINATIONS)}.",
    ),
]


@o.pictured("loop")
def run(
    out: OutOption,
    to: ForOption = None,
    matte: Annotated[
        str | None,
        typer.Option(metavar="#RRGGBB", help="Behind half-transparent pixels of a GIF or video."),
    ] = None,
    quality: o.QualityOption = None,
    **words: Any,
) -> None:
    """Draw a banner waving in the wind, as a seamless loop."""
    from drapery import iter_frames
    from drapery.render import save_animation
    from drapery.render.encode import check_quality, check_target
    from drapery.settings import LoopSettings, background_colour

    settings, timed = o.settings_of(words), o.loop_options_of(words)
    behind = None if matte is None else background_colour(matte)[:3]
    check_quality(check_target(out, "loop"), quality)
    if to is not None:
        if matte is not None:
            raise OptionError("matte does nothing with --for; leave one of them out")
        _save_for(to, o.design_of(words), settings, out, timed, quality)
        return
    timing = LoopSettings(**timed)
    fps, total = timing.fps, timing.count
    with compile_notice():
        design = o.design_of(words)
        with progress("moving the cloth") as moved:
            drawn = iter_frames(design, settings, on_moment=moved, **timed)
        with progress("frames", total) as tick:
            save_animation(
                drawn, fps, out, matte=behind, quality=quality, total=total, progress=tick
            )


def _save_for(
    to: str,
    design: "Banner | None",
    settings: "Settings",
    out: str,
    timed: Mapping[str, Any],
    quality: int | None,
) -> None:
    """Write the best loop that a to takes, and say what was chosen.

    timed: the options of a loop that are given, by name.
    """
    from drapery import iter_frames
    from drapery.render import save_for
    from drapery.settings import LoopSettings

    size = settings.size if "size" in settings.given else None
    with compile_notice():
        fitted = save_for(
            to,
            lambda wide, rate: iter_frames(
                design, settings.changed(size=wide), **{**timed, "fps": rate}
            ),
            out,
            seconds=LoopSettings(**timed).length,
            size=size,
            shape=settings.size,
            fps=timed.get("fps"),
            quality=quality,
        )
    (width, height), quality = fitted.size, fitted.quality
    how = "" if quality is None else f" quality {quality},"
    say(
        f"for {to}: {width}x{height} pixels, {fitted.fps:g} frames/s,{how}"
        f" {fitted.length / 1000:.0f} kB"
    )
