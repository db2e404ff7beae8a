"""Output of commands on standard error: notes, warnings, progress."""

import sys
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from rich.progress import Progress


MAX_LINE = 4000
"""Most characters of one line on standard error."""
SLOW = 5.0
"""A picture that takes longer [s] says on a terminal for how long it has been drawn."""

RENDERER = "drapery.render.soft"
"""The package whose `__main__` compiles the renderer's kernels."""


def say(message: str) -> None:
    """Print one line of bounded length on standard error, if it is open and not full."""
    line = " ".join(message.splitlines())
    if len(line) > MAX_LINE:
        line = f"{line[:MAX_LINE]} ..."
    with suppress(OSError):  # there is nowhere else to say so
        print(f"drapery: {line}", file=sys.stderr, flush=True)


def show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """`warnings.showwarning` for the command line: one line, without the place in the code."""
    say(str(message))


def adopt_warnings() -> None:
    """Print each warning of the library once, as a plain line."""
    warnings.showwarning = show_warning
    warnings.simplefilter("once", UserWarning)


@contextmanager
def compile_notice() -> Iterator[None]:
    """Print a line when kernels are compiled, which happens once and takes up to a minute.

    While this process compiles the cloth's kernels, others compile those of the renderer and the
    one that is called next; this process then waits for them and reads them from the cache.
    """
    from drapery.jit import when_numba_compiles

    with when_numba_compiles(say_compiling):
        yield


def say_compiling(function: Callable[..., object]) -> None:
    """Tell that kernels are compiled, and compile others beside."""
    from drapery.jit import expected_call

    say("compiling kernels, which happens once and takes up to a minute ...")
    if not function.__module__.startswith(RENDERER):
        start_beside(RENDERER, [RENDERER])
    if call := expected_call():
        start_beside(call[0], [], call[1])


def start_beside(names: str, words: list[str], call: bytes = b"") -> None:
    """Compile kernels in another process, see `drapery.jit.beside`; it ends with this one.

    names: of the kernels, see `drapery.jit.compiled_beside`. words, call: for the process.
    """
    import subprocess  # it takes long to load

    from drapery.jit import compiled_beside
    from drapery.module_process import module_command

    pipe, nowhere = subprocess.PIPE, subprocess.DEVNULL
    command = module_command("drapery.jit.beside", *words)
    with suppress(OSError):  # it only saves time
        process = subprocess.Popen(command, stdin=pipe, stdout=nowhere, stderr=nowhere)
        assert process.stdin is not None
        process.stdin.write(call)
        process.stdin.flush()
        compiled_beside(names, process.wait)


@contextmanager
def drawing(what: str = "drawing") -> Iterator[None]:
    """`compile_notice`; on a terminal, what takes longer than `SLOW` also shows the time so far.

    The cloth of a still moves in one call, so how much of it is left is not known.
    """
    ended = threading.Event()

    def show() -> None:
        if not ended.wait(SLOW):
            with elapsed_bar(what):
                ended.wait()

    watch = threading.Thread(target=show, daemon=True)
    with compile_notice():
        with suppress(OSError, ValueError):  # it may be closed
            if sys.stderr.isatty():
                watch.start()
        try:
            yield
        finally:
            ended.set()
            if watch.ident is not None:
                watch.join()


def elapsed_bar(what: str) -> "Progress":
    """A line on standard error with the time since it began, which is gone when it ends."""
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = SpinnerColumn(), TextColumn(f"{what} ..."), TimeElapsedColumn()
    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    bar.add_task(what, total=None)
    return bar


@contextmanager
def progress(what: str, total: int | None = None) -> Iterator[Callable[[int, int | None], None]]:
    """A bar with count, rate and time left; the callable takes the number done and the total."""
    with bar_of(what) as bar:
        task = bar.add_task(what, total=total)
        yield lambda done, every: bar.update(task, completed=done, total=total or every)


def bar_of(what: str, *more: str) -> "Progress":
    """A bar on standard error: count, rate, time left, and more columns in rich's markup."""
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
