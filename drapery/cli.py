"""The command line: its commands, and how errors are printed."""

import sys

import typer
from typer.exceptions import TyperException

from drapery.commands import (
    animate,
    batch,
    compare,
    doctor,
    flat,
    gallery,
    golden,
    layers,
    model,
    packs,
    render,
    scene,
    serve,
    sheet,
    show,
    studio,
)
from drapery.commands.notices import adopt_warnings, say
from drapery.errors import DraperyError

app = typer.Typer(
    help="Minecraft banners as pictures of real cloth.",
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
for name, command in {
    "render": render,
    "animate": animate,
    "flat": flat,
    "show": show,
    "compare": compare,
    "layers": layers,
    "scene": scene,
    "gallery": gallery,
    "model": model,
    "packs": packs,
    "batch": batch,
    "serve": serve,
    "studio": studio,
    "doctor": doctor,
}.items():
    app.command(name, context_settings=getattr(command, "CONTEXT", None))(command.run)
app.add_typer(golden.app, name="golden")
app.add_typer(sheet.app, name="sheet")


def main() -> None:
    """Run a command. Bad input prints one line on standard error; the exit code is 2."""
    adopt_warnings()
    try:
        code = app(standalone_mode=False)
    except DraperyError as error:
        say(str(error))
        code = 2
    except TyperException as error:
        # With no command at all the help has been shown, and there is no message.
        if error.format_message():
            say(f"{error.format_message()} (see `drapery --help`)")
        code = error.exit_code
    except OSError as error:
        place = error.filename or "the output"
        say(f"{place}: {error.strerror or error}; correct that and try again")
        code = 2
    except (KeyboardInterrupt, typer.Abort):
        say("stopped")
        code = 130
    sys.exit(code if isinstance(code, int) else 0)
