"""`drapery model`: the cloth as a 3-D file, still or waving."""

from typing import Annotated, Any

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
FLAT = (
    *("size", "layers", "pbr", "background", "samples", "pixel", "backend"),
    *("light", "block_light", "sky_light", "daylight", "shadow"),
)
"""Options of pictures that a model has no use for."""


@o.pictured(*FLAT)
def run(
    out: OutOption,
    seconds: Annotated[float, typer.Option(help="Length of the loop; 0 for one pose.")] = 4.0,
    fps: o.FpsOption = 20.0,
    **words: Any,
) -> None:
    """Write a banner, shield, cape or elytra as a 3-D file: a waving GLB, or one pose."""
    from drapery.banner.packs import open_packs
    from drapery.render.export import check_model_target, save_model
    from drapery.scenes.stager import loop, still
    from drapery.settings import Settings, frame_count

    settings = Settings(**o.options_of(words))
    moves = check_model_target(out) == ".glb" and seconds != 0
    packs = open_packs(settings.packs, format=settings.format)
    banner = o.design_of(words)
    with compile_notice():
        if moves:
            scenes = loop(banner, packs, settings, frame_count(seconds, fps), fps)
            save_model(scenes, out, fps=fps)
        else:
            save_model(still(banner, packs, settings), out)
    for line in packs.warnings():
        say(line)
