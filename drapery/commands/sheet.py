"""`drapery sheet`: many labelled pictures on one sheet."""

from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, progress, say

app = typer.Typer(
    help="Write a sheet of many labelled pictures, as a picture or a page.", no_args_is_help=True
)

SheetOption = Annotated[
    Path,
    typer.Option(
        "-o", "--out", metavar="FILE", help="The sheet: a picture, or an .html page in one file."
    ),
]
MAX_SCALE = 32
MAX_MOMENTS = 8
STYLED = "white creeper:lime border:black"
"""The design of a sheet of styles, unless one is given."""


@app.command("patterns")
def write_patterns(
    out: SheetOption,
    base: Annotated[str, typer.Option(help="Dye of the cloth.")] = "white",
    dyes: Annotated[
        str, typer.Option(help="Dyes of the patterns: all, or a list with commas.")
    ] = "all",
    back: Annotated[bool, typer.Option("--back", help="Draw the backs.")] = False,
    scale: Annotated[int, typer.Option(help="Pixels per texel of a 64 x 64 pack.")] = 3,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
) -> None:
    """All patterns in all dyes."""
    from drapery.banner import dye_name
    from drapery.packs import open_packs
    from drapery.render.encode import check_target
    from drapery.settings import check_format
    from drapery.sheets import patterns_sheet

    _check_scale(scale)
    check_target(out, "still", "page")
    check_format(format)
    opened = open_packs(tuple(packs or ()), format=format)
    side: Literal["front", "back"] = "back" if back else "front"
    sheet = patterns_sheet(opened, dye_name(base), _dyes(dyes), side=side, scale=scale)
    for line in opened.warnings():
        say(line)
    sheet.save(out)


@app.command("rotations")
@o.pictured("still", without=("placement", "rotation", "facing"))
def write_rotations(
    out: SheetOption,
    view: o.ViewOption = "hero",
    size: Annotated[str, typer.Option(help="Size of each picture in pixels.")] = "144x192",
    **words: Any,
) -> None:
    """One design in all sixteen rotations."""
    from drapery.render.encode import check_target
    from drapery.sheets import rotations_sheet

    settings = o.settings_of(words | {"view": view, "size": size})
    check_target(out, "still", "page")
    with compile_notice():
        rotations_sheet(o.design_of(words), settings).save(out)


@app.command("sprites")
@o.pictured("loop", without=("placement", "rotation", "facing", "turntable"))
def write_sprites(
    out: Annotated[
        Path,
        typer.Option(
            "-o", "--out", metavar="NAME.sheet.png", help="The sheet; NAME.sheet.json is beside it."
        ),
    ],
    directions: Annotated[
        int, typer.Option(help="1, 2, 4, 8 or 16; each is a row, south first, then clockwise.")
    ] = 8,
    seconds: o.SecondsOption = 1.0,
    fps: o.FpsOption = 8.0,
    size: Annotated[
        str, typer.Option(help="Size of each picture in pixels, before large pixels become one.")
    ] = "128x128",
    **words: Any,
) -> None:
    """One design as a game's sprites: a loop from each direction."""
    from drapery.render import save_sprites
    from drapery.render.encode import check_sheet
    from drapery.sheets import draw_sprites

    settings = o.settings_of(words | {"size": size})
    timed = o.loop_options_of({"seconds": seconds, "fps": fps, **words})
    check_sheet(out)
    with compile_notice():
        design = o.design_of(words)
        with progress("directions", directions) as tick:
            loops = draw_sprites(
                design, settings, directions=directions, on_direction=tick, **timed
            )
    save_sprites(loops, fps, out)


@app.command("packs")
def write_packs(
    design: o.DesignArgument,
    packs: Annotated[
        list[Path],
        typer.Argument(
            metavar="PATH...", help="Resource packs, each shown alone.", show_default=False
        ),
    ],
    out: SheetOption,
    form: o.FromOption = None,
    number: o.NumberOption = None,
    format: o.FormatOption = None,
    flat: Annotated[bool, typer.Option("--flat", help="Plain faces instead of cloth.")] = False,
    scale: Annotated[int, typer.Option(help="Pixels per texel of a plain face.")] = 8,
    view: o.ViewOption = "hero",
    size: Annotated[str, typer.Option(help="Size of each picture in pixels.")] = "256x320",
    wind: o.WindOption = 4.0,
    background: o.BackgroundOption = "transparent",
    backend: o.BackendOption = "auto",
) -> None:
    """One design with our own art and with each of many packs."""
    from drapery.banner import read_design
    from drapery.render.encode import check_target
    from drapery.settings import OPTIONS, Settings
    from drapery.sheets import packs_sheet

    _check_scale(scale)
    check_target(out, "still", "page")
    settings = Settings(
        format=format,
        view=view,
        size=OPTIONS["size"].parse(size),
        wind=wind,
        background=background,
        backend=backend,
    )
    with compile_notice():
        faces = scale if flat else None
        banner = read_design(design, form=form, number=number)
        packs_sheet(banner, packs, settings, scale=faces).save(out)


