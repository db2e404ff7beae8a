"""`drapery garment`: a garment of a file as a picture, an animation or a 3-D file."""

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
    seconds: o.SecondsOption = 4.0,
    fps: o.FpsOption = 20.0,
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
    write_garment(garment, out, settings, seconds, fps)


def write_garment(
    garment: "Garment", out: str, settings: "Settings", seconds: float, fps: float
) -> None:
    """Write a garment as what the ending says. Raises DraperyError."""
    from drapery import draw, iter_frames, save_model
    from drapery.render import save_animation
    from drapery.render.encode import check_target
    from drapery.settings import frame_count

    kind = check_target(out, "still", "loop", "model", "page").kind()
    if kind == "page":
        from drapery.web.page import write_page

        with compile_notice():
            write_page(Path(out), garment, settings)
    elif kind == "model":
        with compile_notice():
            save_model(garment, out, settings, seconds=seconds, fps=fps)
    elif kind == "still":
        with drawing():
            draw(garment, settings).save(out)
    else:
        total = frame_count(seconds, fps)
        with compile_notice():
            with progress("moving the cloth") as moved:
                frames = iter_frames(garment, settings, seconds=seconds, fps=fps, on_moment=moved)
            with progress("frames", total) as tick:
                save_animation(frames, fps, out, total=total, progress=tick)


def _show_list() -> None:
    from drapery.garments import find_garment, garment_names

    names = garment_names()
    width = max(map(len, names))
    for name in names:
        print(f"{name:{width}}  {find_garment(name).description}".rstrip())
