"""`drapery style`: the styles that are known, and what each consists of."""

from typing import Annotated

import typer

app = typer.Typer(help="List styles, or show one as TOML to copy.", no_args_is_help=True)


@app.command("list")
def list_styles() -> None:
    """All styles by name: presets, and those of installed packages."""
    from drapery.styles import find_style, style_names

    names = style_names()
    width = max(map(len, names))
    for name in names:
        print(f"{name:{width}}  {find_style(name).description}".rstrip())


@app.command("show")
def show_style(
    name: Annotated[
        str,
        typer.Argument(
            metavar="NAME|FILE", help="A style, a step, or a file that ends with .toml."
        ),
    ],
) -> None:
    """One style or step as TOML, with every parameter, its meaning and its limits."""
    from drapery.styles import STEPS, Style, StyleStep, find_style, style_names

    known = [(kind, steps[name]) for kind, steps in STEPS.items() if name in steps]
    if known and name not in style_names():
        print(Style(name, tuple(StyleStep(*step) for step in known)).describe(), end="")
    else:
        print(find_style(name).describe(), end="")
