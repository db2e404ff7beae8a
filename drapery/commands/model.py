"""`drapery model`: the cloth as a 3-D file, still or waving."""

from typing import Annotated, Any, Literal

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice
from drapery.file_formats import endings_of

OutOption = Annotated[
    str,
    typer.Option(
        "-o",
        "--out",
        metavar="TARGET",
        help=f"The 3-D file: {', '.join(endings_of('model'))}; only GLB waves.",
    ),
]
OriginOption = Annotated[
    Literal["corner", "centre"],
    typer.Option(help="The file's origin: a corner of the block, or the middle of its floor."),
]


@o.pictured("model")
def run(
    context: typer.Context,
    out: OutOption,
    seconds: Annotated[float, typer.Option(help="Length of the loop; 0 for one pose.")] = 4.0,
    origin: OriginOption = "corner",
    **words: Any,
) -> None:
    """Write a banner, shield, cape or elytra as a 3-D file: a waving GLB, or one pose."""
    from drapery import save_model
    from drapery.errors import OptionError

    o.check_given(context, out)
    if not seconds and o.is_given(context, "fps"):
        raise OptionError(f"{out}: fps does nothing for one pose; leave it out, or seconds 0")
    settings, timed = o.settings_of(words), o.loop_options_of(words)
    with compile_notice():
        save_model(o.design_of(words), out, settings, seconds=seconds, origin=origin, **timed)
