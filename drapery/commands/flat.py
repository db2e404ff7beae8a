"""`drapery flat`: the plain face of a banner or shield, as banner sites show it."""

from pathlib import Path
from typing import Annotated, Literal, cast, get_args

import typer

from drapery.commands import options as o

MAX_SCALE = 256
FaceKind = Literal["auto", "banner", "shield"]


def run(
    design: o.DesignArgument,
    out: Annotated[Path, typer.Option("-o", "--out", metavar="FILE", help="The picture to write.")],
    scale: Annotated[int, typer.Option(help="Pixels per texel of a 64 x 64 pack.")] = 8,
    form: o.FromOption = None,
    number: o.NumberOption = None,
    kind: Annotated[
        str,
        typer.Option(
            metavar="auto|banner|shield",
            help="Whose face: 20 x 40 or 12 x 22; auto takes it from the design.",
        ),
    ] = "auto",
    back: Annotated[bool, typer.Option("--back", help="Draw the back.")] = False,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
) -> None:
    """Write the plain face of a banner or shield, enlarged."""
    from drapery import draw_face
    from drapery.banner import read_design
    from drapery.errors import OptionError, shown
    from drapery.option import within
    from drapery.render.encode import check_target

    within("scale", scale, 1, MAX_SCALE, "pixels")
    check_target(out, "still")
    # A Literal as the type would import pydantic, a sixth of the time of a picture.
    if kind not in get_args(FaceKind):
        raise OptionError(f"kind {shown(kind)} is not known; use auto, banner or shield")
    side: Literal["front", "back"] = "back" if back else "front"
    banner = read_design(design, form=form, number=number)
    of = cast(FaceKind, kind)
    face = draw_face(banner, packs=packs or (), format=format, scale=scale, side=side, kind=of)
    face.save(out)
