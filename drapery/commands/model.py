"""`drapery model`: the cloth as a 3-D file, still or waving."""

from typing import Annotated

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, say

OutOption = Annotated[
    str,
    typer.Option(
        "-o",
        "--out",
        metavar="TARGET",
        help="out.glb (waves), or one pose as out.obj, out.ply, out.bbmodel or out.geo.json.",
    ),
]


def run(
    ctx: typer.Context,
    out: OutOption,
    design: o.OptionalDesign = None,
    form: o.FromOption = None,
    number: o.NumberOption = None,
    seconds: Annotated[float, typer.Option(help="Length of the loop; 0 for one pose.")] = 4.0,
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
    grid: o.GridOption = "5x9",
    wind: o.WindOption = 4.0,
    time: o.TimeOption = 3.0,
    seed: o.SeedOption = 0,
    thickness: o.ThicknessOption = 1.0,
) -> None:
    """Write a banner, shield, cape or elytra as a 3-D file: a waving GLB, or one pose."""
    from drapery.banner.packs import open_packs
    from drapery.pictures import frame_count
    from drapery.render.export import check_model_target, save_model
    from drapery.scenes.staging import loop, still
    from drapery.settings import Settings

    settings = Settings(**o.options_of(ctx.params | {"size": "512x512"}))
    moves = check_model_target(out) == ".glb" and seconds != 0
    packs = open_packs(settings.packs, format=settings.format)
    banner = o.design_of(ctx.params)
    with compile_notice():
        if moves:
            scenes = loop(banner, packs, settings, frame_count(seconds, fps), fps)
            save_model(scenes, out, fps=fps)
        else:
            save_model(still(banner, packs, settings), out)
    for line in packs.warnings():
        say(line)
