"""`drapery render`: one picture."""

from pathlib import Path
from typing import Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.notices import drawing

OutOption = Annotated[
    Path, typer.Option("-o", "--out", metavar="FILE", help="The picture to write.")
]


@o.pictured("still")
def run(
    out: OutOption,
    quality: o.QualityOption = None,
    **words: Any,
) -> None:
    """Draw a banner, shield, cape or elytra and write one picture."""
    from drapery import draw
    from drapery.render.encode import check_quality, check_target

    options = o.options_of(words)
    check_quality(check_target(out, "still"), quality)
    with drawing():
        draw(o.design_of(words), **options).save(out, quality=quality)
