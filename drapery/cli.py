"""The command line: how it starts and ends, and how errors are printed."""

import gc
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from io import TextIOWrapper
from types import FrameType
from typing import Any

from drapery.commands.notices import adopt_warnings, say
from drapery.commands.two_files import compare_files
from drapery.errors import DraperyError


class _Stopped(KeyboardInterrupt):
    """A signal to stop.

    A plain KeyboardInterrupt in code that is compiled from a text, as in dataclasses, makes
    CPython end by the signal although it was caught (`run_eval_code_obj` in pythonrun.c).
    """


INTERRUPTED = 130
"""The exit code after Ctrl-C: 128 and the number of SIGINT."""


def main() -> None:
    """Run a command. Bad input prints one line on standard error; the exit code is 2.

    Ctrl-C, SIGTERM and SIGHUP remove partial files; the exit codes are 130, 143 and 129.
    """
    # A command that draws makes many objects and little garbage: to look for it less often saves a
    # twentieth of the time of a picture.
    gc.set_threshold(50_000)
    adopt_warnings()
    _print_any_text()
    received: list[int] = []
    try:
        with _ended_by_signals(received):
            code = _run(sys.argv[1:])
    except DraperyError as error:
        say(str(error))
        code = 2
    except OSError as error:
        place = error.filename or "the output"
        say(f"{place}: {error.strerror or error}; correct that and try again")
        code = 2
    except KeyboardInterrupt:
        code = INTERRUPTED
    if code == INTERRUPTED:  # some versions of typer return it in place of the exception
        say("stopped")
    if received:
        code = 128 + received[0]
    # Python would look for garbage among all objects, a tenth of a second before the process ends.
    gc.freeze()
    sys.exit(code if isinstance(code, int) else 0)


def _run(words: list[str]) -> object:
    """Run a command; its exit code, or anything else for 0."""
    code = compare_files(words)
    if code is not None:
        return code
    # Imported here: typer takes longer to load than two small pictures to compare.
    from typer import Abort
    from typer.exceptions import TyperException

    from drapery.commands.app import command_line

    try:
        return command_line(words)(standalone_mode=False)
    except TyperException as error:
        # Without a command typer has printed the help, and there is no message.
        if error.format_message():
            say(f"{error.format_message()} (see `drapery --help`)")
        return error.exit_code
    except Abort:
        return INTERRUPTED


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
