"""`drapery animate`: a banner waving in the wind, as a seamless loop."""

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
    ctx: typer.Context,
    out: OutOption,
    to: ForOption = None,
    seconds: o.SecondsOption = 4.0,
    fps: o.FpsOption = 20.0,
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
    from drapery.settings import background_colour, frame_count

    settings = o.settings_of(words)
    behind = None if matte is None else background_colour(matte)[:3]
    check_quality(check_target(out, "loop"), quality)
    if to is not None:
        if matte is not None:
            raise OptionError("matte does nothing with --for; leave one of them out")
        rate = fps if o.is_given(ctx, "fps") else None
        _save_for(to, o.design_of(words), settings, out, seconds, rate, quality)
        return
    with compile_notice():
        design = o.design_of(words)
        with progress("moving the cloth") as moved:
            drawn = iter_frames(design, settings, seconds=seconds, fps=fps, on_moment=moved)
        total = frame_count(seconds, fps)
        with progress("frames", total) as tick:
            save_animation(
                drawn, fps, out, matte=behind, quality=quality, total=total, progress=tick
            )


def _save_for(
    to: str,
    design: "Banner | None",
    settings: "Settings",
    out: str,
    seconds: float,
    fps: float | None,
    quality: int | None,
) -> None:
    """Write the best loop that a to takes, and say what was chosen."""
    from drapery import iter_frames
    from drapery.render import save_for

    size = settings.size if "size" in settings.given else None
    with compile_notice():
        fitted = save_for(
            to,
            lambda wide, rate: iter_frames(
                design, settings.changed(size=wide), seconds=seconds, fps=rate
            ),
            out,
            seconds=seconds,
            size=size,
            shape=settings.size,
            fps=fps,
            quality=quality,
        )
    (width, height), quality = fitted.size, fitted.quality
    how = "" if quality is None else f" quality {quality},"
    say(
        f"for {to}: {width}x{height} pixels, {fitted.fps:g} frames/s,{how}"
        f" {fitted.length / 1000:.0f} kB"
    )
