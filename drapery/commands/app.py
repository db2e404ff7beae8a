"""All commands as one application of typer."""

from collections.abc import Sequence
from importlib import import_module
from typing import Annotated

import typer

from drapery.commands.plain import PlainCommand, PlainGroup

COMMANDS = (
    "render",
    "animate",
    "flat",
    "icon",
    "show",
    "blazon",
    "letters",
    "compare",
    "layers",
    "match",
    "scene",
    "garment",
    "player",
    "gallery",
    "model",
    "packs",
    "batch",
    "serve",
    "sign",
    "studio",
    "web",
    "doctor",
)
"""Modules of `drapery.commands`, each with a function `run`, in the order of the help."""
GROUPS = ("golden", "sheet", "style")
"""Modules with several commands, each with an `app`."""


def command_line(words: Sequence[str] = ()) -> typer.Typer:
    """The command line; with only the command that is called, if the first word is one.

    To import all commands and to make their options takes a fifth of the time of a picture.
    """
    app = typer.Typer(
        cls=PlainGroup,
        add_completion=False,
        no_args_is_help=True,
        pretty_exceptions_enable=False,
    )
    app.callback()(_without_command)
    called = [name for name in (*COMMANDS, *GROUPS) if name in words[:1]]
    for name in called or (*COMMANDS, *GROUPS):
        module = import_module(f"drapery.commands.{name}")
        if name in GROUPS:
            for each in module.app.registered_commands:
                each.cls = PlainCommand
            app.add_typer(module.app, name=name)
        else:
            settings = getattr(module, "CONTEXT", None)
            app.command(name, cls=PlainCommand, context_settings=settings)(module.run)
    return app


def _print_version(asked: bool) -> None:
    if asked:
        from drapery import __version__

        print(f"drapery {__version__}")
        raise typer.Exit


def _without_command(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version and end."
        ),
    ] = False,
) -> None:
    """Minecraft banners as pictures of real cloth."""
