"""`drapery web`: live cloth for pages without a server."""

from pathlib import Path
from typing import Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice

SIZE = "320x480"


@o.pictured("page")
def run(
    out: Annotated[
        Path,
        typer.Option("-o", "--out", metavar="TARGET", help="The page, or the package's folder."),
    ],
    component: Annotated[
        bool,
        typer.Option(
            "--component",
            help="Write the package of <drapery-banner> and other elements.",
        ),
    ] = False,
    designer: Annotated[
        bool,
        typer.Option("--designer", help="Write the page of <drapery-designer> into a folder."),
    ] = False,
    gallery: Annotated[
        bool,
        typer.Option("--gallery", help="Write a page of banners, capes and players."),
    ] = False,
    size: o.SizeOption = SIZE,
    **words: Any,
) -> None:
    """Write a page with live cloth that needs no server, a gallery, an element or the designer."""
    from drapery.errors import OptionError
    from drapery.render.encode import check_target
    from drapery.web.designer_page import write_designer
    from drapery.web.gallery import write_gallery
    from drapery.web.package import write_component
    from drapery.web.page import write_page

    settings = o.settings_of({**words, "size": size})
    if component + designer + gallery > 1:
        raise OptionError(
            "--component and --designer write folders, and --gallery a page; use one of them"
        )
    if component or designer:
        if words["design"] is not None:
            flag = "--component" if component else "--designer"
            raise OptionError(f"the package shows any design; leave DESIGN out, or {flag}")
        write = write_component if component else write_designer
        write(out, settings)
        return
    check_target(out, "page")
    if gallery:
        if words["design"] is not None:
            raise OptionError("the gallery has designs of its own; leave DESIGN out, or --gallery")
        with compile_notice():
            write_gallery(out, settings)
        return
    with compile_notice():
        write_page(out, o.design_of(words), settings)
