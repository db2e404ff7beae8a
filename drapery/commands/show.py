"""`drapery show`: the layers of a banner, or the same banner in another form."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from drapery.commands import options as o

if TYPE_CHECKING:
    from drapery import Banner, FoundBanner


def run(
    design: o.DesignArgument,
    written: Annotated[
        str | None,
        typer.Option(
            "--as", metavar="FORM", help="Write it as json, give, give-legacy, shorthand, ..."
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--out",
            metavar="FILE",
            help="The file to write, as .nbt, .schem, .litematic, ...",
        ),
    ] = None,
    show_list: Annotated[
        bool, typer.Option("--list", help="List all banners, one on each line, with their numbers.")
    ] = False,
    form: o.FromOption = None,
    number: o.NumberOption = None,
) -> None:
    """Show one banner or many, layer by layer, or write them in another form."""
    from drapery.banner import choose_banner, read_designs, write_banner

    found = read_designs(design, form=form)
    if show_list:
        for count, one in enumerate(found, 1):
            print(f"{count}\t{one.where}\t{write_banner(one.banner, 'shorthand')}")
        return
    if out is not None:
        _write(choose_banner(found, number), out, written)
        return
    banners = (
        [choose_banner(found, number)] if number is not None else [one.banner for one in found]
    )
    if written is not None:
        for one in found if number is None else found[number - 1 : number]:
            _write_text(one, written)
        return
    for place, banner in zip((one.where for one in found), banners, strict=False):
        if len(banners) > 1:
            print(place)
        _explain(banner)


def _write_text(found: "FoundBanner", form: str) -> None:
    """The banner in a form of text, with what its item says beside the design if that is kept."""
    import warnings

    from drapery.banner import GIVE_FORMS, not_kept, write_banner, write_give

    if found.details is None:
        print(write_banner(found.banner, form))
        return
    if lost := not_kept(found.details, form):
        warnings.warn(lost, stacklevel=2)
    keeps = form in GIVE_FORMS
    print(
        write_give(found.banner, form, found.details) if keeps else write_banner(found.banner, form)
    )


def _write(banner: "Banner", out: Path, form: str | None) -> None:
    """The banner as a file: of a form of bytes by its name or the file's ending, or of text."""
    from drapery.banner import binary_forms, write_banner
    from drapery.errors import DesignError
    from drapery.output_files import replacing

    ending, kinds = out.suffix.lower(), binary_forms().values()
    fits = (kind for kind in kinds if (kind.name == form if form else ending in kind.suffixes))
    kind = min(fits, key=lambda kind: kind.write is None, default=None)
    if kind is None:
        data = (write_banner(banner, form or "json") + "\n").encode()
    elif kind.write is None:
        names = ", ".join(kind.name for kind in kinds if kind.write)
        raise DesignError(
            f"the form {kind.name!r} can be read but not written; use one of: {names}"
        )
    else:
        data = kind.write(banner)
    with replacing(out) as path:
        path.write_bytes(data)


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
    from drapery.banner import DYES

    red, green, blue = DYES[dye].rgb
    return f"[on rgb({red},{green},{blue})]    [/] {dye}"


def _title(pattern: str) -> str:
    from drapery.banner import PATTERNS

    known = PATTERNS.get(pattern)
    return known.title if known else "pattern of a data pack"
