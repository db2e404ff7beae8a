"""The command line: its commands, and how errors are printed."""

import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from copy import copy
from io import TextIOWrapper
from types import FrameType
from typing import Annotated, Any

import typer
from typer.exceptions import TyperException

from drapery.commands import (
    animate,
    batch,
    blazon,
    compare,
    doctor,
    flat,
    gallery,
    garment,
    golden,
    layers,
    letters,
    match,
    model,
    packs,
    player,
    render,
    scene,
    serve,
    sheet,
    show,
    studio,
    style,
    web,
)
from drapery.commands.notices import adopt_warnings, say
from drapery.errors import DraperyError

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
for name, command in {
    "render": render,
    "animate": animate,
    "flat": flat,
    "show": show,
    "blazon": blazon,
    "letters": letters,
    "compare": compare,
    "layers": layers,
    "match": match,
    "scene": scene,
    "garment": garment,
    "player": player,
    "gallery": gallery,
    "model": model,
    "packs": packs,
    "batch": batch,
    "serve": serve,
    "studio": studio,
    "web": web,
    "doctor": doctor,
}.items():
    app.command(name, context_settings=getattr(command, "CONTEXT", None))(command.run)
app.add_typer(golden.app, name="golden")
app.add_typer(sheet.app, name="sheet")
app.add_typer(style.app, name="style")


def _print_version(asked: bool) -> None:
    if asked:
        from drapery import __version__

        print(f"drapery {__version__}")
        raise typer.Exit


@app.callback()
def _without_command(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version and end."
        ),
    ] = False,
) -> None:
    """Minecraft banners as pictures of real cloth."""


class _Stopped(KeyboardInterrupt):
    """A signal to stop.

    A plain KeyboardInterrupt in code that is compiled from a text, as that of dataclasses, makes
    CPython end by the signal although it was caught (`run_eval_code_obj` in pythonrun.c).
    """


INTERRUPTED = 130
"""The exit code after Ctrl-C: 128 and the number of SIGINT."""


def main() -> None:
    """Run a command. Bad input prints one line on standard error; the exit code is 2.

    Ctrl-C, SIGTERM and SIGHUP remove partial files; the exit codes are 130, 143 and 129.
    """
    adopt_warnings()
    _print_any_text()
    received: list[int] = []
    try:
        with _ended_by_signals(received):
            code = _app_for(sys.argv[1:])(standalone_mode=False)
    except DraperyError as error:
        say(str(error))
        code = 2
    except TyperException as error:
        # Without a command typer has printed the help, and there is no message.
        if error.format_message():
            say(f"{error.format_message()} (see `drapery --help`)")
        code = error.exit_code
    except OSError as error:
        place = error.filename or "the output"
        say(f"{place}: {error.strerror or error}; correct that and try again")
        code = 2
    except (KeyboardInterrupt, typer.Abort):
        code = INTERRUPTED
    if code == INTERRUPTED:  # some versions of typer return it in place of the exception
        say("stopped")
    if received:
        code = 128 + received[0]
    sys.exit(code if isinstance(code, int) else 0)


def _app_for(words: Sequence[str]) -> typer.Typer:
    """The command line with only the command that is called, if the first word is one.

    To make the options of all commands takes a fifth of the time of a picture.
    """
    called = [command for command in app.registered_commands if command.name in words[:1]]
    groups = [group for group in app.registered_groups if group.name in words[:1]]
    if not called and not groups:
        return app
    chosen = copy(app)
    # With a single command and no group typer would leave out the word that names it.
    chosen.registered_commands = called
    chosen.registered_groups = groups or app.registered_groups[-1:]
    return chosen


def _print_any_text() -> None:
    """Write characters that the terminal cannot show as escapes, not as an error."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


@contextmanager
def _ended_by_signals(received: list[int]) -> Iterator[None]:
    """SIGTERM and SIGHUP end the block as Ctrl-C does, and are appended to `received`.

    A second one ends the process at once. A signal that is ignored stays so, as nohup wants
    SIGHUP. Windows has no SIGHUP, and only the main thread may change what signals do.
    """

    usual: dict[int, Any] = {
        signal.SIGINT: signal.default_int_handler,
        signal.SIGTERM: signal.SIG_DFL,
    }
    if hasattr(signal, "SIGHUP"):
        usual[signal.SIGHUP] = signal.SIG_DFL

    def restore() -> None:
        for number in changed:
            signal.signal(number, usual[number])

    def end(number: int, frame: FrameType | None) -> None:
        restore()
        if number != signal.SIGINT:
            received.append(number)
        raise _Stopped

    if threading.current_thread() is not threading.main_thread():
        usual = {}
    changed = [number for number in usual if signal.getsignal(number) is usual[number]]
    for number in changed:
        signal.signal(number, end)
    try:
        yield
    finally:
        restore()
