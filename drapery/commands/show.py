"""`drapery show`: what was understood, layer by layer, or the same banner in another form."""

from typing import TYPE_CHECKING, Annotated

import typer

from drapery.commands import options as o

if TYPE_CHECKING:
    from drapery.banner.design import Banner


def run(
    design: o.DesignArgument,
    form: Annotated[
        str | None,
        typer.Option("--as", metavar="FORM", help="Write it as: json, give, give-legacy, text."),
    ] = None,
) -> None:
    """Say what was understood of a banner, or convert it to another form."""
    from drapery.banner.formats import read_design, write_banner

    banner = read_design(design)
    if form is None:
        _explain(banner)
    else:
        print(write_banner(banner, form))


def _explain(banner: "Banner") -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for heading in ("layer", "dye", "pattern", "name"):
        table.add_column(heading)
    table.add_row("base", _swatch(banner.base), "", "")
    for number, layer in enumerate(banner.layers, 1):
        table.add_row(str(number), _swatch(layer.dye), layer.pattern, _title(layer.pattern))
    Console().print(table)


def _swatch(dye: str) -> str:
    from drapery.banner.dyes import DYES

    red, green, blue = DYES[dye].rgb
    return f"[on rgb({red},{green},{blue})]    [/] {dye}"


def _title(pattern: str) -> str:
    from drapery.banner.patterns import PATTERNS

    known = PATTERNS.get(pattern)
    return known.title if known else "pattern of a data pack"
