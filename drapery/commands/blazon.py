"""`drapery blazon`: from the words of English heraldry to a banner."""

from pathlib import Path
from typing import Annotated

import typer

from drapery.commands import options as o


def run(
    text: Annotated[
        str, typer.Argument(metavar="BLAZON", help="Such as 'Azure, a bend Or'; - reads input.")
    ],
    written: Annotated[
        str,
        typer.Option("--as", metavar="FORM", help="The form to print: shorthand, give, json, ..."),
    ] = "shorthand",
    out: Annotated[
        Path | None,
        typer.Option("-o", "--out", metavar="FILE", help="Draw the flat face, as a picture."),
    ] = None,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
) -> None:
    """Read a blazon such as 'Azure, a bend Or'; 'drapery show DESIGN --as blazon' writes one."""
    from drapery import draw_face
    from drapery.banner import read_design, write_banner
    from drapery.render.encode import check_target

    if out is not None:
        check_target(out, "still")
    banner = read_design(text, form="blazon")
    print(write_banner(banner, written))
    if out is not None:
        draw_face(banner, packs=packs or (), format=format).save(out)