@app.command("styles")
@o.pictured("still", without=("design",))
def write_styles(
    out: SheetOption,
    designs: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[DESIGN]...", help="Designs; several have a column each.", show_default=STYLED
        ),
    ] = None,
    moments: Annotated[
        int, typer.Option(help="Pictures of each style, at moments that follow each other.")
    ] = 1,
    view: o.ViewOption = "hero",
    size: Annotated[
        list[str] | None,
        typer.Option(
            metavar="WxH",
            help="Size of each picture in pixels; several are drawn.",
            show_default="192x240",
        ),
    ] = None,
    **words: Any,
) -> None:
    """Designs in every style, or in those of --style, at one size or several."""
    from drapery.banner import read_design
    from drapery.option import within
    from drapery.render.encode import check_target
    from drapery.settings import OPTIONS
    from drapery.sheets import styles_sheet

    within("moments", moments, 1, MAX_MOMENTS)
    settings = o.settings_of(words | {"view": view})
    sizes = [OPTIONS["size"].parse(each) for each in size or ("192x240",)]
    check_target(out, "still", "page")
    with compile_notice():
        given = [
            read_design(text, form=words["form"], number=words["number"])
            for text in designs or (STYLED,)
        ]
        styles_sheet(given, settings, moments=moments, sizes=sizes).save(out)


@app.command("garments")
def write_garments(
    out: SheetOption,
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME|FILE]...", help="Some garments only.", show_default="all"),
    ] = None,
    size: Annotated[str, typer.Option(help="Size of each picture in pixels.")] = "192x240",
    packs: o.PackOption = None,
    backend: o.BackendOption = "auto",
) -> None:
    """Garments at four moments each, in their own view and wind."""
    from drapery.render.encode import check_target
    from drapery.settings import OPTIONS, Settings
    from drapery.sheets import garments_sheet

    pixels = OPTIONS["size"].parse(size)
    settings = Settings(size=pixels, packs=tuple(packs or ()), backend=backend)
    check_target(out, "still", "page")
    with compile_notice():
        garments_sheet(settings, names or ()).save(out)


@app.command("players")
def write_players(
    out: SheetOption,
    skin: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FILE|NAME", help="A skin; several are drawn.", show_default="our own"
        ),
    ] = None,
    wear: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME|FILE", help="A garment; several are worn.", show_default="cape"),
    ] = None,
    size: Annotated[str, typer.Option(help="Size of each picture in pixels.")] = "144x192",
    packs: o.PackOption = None,
    backend: o.BackendOption = "auto",
) -> None:
    """Players in all motions, from three sides."""
    from drapery.render.encode import check_target
    from drapery.settings import OPTIONS, Settings
    from drapery.sheets import players_sheet

    pixels = OPTIONS["size"].parse(size)
    settings = Settings(size=pixels, packs=tuple(packs or ()), backend=backend)
    check_target(out, "still", "page")
    skins = [_absolute(each) for each in skin or ()]
    with compile_notice():
        players_sheet(settings, skins, wear=wear or ("cape",)).save(out)


def _absolute(skin: str) -> str:
    from drapery.garments import is_profile_file

    is_file = skin.lower().endswith(".png") or is_profile_file(skin)
    return str(Path(skin).absolute()) if is_file else skin


def _check_scale(scale: int) -> None:
    from drapery.option import within

    within("scale", scale, 1, MAX_SCALE, "pixels")


def _dyes(text: str) -> tuple[str, ...]:
    """Dyes from a list with commas, or all. Raises DesignError."""
    from drapery.banner import DYE_NAMES, dye_name

    if text == "all":
        return DYE_NAMES
    return tuple(dict.fromkeys(dye_name(name.strip()) for name in text.split(",")))
