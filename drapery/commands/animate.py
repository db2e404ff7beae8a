"""`drapery animate`: a banner waving in the wind, as a seamless loop."""

from typing import Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, progress
from drapery.file_formats import endings_of

OutOption = Annotated[
    str,
    typer.Option(
        "-o",
        "--out",
        metavar="TARGET",
        help=f"The animation: {', '.join(endings_of('loop')[:-1])}, or a folder of frames.",
    ),
]


@o.pictured("loop")
def run(
    out: OutOption,
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
    from drapery.render import check_quality, check_target, save_animation
    from drapery.settings import background_colour, frame_count

    settings = o.settings_of(words)
    behind = None if matte is None else background_colour(matte)[:3]
    check_quality(check_target(out, "loop"), quality)
    with compile_notice():
        design = o.design_of(words)
        with progress("moving the cloth") as moved:
            drawn = iter_frames(design, settings, seconds=seconds, fps=fps, on_moment=moved)
        total = frame_count(seconds, fps)
        with progress("frames", total) as tick:
            save_animation(
                drawn, fps, out, matte=behind, quality=quality, total=total, progress=tick
            )
