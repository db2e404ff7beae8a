"""`drapery garment`: a garment of a file as a picture, an animation or a 3-D file."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, drawing, progress
from drapery.option import Subject

if TYPE_CHECKING:
    from drapery.garments import Garment
    from drapery.settings import Settings


@o.pictured(subject=Subject("garment"))
def run(
    context: typer.Context,
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="NAME|FILE",
            help="A garment, or a file that ends with .toml.",
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        str | None,
        typer.Option(
            "-o",
            "--out",
            metavar="TARGET",
            help="A picture, animation, folder, 3-D file or .html page.",
        ),
    ] = None,
    show_list: Annotated[bool, typer.Option("--list", help="List all garments.")] = False,
    banner: Annotated[
        str | None,
        typer.Option(
            "--design", metavar="DESIGN", help="A banner for the pieces that show a design."
        ),
    ] = None,
    **words: Any,
) -> None:
    """Draw a garment: a cape, flag, tent or a file of your own.

    Options that are not given are those of the garment's file.
    """
    from drapery.errors import OptionError
    from drapery.garments import find_garment

    if show_list:
        _show_list()
        return
    if name is None:
        raise OptionError("no garment is given; `drapery garment --list` lists them all")
    garment = find_garment(name)
    if out is None:
        print(garment.description or garment.name)
        return
    if banner is not None:
        from drapery.banner import read_design

        garment = garment.with_design(read_design(banner))
    o.check_given(context, out)
    settings = garment.settings(**o.options_of(words))
    write_garment(garment, out, settings, o.loop_options_of(words))


def write_garment(
    garment: "Garment", out: str, settings: "Settings", timed: Mapping[str, Any]
) -> None:
    """Write a garment as what the ending says.

    timed: the options of a loop that are given, by name.
    Raises DraperyError.
    """
    from drapery import draw, iter_frames, save_model
    from drapery.render import save_animation
    from drapery.render.encode import check_target
    from drapery.settings import LoopSettings

    kind = check_target(out, "still", "loop", "model", "page").kind()
    if kind == "page":
        from drapery.web.page import write_page

        with compile_notice():
            write_page(Path(out), garment, settings)
    elif kind == "model":
        with compile_notice():
            save_model(garment, out, settings, **timed)
    elif kind == "still":
        with drawing():
            draw(garment, settings).save(out)
    else:
        timing = LoopSettings(**timed)
        with compile_notice():
            with progress("moving the cloth") as moved:
                frames = iter_frames(garment, settings, on_moment=moved, **timed)
            with progress("frames", timing.count) as tick:
                save_animation(frames, timing.fps, out, total=timing.count, progress=tick)


def _show_list() -> None:
    from drapery.garments import find_garment, garment_names

    names = garment_names()
    width = max(map(len, names))
    for name in names:
        print(f"{name:{width}}  {find_garment(name).description}".rstrip())
