"""`drapery animate`: a banner waving in the wind, as a seamless loop."""

from typing import Annotated

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, progress

OutOption = Annotated[
    str,
    typer.Option(
        "-o",
        "--out",
        metavar="TARGET",
        help="out.gif, out.apng, out.webp, out.mp4, or a folder for numbered frames.",
    ),
]


def run(
    ctx: typer.Context,
    out: OutOption,
    design: o.OptionalDesign = None,
    form: o.FromOption = None,
    number: o.NumberOption = None,
    seconds: Annotated[float, typer.Option(help="Length of the loop.")] = 4.0,
    fps: Annotated[float, typer.Option(help="Frames per second.")] = 20.0,
    pack: o.PackOption = None,
    format: o.FormatOption = None,
    kind: o.KindOption = "auto",
    texture: o.TextureOption = None,
    pose: o.PoseOption = "cloth",
    placement: o.PlacementOption = "standing",
    rotation: o.RotationOption = 0,
    facing: o.FacingOption = None,
    view: o.ViewOption = "front",
    size: o.SizeOption = "512x512",
    grid: o.GridOption = "5x9",
    solver: o.SolverOption = "desbrun",
    wind: o.WindOption = 4.0,
    time: o.TimeOption = 3.0,
    seed: o.SeedOption = 0,
    layers: o.LayersOption = "stacked",
    pbr: o.PbrOption = False,
    thickness: o.ThicknessOption = 1.0,
    background: o.BackgroundOption = "transparent",
    matte: Annotated[
        str | None,
        typer.Option(metavar="#RRGGBB", help="Behind half-transparent pixels of a GIF or video."),
    ] = None,
    samples: o.SamplesOption = 1,
    pixel: o.PixelOption = 1,
    light: o.LightOption = "game",
    block_light: o.BlockLightOption = 0,
    sky_light: o.SkyLightOption = 15,
    daylight: o.DaylightOption = 1.0,
    shadow: o.ShadowOption = False,
    backend: o.BackendOption = "auto",
) -> None:
    """Draw a banner waving in the wind, as a seamless loop."""
    from drapery.pictures import frame_count, frames
    from drapery.render.encode import check_animation_target, save_animation
    from drapery.settings import Settings, background_colour

    settings = Settings(**o.options_of(ctx.params))
    behind = None if matte is None else background_colour(matte)[:3]
    check_animation_target(out)
    with compile_notice():
        drawn = frames(o.design_of(ctx.params), seconds, fps, settings)
        total = frame_count(seconds, fps)
        with progress("frames", total) as tick:
            save_animation(drawn, fps, out, matte=behind, total=total, progress=tick)
