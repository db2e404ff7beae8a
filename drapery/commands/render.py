"""`drapery render`: one picture."""

from pathlib import Path
from typing import Annotated

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice

OutOption = Annotated[
    Path, typer.Option("-o", "--out", metavar="FILE", help="The picture to write.")
]


def run(
    ctx: typer.Context,
    out: OutOption,
    design: o.OptionalDesign = None,
    form: o.FromOption = None,
    number: o.NumberOption = None,
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
    samples: o.SamplesOption = 1,
    pixel: o.PixelOption = 1,
    light: o.LightOption = "game",
    block_light: o.BlockLightOption = 0,
    sky_light: o.SkyLightOption = 15,
    daylight: o.DaylightOption = 1.0,
    shadow: o.ShadowOption = False,
    backend: o.BackendOption = "auto",
) -> None:
    """Draw a banner, shield, cape or elytra and write one picture."""
    from drapery.pictures import draw
    from drapery.render.encode import check_still_target

    options = o.options_of(ctx.params)
    check_still_target(out)
    with compile_notice():
        draw(o.design_of(ctx.params), **options).save(out)
