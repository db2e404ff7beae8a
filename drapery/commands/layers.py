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
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the loom's steps and the materials as JSON.")
    ] = False,
    form: o.FromOption = None,
    number: o.NumberOption = None,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
    view: o.ViewOption = "iso",
    size: o.SizeOption = "768x512",
    background: o.BackgroundOption = "transparent",
    backend: o.BackendOption = "auto",
) -> None:
    """Show the layers of a banner: loom steps, materials, hidden layers, an exploded view."""
    from drapery.banner import read_design
    from drapery.packs import open_packs
    from drapery.pictures import draw_scenes
    from drapery.render.encode import check_target
    from drapery.scenes import exploded_view
    from drapery.settings import OPTIONS, Settings
    from drapery.sheets import steps_sheet

    settings = Settings(
        packs=tuple(packs or ()),
        format=format,
        view=view,
        size=OPTIONS["size"].parse(size),
        background=background,
        backend=backend,
    )
    if out is not None:
        check_target(out, "still")
    if steps is not None:
        check_target(steps, "still", "page")
    banner = read_design(design, form=form, number=number)
    opened = open_packs(settings.packs, format=format)
    if as_json:
        print(_json(banner))
    else:
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
        item = f" and a {step.item.replace('_', ' ')}" if step.item else ""
        dye = step.layer.dye.replace("_", " ")
        print(f"{number:2}. {step.layer.pattern} with {dye} dye{item}")
    if not fits_loom(banner):
        print("a loom makes six layers at most; make this design with a command")

    _print_items(banner)


def _print_items(banner: "Banner") -> None:
    from drapery.banner import crafting_items

    items = crafting_items(banner)
    used = [f"{one.count} {one.item.replace('_', ' ')}" for one in items if one.consumed]
    kept = [one.item.replace("_", " ") for one in items if not one.consumed]
    print(f"takes {', '.join(used)}")
    if kept:
        print(f"needs, but keeps, {', '.join(kept)}")


def _json(banner: "Banner") -> str:
    import json
    from dataclasses import asdict

    from drapery.banner import LOOM_LAYERS, crafting_items, fits_loom, loom_steps

    steps = [
        {"pattern": s.layer.pattern, "dye": s.layer.dye, "item": s.item} for s in loom_steps(banner)
    ]
    facts = {
        "base": banner.base,
        "kind": banner.kind,
        "steps": steps,
        "survival": fits_loom(banner),
        "most_layers": LOOM_LAYERS,
        "materials": [asdict(one) for one in crafting_items(banner)],
    }
    return json.dumps(facts, indent=2)


def _print_hidden(banner: "Banner", packs: "Packs") -> None:
    from drapery.banner import simplify, write_banner

    fewer = simplify(banner, packs)
    if fewer != banner:
        spared = len(banner.layers) - len(fewer.layers)
        print(f"the same picture with {spared} fewer: {write_banner(fewer, 'shorthand')}")
