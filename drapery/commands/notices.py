"""What a command says on the side, on standard error: notes, warnings, progress."""

import subprocess
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, TextIO

if TYPE_CHECKING:
    from rich.progress import Progress


def say(line: str) -> None:
    """One line to the user, beside the result."""
    print(f"drapery: {line}", file=sys.stderr, flush=True)


def show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """`warnings.showwarning` for the command line: our own words, without the place in the code."""
    say(str(message))


def adopt_warnings() -> None:
    """Show what the library warns of as plain lines, each once."""
    warnings.showwarning = show_warning
    warnings.simplefilter("once", UserWarning)


@contextmanager
def compile_notice() -> Iterator[None]:
    """Say so when kernels are being compiled: it happens once, and takes some seconds.

    Where it is the cloth's turn, another process compiles the rasteriser meanwhile; this one
    finds it in the cache.
    """
    from numba.core import event

    class FirstCompile(event.Listener):
        spoken = False

        def on_start(self, event: Any) -> None:
            if not self.spoken:
                say("compiling kernels, which happens once ...")
                if not event.data["dispatcher"].py_func.__module__.startswith("drapery.render"):
                    _start_beside("drapery.render.soft")
            self.spoken = True

        def on_end(self, event: Any) -> None:
            pass

    with event.install_listener("numba:compile", FirstCompile()):
        yield


def _start_beside(module: str) -> None:
    """Run a module in a process of its own, which nobody waits for."""
    nowhere = subprocess.DEVNULL
    command = [sys.executable, "-m", module]
    with suppress(OSError):
        subprocess.Popen(command, stdin=nowhere, stdout=nowhere, stderr=nowhere)


@contextmanager
def progress(what: str, total: int) -> Iterator[Callable[[int, int | None], None]]:
    """A bar with count, rate and time left; the callable takes how many are done, of how many."""
    with bar_of(what) as bar:
        task = bar.add_task(what, total=total)
        yield lambda done, _total: bar.update(task, completed=done)


def bar_of(what: str, *more: str) -> "Progress":
    """A bar on standard error: count, rate, time left, and more columns by rich's own words."""
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        ProgressColumn,
        Task,
        TextColumn,
        TimeRemainingColumn,
    )
    from rich.text import Text

    class Rate(ProgressColumn):
        def render(self, task: Task) -> Text:
            return Text(f"{task.speed:.1f}/s" if task.speed else "-/s")

    console = Console(stderr=True)
    return Progress(
        *(TextColumn(what), BarColumn(), MofNCompleteColumn(), Rate(), TimeRemainingColumn()),
        *(TextColumn(words) for words in more),
        console=console,
        transient=True,
        disable=not console.is_terminal,  # else a log gets an empty line
    )
