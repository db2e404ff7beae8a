"""`drapery letters`: a word as a row of banners."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, say

if TYPE_CHECKING:
    from drapery import Banner


def run(
    text: Annotated[
        str, typer.Argument(metavar="TEXT", help="Letters, digits and punctuation: 'HELLO 42'.")
    ],
    ink: Annotated[str, typer.Option(metavar="DYE", help="The dye of the letters.")] = "black",
    ground: Annotated[str, typer.Option(metavar="DYE", help="The dye around them.")] = "white",
    border: Annotated[
        str | None,
        typer.Option(
            metavar="DYE|none",
            help="The dye of the border; none for letters that reach the edges.",
            show_default="the ground's",
        ),
    ] = None,
    written: Annotated[
        str | None,
        typer.Option(
            "--as",
            metavar="FORM",
            help="The form to print: shorthand, give, json, ...",
            show_default="text, or nothing with -o",
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--out",
            metavar="FILE",
            help="The row as a picture, or as .schem, .litematic, .nbt or .mcstructure.",
        ),
    ] = None,
    cloth: Annotated[bool, typer.Option("--cloth", help="Draw cloth, not plain faces.")] = False,
    scale: Annotated[int, typer.Option(help="Pixels per texel of the plain faces.")] = 8,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
    view: o.ViewOption = "front",
    size: o.SizeOption = "192x320",
    wind: o.WindOption = 1.5,
    background: o.BackgroundOption = "transparent",
    backend: o.BackendOption = "auto",
) -> None:
    """Write a word in banners, one for each letter, each of six layers at most."""
    from drapery.banner import letter_banners, write_banner
    from drapery.commands.flat import MAX_SCALE
    from drapery.option import within
    from drapery.packs import open_packs
    from drapery.settings import OPTIONS, Settings
    from drapery.sheets import cloth_row, faces_row

    within("scale", scale, 1, MAX_SCALE, "pixels")
    banners = letter_banners(text, ink=ink, ground=ground, border=border)
    chosen = Settings(
        packs=tuple(packs or ()),
        format=format,
        view=view,
        size=OPTIONS["size"].parse(size),
        wind=wind,
        background=background,
        backend=backend,
    )
    if out is None or written is not None:
        print("\n".join(write_banner(banner, written or "shorthand") for banner in banners))
    if out is not None and not _wrote_blocks(banners, out):
        if cloth:
            with compile_notice():
                cloth_row(banners, chosen).save(out)
        else:
            opened = open_packs(chosen.packs, format=format)
            faces_row(banners, opened, scale=scale).save(out)
            for line in opened.warnings():
                say(line)


def _wrote_blocks(banners: "tuple[Banner, ...]", out: Path) -> bool:
    """Whether the file is one of blocks, and then was written: standing banners in a row."""
    from drapery.banner import write_blocks
    from drapery.output_files import replacing

    data = write_blocks(banners, out.suffix)
    if data is None:
        return False
    with replacing(out) as path:
        path.write_bytes(data)
    return True
