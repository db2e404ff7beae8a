"""`drapery icon`: items as in the slots of the inventory."""

from pathlib import Path
from typing import Annotated

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice

SLOT = 16
"""The side of a slot at scale 1 [px]."""
MAX_SCALE = 64


def run(
    designs: Annotated[
        list[str],
        typer.Argument(
            metavar="DESIGN...", help="Banners or shields, each as for render.", show_default=False
        ),
    ],
    out: Annotated[
        Path,
        typer.Option(
            "-o",
            "--out",
            metavar="TARGET",
            help="The picture; a folder of icon_00.png and so on for several designs.",
        ),
    ],
    scale: Annotated[
        int, typer.Option(metavar="N", help=f"Pixels per pixel of a slot of {SLOT} x {SLOT}.")
    ] = 2,
    form: o.FromOption = None,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
) -> None:
    """Write banners and shields as items in the inventory, at a scale of the game's interface."""
    from drapery import draw
    from drapery.banner import read_design
    from drapery.errors import OptionError, counted
    from drapery.option import within
    from drapery.output_files import make_folder
    from drapery.render.encode import check_target
    from drapery.settings import Settings

    within("scale", scale, 1, MAX_SCALE)
    found = [read_design(design, form=form) for design in designs]
    targets = [out]
    if len(designs) > 1:
        if out.suffix:
            count = counted(len(designs), "design")
            raise OptionError(f"{out}: {count} go into a folder; name one")
        targets = [out / f"icon_{number:02d}.png" for number in range(len(designs))]
        make_folder(out)
    settings = Settings().changed(
        placement="item",
        size=(SLOT * scale, SLOT * scale),
        samples=1,
        packs=tuple(packs or ()),
        format=format,
    )
    for target in targets:
        check_target(target, "still")
    with compile_notice():
        for target, banner in zip(targets, found, strict=True):
            draw(banner, settings).save(target)
