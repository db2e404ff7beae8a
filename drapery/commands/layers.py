"""`drapery layers`: the layers of a banner, and how to make it at the loom."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice

if TYPE_CHECKING:
    from drapery import Banner
    from drapery.packs import Packs


def run(
    design: o.DesignArgument,
    out: Annotated[
        Path | None,
        typer.Option("-o", "--out", metavar="FILE", help="The layers drawn apart, as a picture."),
    ] = None,
    steps: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="The strip of the loom's steps, as a picture."),
    ] = None,
    form: o.FromOption = None,
    number: o.NumberOption = None,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
    view: o.ViewOption = "iso",
    size: o.SizeOption = "768x512",
    background: o.BackgroundOption = "transparent",
    backend: o.BackendOption = "auto",
) -> None:
    """Show the layers of a banner: loom steps, hidden layers, and an exploded view."""
    from drapery.banner import read_design
    from drapery.packs import open_packs
    from drapery.pictures import draw_scenes
    from drapery.scenes import exploded_view
    from drapery.settings import OPTIONS, Settings
    from drapery.sheets import check_sheet_target, steps_sheet

    settings = Settings(
        packs=tuple(packs or ()),
        format=format,
        view=view,
        size=OPTIONS["size"].parse(size),
        background=background,
        backend=backend,
    )
    if steps is not None:
        check_sheet_target(steps)
    banner = read_design(design, form=form, number=number)
    opened = open_packs(settings.packs, format=format)
    _print_steps(banner)
    _print_hidden(banner, opened)
    with compile_notice():
        if out is not None:
            (frame,) = draw_scenes([exploded_view(banner, opened, settings)], opened, settings)
            frame.save(out)
        if steps is not None:
            steps_sheet(banner, opened).save(steps)


def _print_steps(banner: "Banner") -> None:
    from drapery.banner import fits_loom, loom_steps

    print(f"start with a {banner.base.replace('_', ' ')} banner")
    for number, step in enumerate(loom_steps(banner), 1):
        item = f" and a {step.item}" if step.item else ""
        dye = step.layer.dye.replace("_", " ")
        print(f"{number:2}. {step.layer.pattern} with {dye} dye{item}")
    if not fits_loom(banner):
        print("a loom makes six layers at most; make this design with a command")


def _print_hidden(banner: "Banner", packs: "Packs") -> None:
    from drapery.banner import simplify, write_banner

    fewer = simplify(banner, packs)
    if fewer != banner:
        spared = len(banner.layers) - len(fewer.layers)
        print(f"the same picture with {spared} fewer: {write_banner(fewer, 'text')}")
